// Rotation groups: like parts on a circle at equal angles.
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "core/base/tolerance.h"
#include "core/shape/symmetry_search.h"

namespace parsel {
namespace {

class RingSearch {
 public:
  explicit RingSearch(SymmetrySearch& search)
      : search_(search), options_(search.options), congruence_(search.congruence) {}

  void find(const Parts& set) {
    if (set.size() < 3) return;
    std::vector<Vec3> axes = {Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()};
    if (const std::optional<Vec3> normal = plane_normal(set)) axes.push_back(*normal);
    for (const Vec3& axis : axes) find_about(set, axis);
  }

 private:
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
    if (std::sqrt(std::max(solver.eigenvalues()[1], 0.0)) < options_.ring_radius) return std::nullopt;
    Vec3 normal = solver.eigenvectors().col(0);
    int axis = 0;
    if (normal.cwiseAbs().maxCoeff(&axis) > options_.same_axis) return std::nullopt;
    if (normal[axis] < 0) normal = -normal;
    return normal;
  }

  void find_about(const Parts& set, const Vec3& axis) {
    const auto level = [&](PartIndex a, PartIndex b) {
      return std::abs(axis.dot(congruence_.centroid(a) - congruence_.centroid(b))) <= options_.position;
    };
    for (const Parts& flat : classes(search_.free_of(set), level)) {
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
        const bool most = static_cast<double>(ring.size()) >= options_.ring_share * static_cast<double>(flat.size());
        if (ring.size() >= 3 && most && radius(ring.front()) > options_.ring_radius) try_ring(ring, centre, axis);
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
      if ((congruence_.centroid(ring[k]) - expected).norm() > options_.image) return;
      if (!congruence_.carries(ring[0], ring[k], turned, true)) return;
    }
    if (n == 4 && !point_along_radius(ring, centre, axis) && reflections_explain(ring, centre)) return;
    SymmetryGroup group;
    group.kind = SymmetryGroup::Kind::rotation;
    group.parts = ring;
    group.centre = centre;
    group.axis = axis;
    search_.add_group(std::move(group));
  }

  bool point_along_radius(const Parts& ring, const Vec3& centre, const Vec3& axis) const {
    return std::all_of(ring.begin(), ring.end(), [&](PartIndex p) {
      const Hexahedron& box = search_.boxes[p];
      int longest = 0;
      const Vec3 half = box.half_extents();
      half.maxCoeff(&longest);
      Vec3 radial = congruence_.centroid(p) - centre;
      radial -= axis.dot(radial) * axis;
      const double others = std::max(half[(longest + 1) % 3], half[(longest + 2) % 3]);
      return half[longest] > options_.blade_length * others &&
             std::abs(box.axes.row(longest).dot(radial.normalized())) > options_.blade_angle;
    });
  }

  /// Whether every part of the ring is the image of another about a global plane through the centre.
  bool reflections_explain(const Parts& ring, const Vec3& centre) {
    return std::all_of(ring.begin(), ring.end(), [&](PartIndex a) {
      return std::any_of(ring.begin(), ring.end(), [&](PartIndex b) {
        for (int axis = 0; axis < 3 && a != b; ++axis) {
          if (search_.mirrors(a, b, axis, centre[axis])) return true;
        }
        return false;
      });
    });
  }

  SymmetrySearch& search_;
  const SymmetryOptions& options_;
  Congruence& congruence_;
};

}  // namespace

void SymmetrySearch::find_rings(const Parts& kind) {
  const auto same = [&](PartIndex a, PartIndex b) { return same_size(a, b); };
  for (const Parts& set : classes(kind, same)) RingSearch(*this).find(set);
}

}  // namespace parsel
