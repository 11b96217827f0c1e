#include "core/shape/contacts.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace parsel {
namespace {

/// Disjoint sets of parts (Tarjan 1975).
class Components {
 public:
  explicit Components(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t k) { parent_[of(i)] = of(k); }

 private:
  std::vector<std::size_t> parent_;
};

/// Which parts are joined, for the question how many are joined to both of two.
class Neighbours {
 public:
  explicit Neighbours(std::size_t size) : words_((size + 63) / 64), bits_(size * words_), of_(size) {}
  void join(std::size_t i, std::size_t k) {
    set(i, k);
    set(k, i);
  }
  std::size_t common(std::size_t i, std::size_t k) const {
    const auto& fewer = of_[i].size() < of_[k].size() ? of_[i] : of_[k];
    const std::size_t other = of_[i].size() < of_[k].size() ? k : i;
    return static_cast<std::size_t>(std::count_if(
        fewer.begin(), fewer.end(), [&](std::size_t p) { return (word(other, p) >> (p % 64) & 1) != 0; }));
  }

 private:
  const std::uint64_t& word(std::size_t i, std::size_t k) const { return bits_[i * words_ + k / 64]; }
  void set(std::size_t i, std::size_t k) {
    bits_[i * words_ + k / 64] |= std::uint64_t{1} << (k % 64);
    of_[i].push_back(k);
  }
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::vector<std::size_t>> of_;
};

struct Extent {
  Vec3 low, high;
};

/// A pair that may meet, by how far the boxes around its parts overlap.
struct Near {
  double overlap;  ///< the two largest edges of the common box, multiplied: about the size of the contact
  std::uint32_t a, b;
};

bool more(const Near& m, const Near& n) {
  if (m.overlap != n.overlap) return m.overlap > n.overlap;
  return std::pair(m.a, m.b) < std::pair(n.a, n.b);
}

/// The strongest pairs of one part.
class Partners {
 public:
  void offer(const Near& pair, std::size_t most) {
    if (pairs_.size() == most && !more(pair, pairs_.front())) return;
    pairs_.push_back(pair);
    std::push_heap(pairs_.begin(), pairs_.end(), more);  // the weakest in front
    if (pairs_.size() <= most) return;
    std::pop_heap(pairs_.begin(), pairs_.end(), more);
    pairs_.pop_back();
  }
  const std::vector<Near>& pairs() const { return pairs_; }

 private:
  std::vector<Near> pairs_;
};

std::vector<Near> near_pairs(const PartData<Hexahedron>& boxes, double distance, std::size_t most) {
  std::vector<Extent> extents;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  for (const Hexahedron& box : boxes) {
    const Vec3 centre = box.point(Vec3::Zero());
    const Vec3 reach = box.axes.transpose().cwiseAbs() * (box.half_extents().array() + distance).matrix();
    extents.push_back({centre - reach, centre + reach});
    low = low.cwiseMin(extents.back().low);
    high = high.cwiseMax(extents.back().high);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t i, std::uint32_t k) { return extents[i].low[axis] < extents[k].low[axis]; });
  std::vector<Partners> partners(boxes.size());
  for (std::size_t first = 0; first < order.size(); ++first) {
    const Extent& a = extents[order[first]];
    for (std::size_t next = first + 1; next < order.size(); ++next) {
      const Extent& b = extents[order[next]];
      if (b.low[axis] > a.high[axis]) break;
      Vec3 common = a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low);
      if (common.minCoeff() < 0) continue;
      std::sort(common.begin(), common.end());
      const auto [i, k] = std::minmax(order[first], order[next]);
      const Near pair{common[1] * common[2], i, k};
      partners[i].offer(pair, most);
      partners[k].offer(pair, most);
    }
  }
  std::vector<Near> pairs;
  for (const Partners& own : partners) pairs.insert(pairs.end(), own.pairs().begin(), own.pairs().end());
  std::sort(pairs.begin(), pairs.end(), more);
  const auto same = [](const Near& m, const Near& n) { return m.a == n.a && m.b == n.b; };
  pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
  return pairs;
}

}  // namespace

void reduce(ContactRegion& region, const PartPair& pair, const MeasuredAxes& axes) {
  std::vector<Mat3> both = axes[pair.first];
  both.insert(both.end(), axes[pair.second].begin(), axes[pair.second].end());
  region.reduce(both);
}

Contacts find_contacts(const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes, const MeasuredAxes& axes,
                       const ContactLimits& limits) {
  Contacts contacts;
  Components joined(meshes.size());
  Neighbours neighbours(meshes.size());
  for (const double distance : {contact_distance, far_contact_distance}) {
    Components before = joined;
    for (const Near& pair : near_pairs(boxes, distance, limits.partners)) {
      const PartIndex a(pair.a), b(pair.b);
      if (distance > contact_distance && before.of(pair.a) == before.of(pair.b)) continue;
      const std::size_t enough = meshes[a].label == meshes[b].label ? limits.alike : limits.different;
      if (neighbours.common(pair.a, pair.b) >= enough) continue;
      ContactRegion region = contact_region(meshes[a], boxes[a], meshes[b], boxes[b], distance);
      // A part inside another's box is attached even when their surfaces do not come near each other.
      if (region.empty() && !contains(boxes[a], boxes[b]) && !contains(boxes[b], boxes[a])) continue;
      reduce(region, {a, b}, axes);
      contacts.emplace(PartPair(a, b), std::move(region));
      joined.join(pair.a, pair.b);
      neighbours.join(pair.a, pair.b);
    }
  }
  return contacts;
}

}  // namespace parsel
