#include "core/shape/symmetry.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/shape/label.h"
#include "core/shape/symmetry_search.h"

namespace parsel {
namespace {

/// Parts of one kind, and the key that names it.
struct Kind {
  std::string key;
  Parts parts;
};

/// By grouping key, in the order of first appearance, so that ids follow the file.
std::vector<Kind> kinds_of(const PartData<std::string>& keys) {
  std::vector<Kind> kinds;
  std::map<std::string, std::size_t> number;
  for (const PartIndex p : keys.indices()) {
    const auto [known, is_new] = number.emplace(keys[p], kinds.size());
    if (is_new) kinds.push_back({keys[p], {}});
    kinds[known->second].parts.push_back(p);
  }
  return kinds;
}

/// The parts that nothing ties yet, put together where their keys are alike and two of them are of one size.
std::vector<Parts> twins(std::vector<Kind> kinds, const SymmetrySearch& search) {
  std::set<PartIndex> tied;
  for (const MirrorPair& m : search.found.mirrors) tied.insert({m.a, m.b});
  for (Kind& kind : kinds) {
    std::erase_if(kind.parts, [&](PartIndex p) { return !search.is_free(p) || tied.count(p) > 0; });
  }
  const auto same_size = [&](const Parts& a, const Parts& b) {
    return std::any_of(a.begin(), a.end(), [&](PartIndex p) {
      return std::any_of(b.begin(), b.end(), [&](PartIndex q) { return search.same_size(p, q); });
    });
  };
  std::vector<std::size_t> set(kinds.size());
  std::iota(set.begin(), set.end(), std::size_t{0});
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    for (std::size_t k = i + 1; k < kinds.size(); ++k) {
      if (set[i] == set[k] || !alike(kinds[i].key, kinds[k].key)) continue;
      if (!same_size(kinds[i].parts, kinds[k].parts)) continue;
      const std::size_t to = std::min(set[i], set[k]), from = std::max(set[i], set[k]);
      std::replace(set.begin(), set.end(), from, to);
    }
  }
  std::vector<Parts> out(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    out[set[i]].insert(out[set[i]].end(), kinds[i].parts.begin(), kinds[i].parts.end());
  }
  std::erase_if(out, [](const Parts& parts) { return parts.size() < 2; });
  for (Parts& parts : out) std::sort(parts.begin(), parts.end());
  return out;
}

/// Spreads the boxes of groups and mirror images from one part to all that are tied to it.
class Alignment {
 public:
  Alignment(const PartData<Hexahedron>& boxes, const Symmetries& symmetries)
      : aligned_(boxes), symmetries_(symmetries), placed_(boxes.size(), 0), spread_(symmetries.groups.size(), false) {
    for (std::size_t g = 0; g < symmetries.groups.size(); ++g) {
      for (const PartIndex p : symmetries.groups[g].parts) group_of_[p] = g;
    }
  }

  PartData<Hexahedron> run() {
    // Groups first: what an instance's image is follows from the group, never the other way round.
    for (const SymmetryGroup& group : symmetries_.groups) spread_from(group.parts.front());
    for (const PartIndex part : aligned_.indices()) spread_from(part);
    return std::move(aligned_);
  }

 private:
  bool is_free(PartIndex p) const { return group_of_.count(p) == 0; }

  void place(PartIndex part, Hexahedron box) {
    aligned_[part] = std::move(box);
    placed_[part] = 1;
    queue_.push_back(part);
  }

  void spread_from(PartIndex root) {
    if (placed_[root]) return;
    queue_.clear();
    place(root, aligned_[root]);
    for (std::size_t at = 0; at < queue_.size(); ++at) {
      const PartIndex p = queue_[at];
      place_instances(p);
      for (const MirrorPair& m : symmetries_.mirrors) {
        if (m.a != p && m.b != p) continue;
        const PartIndex other = m.a == p ? m.b : m.a;
        if (placed_[other] || (is_free(p) && !is_free(other))) continue;
        place(other, mirrored(aligned_[p], m.axis, m.offset));
      }
    }
  }

  void place_instances(PartIndex p) {
    const auto own = group_of_.find(p);
    if (own == group_of_.end() || spread_[own->second]) return;
    spread_[own->second] = true;
    const SymmetryGroup& group = symmetries_.groups[own->second];
    // A group whose instances are all images of another's is complete before its turn comes.
    const bool is_first = p == group.parts.front() && std::none_of(group.parts.begin() + 1, group.parts.end(),
                                                                   [&](PartIndex q) { return placed_[q]; });
    if (!is_first) return;
    const Hexahedron first = aligned_[p];
    for (std::size_t k = 1; k < group.parts.size(); ++k) place(group.parts[k], instance(group, first, k));
  }

  static Hexahedron instance(const SymmetryGroup& group, const Hexahedron& first, std::size_t k) {
    Hexahedron box = first;
    if (group.kind == SymmetryGroup::Kind::translation) {
      box.corners.rowwise() += static_cast<double>(k) * group.delta.transpose();
      return box;
    }
    const Mat3 turned = turn(group.axis, k, group.parts.size());
    box.corners.rowwise() -= group.centre.transpose();
    box.corners = (box.corners * turned.transpose()).eval();
    box.corners.rowwise() += group.centre.transpose();
    box.axes = (first.axes * turned.transpose()).eval();
    return box;
  }

  PartData<Hexahedron> aligned_;
  const Symmetries& symmetries_;
  PartData<char> placed_;
  std::vector<bool> spread_;
  std::map<PartIndex, std::size_t> group_of_;
  Parts queue_;
};

}  // namespace

Symmetries find_symmetries(const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes,
                           const PartData<std::string>& keys, const SymmetryOptions& options) {
  SymmetrySearch search(meshes, boxes, options);
  const std::vector<Kind> kinds = kinds_of(keys);
  for (const Kind& kind : kinds) {
    search.find_rings(kind.parts);
    search.find_rows(kind.parts);
    search.find_reflections(kind.parts);
  }
  // Names that differ say that parts differ: they are twins only where nothing else explains them.
  for (const Parts& parts : twins(kinds, search)) search.find_reflections(parts);
  return std::move(search.found);
}

Hexahedron mirrored(const Hexahedron& hexahedron, int axis, double offset) {
  Hexahedron image;
  for (int k = 0; k < 8; ++k) {
    image.corners.row(k) = hexahedron.corners.row(k ^ (1 << axis));
    image.corners(k, axis) = 2 * offset - image.corners(k, axis);
  }
  image.axes = hexahedron.axes * mirror_matrix(axis);
  image.axes.row(axis) *= -1;
  return image;
}

PartData<Hexahedron> align_boxes(const PartData<Hexahedron>& boxes, const Symmetries& symmetries) {
  return Alignment(boxes, symmetries).run();
}

}  // namespace parsel
