#include "core/shape/symmetry.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/tolerance.h"
#include "core/shape/congruence.h"

namespace parsel {
namespace {

using Parts = std::vector<PartIndex>;

Mat3 mirror_matrix(int axis) {
  Mat3 m = Mat3::Identity();
  m(axis, axis) = -1;
  return m;
}

Mat3 turn(const Vec3& axis, std::size_t k, std::size_t n) {
  const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(n);
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Splits parts into sets whose members agree with the set's first.
template <class Agree>
std::vector<Parts> classes(const Parts& parts, const Agree& agree) {
  std::vector<Parts> sets;
  for (const PartIndex p : parts) {
    const auto set = std::find_if(sets.begin(), sets.end(), [&](const Parts& s) { return agree(s.front(), p); });
    if (set == sets.end()) {
      sets.push_back({p});
    } else {
      set->push_back(p);
    }
  }
  return sets;
}

class SymmetryFinder {
 public:
  SymmetryFinder(const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes, const SymmetryOptions& options)
      : boxes_(boxes), options_(options), congruence_(meshes, options), group_of_(meshes.size(), none) {}

  void find(const Parts& same_key) {
    find_rotations(same_key);
    find_translations(same_key);
    find_reflections(same_key);
  }

  Symmetries take() { return std::move(found_); }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  bool is_free(PartIndex p) const { return group_of_[p] == none; }

  void add_group(SymmetryGroup group) {
    for (const PartIndex p : group.parts) group_of_[p] = found_.groups.size();
    found_.groups.push_back(std::move(group));
  }

  // --- Rotation ---------------------------------------------------------------------------------------------------

  void find_rotations(const Parts& parts) {
    const auto same_size = [&](PartIndex a, PartIndex b) {
      Vec3 ea = boxes_[a].half_extents(), eb = boxes_[b].half_extents();
      std::sort(ea.begin(), ea.end());
      std::sort(eb.begin(), eb.end());
      const double areas = std::max(congruence_.area(a), congruence_.area(b));
      return (ea - eb).cwiseAbs().maxCoeff() <= options_.position &&
             std::abs(congruence_.area(a) - congruence_.area(b)) <= 0.1 * areas;
    };
    for (const Parts& set : classes(parts, same_size)) {
      if (set.size() < 3) continue;
      std::vector<Vec3> axes = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
      if (const std::optional<Vec3> normal = plane_normal(set)) axes.push_back(*normal);
      for (const Vec3& axis : axes) find_rings(set, axis);
    }
  }

  /// Normal of the plane through all centroids, unless it is a global axis or there is no such plane.
  std::optional<Vec3> plane_normal(const Parts& parts) const {
    Vec3 mean = Vec3::Zero();
    for (const PartIndex p : parts) mean += congruence_.centroid(p) / static_cast<double>(parts.size());
    Mat3 covariance = Mat3::Zero();
    for (const PartIndex p : parts) {
      const Vec3 d = congruence_.centroid(p) - mean;
      covariance += d * d.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
    if (std::sqrt(std::max(solver.eigenvalues()[0], 0.0)) > options_.position) return std::nullopt;
    if (std::sqrt(std::max(solver.eigenvalues()[1], 0.0)) < 2 * options_.position) return std::nullopt;
    Vec3 normal = solver.eigenvectors().col(0);
    int axis = 0;
    if (normal.cwiseAbs().maxCoeff(&axis) > 0.9998) return std::nullopt;  // within 1° of a global axis
    if (normal[axis] < 0) normal = -normal;
    return normal;
  }

  void find_rings(const Parts& set, const Vec3& axis) {
    Parts free;
    std::copy_if(set.begin(), set.end(), std::back_inserter(free), [&](PartIndex p) { return is_free(p); });
    const auto level = [&](PartIndex a, PartIndex b) {
      return std::abs(axis.dot(congruence_.centroid(a) - congruence_.centroid(b))) <= options_.position;
    };
    for (const Parts& flat : classes(free, level)) {
      if (flat.size() < 3) continue;
      Vec3 centre = Vec3::Zero();
      for (const PartIndex p : flat) centre += congruence_.centroid(p) / static_cast<double>(flat.size());
      const auto radius = [&](PartIndex p) {
        const Vec3 d = congruence_.centroid(p) - centre;
        return (d - axis.dot(d) * axis).norm();
      };
      const auto same_radius = [&](PartIndex a, PartIndex b) {
        return std::abs(radius(a) - radius(b)) <= options_.position;
      };
      for (const Parts& ring : classes(flat, same_radius)) {
        // A few of many parts are on a circle by chance, as the corners of a grid are.
        if (ring.size() >= 3 && 2 * ring.size() >= flat.size() && radius(ring.front()) > 2 * options_.position) {
          try_ring(ring, centre, axis);
        }
      }
    }
  }

  void try_ring(Parts ring, const Vec3& centre, const Vec3& axis) {
    const Vec3 first = congruence_.centroid(ring.front()) - centre;
    const Vec3 e1 = (first - axis.dot(first) * axis).normalized(), e2 = axis.cross(e1);
    std::vector<std::pair<double, PartIndex>> by_angle;
    for (const PartIndex p : ring) {
      const Vec3 d = congruence_.centroid(p) - centre;
      const double angle = std::atan2(e2.dot(d), e1.dot(d));
      by_angle.emplace_back(p == ring.front() ? 0.0 : angle < 0 ? angle + 2 * pi : angle, p);
    }
    std::sort(by_angle.begin(), by_angle.end());
    const std::size_t n = ring.size();
    for (std::size_t k = 0; k < n; ++k) ring[k] = by_angle[k].second;

    for (std::size_t k = 1; k < n; ++k) {
      const Mat3 turned = turn(axis, k, n);
      const Vec3 expected = centre + turned * (congruence_.centroid(ring[0]) - centre);
      if ((congruence_.centroid(ring[k]) - expected).norm() > 1.5 * options_.position) return;
      if (!congruence_.carries(ring[0], ring[k], turned, true)) return;
    }
    if (n == 4 && !point_along_radius(ring, centre, axis) && reflections_explain(ring, centre)) return;
    SymmetryGroup group;
    group.kind = SymmetryGroup::Kind::rotation;
    group.parts = ring;
    group.centre = centre;
    group.axis = axis;
    add_group(std::move(group));
  }

  bool point_along_radius(const Parts& ring, const Vec3& centre, const Vec3& axis) const {
    return std::all_of(ring.begin(), ring.end(), [&](PartIndex p) {
      int longest = 0;
      const Vec3 half = boxes_[p].half_extents();
      half.maxCoeff(&longest);
      Vec3 radial = congruence_.centroid(p) - centre;
      radial -= axis.dot(radial) * axis;
      // Within 30° of the radius, and clearly longest that way.
      const double others = std::max(half[(longest + 1) % 3], half[(longest + 2) % 3]);
      return half[longest] > 1.2 * others && std::abs(boxes_[p].axes.row(longest).dot(radial.normalized())) > 0.866;
    });
  }

  /// Whether every part of the ring is the image of another about a global plane through the centre.
  bool reflections_explain(const Parts& ring, const Vec3& centre) {
    return std::all_of(ring.begin(), ring.end(), [&](PartIndex a) {
      return std::any_of(ring.begin(), ring.end(), [&](PartIndex b) {
        for (int axis = 0; axis < 3 && a != b; ++axis) {
          if (mirrors(a, b, axis, centre[axis])) return true;
        }
        return false;
      });
    });
  }

  // --- Translation ------------------------------------------------------------------------------------------------

  void find_translations(const Parts& parts) {
    Parts free;
    std::copy_if(parts.begin(), parts.end(), std::back_inserter(free), [&](PartIndex p) { return is_free(p); });
    const auto same = [&](PartIndex a, PartIndex b) {
      return same_extents(a, b) && congruence_.carries(a, b, Mat3::Identity());
    };
    for (const Parts& set : classes(free, same)) {
      // Lines that cross compete; what a longer one leaves over may still be a line.
      for (int round = 0; round < 8; ++round) {
        if (!take_lines(set)) break;
      }
    }
  }

  bool same_extents(PartIndex a, PartIndex b) const {
    return (congruence_.half_extents(a) - congruence_.half_extents(b)).cwiseAbs().maxCoeff() <= options_.position;
  }

  bool take_lines(const Parts& set) {
    Parts free;
    std::copy_if(set.begin(), set.end(), std::back_inserter(free), [&](PartIndex p) { return is_free(p); });
    if (free.size() < 3) return false;
    std::vector<Parts> lines;
    for (const PartIndex start : free) {
      for (const PartIndex next : nearest(free, start)) {
        Parts line = line_from(free, start, next);
        if (line.size() >= 3) lines.push_back(std::move(line));
      }
    }
    std::stable_sort(lines.begin(), lines.end(), [&](const Parts& a, const Parts& b) {
      if (a.size() != b.size()) return a.size() > b.size();
      return spacing(a) < spacing(b) - options_.position;
    });
    bool taken = false;
    for (const Parts& line : lines) {
      if (!std::all_of(line.begin(), line.end(), [&](PartIndex p) { return is_free(p); })) continue;
      if (is_diagonal(line) && is_crossed(line, lines)) continue;
      const Vec3 delta =
          (congruence_.centre(line.back()) - congruence_.centre(line.front())) / static_cast<double>(line.size() - 1);
      SymmetryGroup group;
      group.kind = SymmetryGroup::Kind::translation;
      group.parts = line;
      group.delta = snapped(delta, static_cast<double>(line.size() - 1));
      add_group(std::move(group));
      taken = true;
    }
    return taken;
  }

  bool is_diagonal(const Parts& line) const {
    const Vec3 way = congruence_.centre(line.back()) - congruence_.centre(line.front());
    return (way.cwiseAbs().array() > options_.position).count() > 1;
  }

  static bool is_crossed(const Parts& line, const std::vector<Parts>& lines) {
    const auto shares = [&](const Parts& other) {
      const auto common = std::count_if(line.begin(), line.end(), [&](PartIndex p) {
        return std::find(other.begin(), other.end(), p) != other.end();
      });
      return common == 1;  // more would be the same line with other steps
    };
    return std::any_of(lines.begin(), lines.end(), shares);
  }

  double spacing(const Parts& line) const { return (congruence_.centre(line[1]) - congruence_.centre(line[0])).norm(); }

  /// A line that runs along a global axis within tolerance is put on it.
  Vec3 snapped(const Vec3& delta, double steps) const {
    Vec3 out = delta;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(delta[axis]) * steps <= options_.position) out[axis] = 0;
    }
    return out;
  }

  Parts nearest(const Parts& free, PartIndex from) const {
    constexpr std::size_t neighbours = 16;
    std::vector<std::pair<double, PartIndex>> by_distance;
    for (const PartIndex p : free) {
      const double d = (congruence_.centre(p) - congruence_.centre(from)).norm();
      if (p != from && d > options_.position) by_distance.emplace_back(d, p);
    }
    const std::size_t kept = std::min(neighbours, by_distance.size());
    std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(kept), by_distance.end());
    Parts out;
    for (std::size_t i = 0; i < kept; ++i) out.push_back(by_distance[i].second);
    return out;
  }

  /// Whether every part is within tolerance of equal steps between the first and the last.
  bool is_even(const Parts& line) const {
    const Vec3 start = congruence_.centre(line.front());
    const Vec3 step = (congruence_.centre(line.back()) - start) / static_cast<double>(line.size() - 1);
    for (std::size_t k = 0; k < line.size(); ++k) {
      const Vec3 expected = start + static_cast<double>(k) * step;
      if ((congruence_.centre(line[k]) - expected).norm() > options_.position) return false;
    }
    return true;
  }

  /// The parts at equal distances from `start` on, when nothing comes before it and the line runs from the smaller
  /// coordinate to the larger, so that each line is found once and always the same way round.
  Parts line_from(const Parts& free, PartIndex start, PartIndex next) const {
    const Vec3 delta = congruence_.centre(next) - congruence_.centre(start);
    int axis = 0;
    delta.cwiseAbs().maxCoeff(&axis);
    if (delta[axis] < 0) return {};
    // A single step may be off by the errors of two parts; the line as a whole is held to one.
    const double slack = std::min(2 * options_.position, 0.15 * delta.norm());
    const auto at = [&](const Vec3& where) -> std::optional<PartIndex> {
      std::optional<PartIndex> best;
      double best_distance = slack;
      for (const PartIndex p : free) {
        const double d = (congruence_.centre(p) - where).norm();
        if (d <= best_distance) best_distance = d, best = p;
      }
      return best;
    };
    if (at(congruence_.centre(start) - delta)) return {};
    Parts line = {start, next};
    // Each step starts from the last part found, so that small errors do not add up along a long line.
    while (const auto more = at(congruence_.centre(line.back()) + delta)) line.push_back(*more);
    while (line.size() > 2 && !is_even(line)) line.pop_back();
    return line;
  }

  // --- Reflection -------------------------------------------------------------------------------------------------

  bool mirrors(PartIndex a, PartIndex b, int axis, double offset) {
    Vec3 image = congruence_.centre(a);
    image[axis] = 2 * offset - image[axis];
    return (image - congruence_.centre(b)).norm() <= 1.5 * options_.position && same_extents(a, b) &&
           congruence_.carries(a, b, mirror_matrix(axis));
  }

  void find_reflections(const Parts& parts) {
    const auto same = [&](PartIndex a, PartIndex b) { return same_extents(a, b); };
    for (const Parts& set : classes(parts, same)) {
      for (int axis = 0; axis < 3 && set.size() > 1; ++axis) {
        double low = congruence_.centre(set[0])[axis], high = low;
        for (const PartIndex p : set) {
          low = std::min(low, congruence_.centre(p)[axis]);
          high = std::max(high, congruence_.centre(p)[axis]);
        }
        const double own = (low + high) / 2;
        if (!take_plane(set, axis, 0, false) && std::abs(own) > options_.position) take_plane(set, axis, own, true);
      }
    }
  }

  /// Adds the pairs about one plane; with `whole`, only when every part of the set has an image in it.
  bool take_plane(const Parts& set, int axis, double offset, bool whole) {
    std::vector<MirrorPair> pairs;
    std::vector<bool> done(set.size(), false);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double from_plane = congruence_.centre(set[i])[axis] - offset;
      if (done[i]) continue;
      if (std::abs(from_plane) <= options_.position / 2) continue;  // its own image
      for (std::size_t j = i + 1; j < set.size(); ++j) {
        const bool one_group = !is_free(set[i]) && group_of_[set[i]] == group_of_[set[j]];
        if (done[j] || is_free(set[i]) != is_free(set[j]) || one_group) continue;
        if (!mirrors(set[i], set[j], axis, offset)) continue;
        pairs.push_back({std::min(set[i], set[j]), std::max(set[i], set[j]), axis, offset});
        done[i] = done[j] = true;
        break;
      }
      if (whole && !done[i]) return false;
    }
    drop_half_paired_groups(pairs);
    found_.mirrors.insert(found_.mirrors.end(), pairs.begin(), pairs.end());
    return !pairs.empty();
  }

  /// Two groups are images of each other only when all their instances are.
  void drop_half_paired_groups(std::vector<MirrorPair>& pairs) const {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> count;
    const auto key = [&](const MirrorPair& m) { return std::minmax({group_of_[m.a], group_of_[m.b]}); };
    for (const MirrorPair& m : pairs) ++count[key(m)];
    std::erase_if(pairs, [&](const MirrorPair& m) {
      if (is_free(m.a)) return false;
      const std::size_t paired = count[key(m)];
      return paired != found_.groups[group_of_[m.a]].parts.size() ||
             paired != found_.groups[group_of_[m.b]].parts.size();
    });
  }

  const PartData<Hexahedron>& boxes_;
  const SymmetryOptions& options_;
  Congruence congruence_;
  PartData<std::size_t> group_of_;  ///< index into found_.groups, or none
  Symmetries found_;
};

}  // namespace

Symmetries find_symmetries(const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes,
                           const PartData<std::string>& keys, const SymmetryOptions& options) {
  SymmetryFinder finder(meshes, boxes, options);
  std::map<std::string, Parts> by_key;
  std::vector<std::string> order;  // of first appearance, so that ids follow the file
  for (const PartIndex p : keys.indices()) {
    if (by_key[keys[p]].empty()) order.push_back(keys[p]);
    by_key[keys[p]].push_back(p);
  }
  for (const std::string& key : order) {
    if (by_key[key].size() > 1) finder.find(by_key[key]);
  }
  return finder.take();
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
  PartData<Hexahedron> aligned = boxes;
  PartData<char> placed(boxes.size(), 0);
  std::vector<bool> spread(symmetries.groups.size(), false);
  std::map<PartIndex, std::size_t> group_of;
  for (std::size_t g = 0; g < symmetries.groups.size(); ++g) {
    for (const PartIndex p : symmetries.groups[g].parts) group_of[p] = g;
  }
  const auto place_instances = [&](const SymmetryGroup& group, Parts& queue) {
    const Hexahedron first = aligned[group.parts.front()];
    for (std::size_t k = 1; k < group.parts.size(); ++k) {
      Hexahedron& instance = aligned[group.parts[k]];
      instance = first;
      if (group.kind == SymmetryGroup::Kind::translation) {
        instance.corners.rowwise() += static_cast<double>(k) * group.delta.transpose();
      } else {
        const Mat3 turned = turn(group.axis, k, group.parts.size());
        instance.corners.rowwise() -= group.centre.transpose();
        instance.corners = (instance.corners * turned.transpose()).eval();
        instance.corners.rowwise() += group.centre.transpose();
        instance.axes = (first.axes * turned.transpose()).eval();
      }
      placed[group.parts[k]] = 1;
      queue.push_back(group.parts[k]);
    }
  };
  for (const PartIndex part : boxes.indices()) {
    // A group starts from its first instance, whichever of its parts comes first.
    const auto own = group_of.find(part);
    const PartIndex root = own == group_of.end() ? part : symmetries.groups[own->second].parts.front();
    if (placed[part]) continue;
    placed[root] = 1;
    Parts queue = {root};
    for (std::size_t at = 0; at < queue.size(); ++at) {
      const PartIndex p = queue[at];
      // A group whose instances are all images of another's is complete before its turn comes.
      if (const auto group = group_of.find(p); group != group_of.end() && !spread[group->second]) {
        spread[group->second] = true;
        const Parts& parts = symmetries.groups[group->second].parts;
        if (p == parts.front() &&
            std::none_of(parts.begin() + 1, parts.end(), [&](PartIndex q) { return placed[q]; })) {
          place_instances(symmetries.groups[group->second], queue);
        }
      }
      for (const MirrorPair& m : symmetries.mirrors) {
        if (m.a != p && m.b != p) continue;
        const PartIndex other = m.a == p ? m.b : m.a;
        if (placed[other]) continue;
        aligned[other] = mirrored(aligned[p], m.axis, m.offset);
        placed[other] = 1;
        queue.push_back(other);
      }
    }
  }
  return aligned;
}

}  // namespace parsel
