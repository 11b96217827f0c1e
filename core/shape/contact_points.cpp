#include "core/shape/contact_points.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/shape/attachment.h"
#include "core/shape/hexahedron_extent.h"

namespace parsel {
namespace {

constexpr std::size_t sample_count = 400, most_points = 16;
constexpr double facing = 0.7;  ///< cos 45°
/// A point counts as lost when it is beyond the other part's box by this share of its half extent.
constexpr double beyond = 0.05;

bool run_into_each_other(const Hexahedron& a, const Hexahedron& b) {
  for (const Mat3* axes : {&a.axes, &b.axes}) {
    for (int i = 0; i < 3; ++i) {
      const Vec3 normal = axes->row(i).transpose();
      if (common(extent_along(a.corners, normal), extent_along(b.corners, normal)) <= contact_distance) return false;
    }
  }
  return true;
}

Vec3 normal_of(const PartMesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3 normal = (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3::Zero();
}

/// The point that is the farthest from those that are taken already, again and again (Gonzalez 1985).
std::vector<ContactPoint> spread(const std::vector<ContactPoint>& points) {
  if (points.size() <= most_points) return points;
  std::vector<double> nearest(points.size(), std::numeric_limits<double>::infinity());
  std::vector<ContactPoint> taken;
  std::size_t next = 0;
  while (taken.size() < most_points) {
    taken.push_back(points[next]);
    for (std::size_t i = 0; i < points.size(); ++i)
      nearest[i] = std::min(nearest[i], (points[i].point - taken.back().point).squaredNorm());
    next = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
  }
  return taken;
}

/// Half the mean edges along the local axes, as columns.
Mat3 edges_of(const Corners& corners) {
  Mat3 edges = Mat3::Zero();
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) edges.col(axis) += corner_sign(k, axis) * corners.row(k).transpose() / 8;
  }
  return edges;
}

/// A hexahedron as the parallelepiped of its mean edges.
struct Parallelepiped {
  explicit Parallelepiped(const Corners& corners)
      : centre(corners.colwise().mean().transpose()), to_local(edges_of(corners).inverse()) {}
  bool is_flat() const { return !to_local.allFinite(); }
  bool is_beyond(const Vec3& point) const {
    return ((to_local * (point - centre)).cwiseAbs().array() > 1 + beyond).any();
  }
  Vec3 centre;
  Mat3 to_local;
};

}  // namespace

const SurfaceGrid& ContactPointFinder::grid(PartIndex part) {
  const auto found = grids_.find(part);
  if (found != grids_.end()) return found->second;
  return grids_.emplace(part, SurfaceGrid(meshes_[part], contact_distance)).first->second;
}

const std::vector<SurfaceSample>& ContactPointFinder::samples(PartIndex part) {
  auto& own = samples_[part];
  if (own.empty()) own = sample_triangles(meshes_[part], sample_count);
  return own;
}

std::vector<ContactPoint> ContactPointFinder::operator()(PartIndex a, PartIndex b) {
  if (!run_into_each_other(boxes_[a], boxes_[b])) return {};
  const bool a_smaller = boxes_[a].half_extents().norm() <= boxes_[b].half_extents().norm();
  const PartIndex small = a_smaller ? a : b, large = a_smaller ? b : a;
  const Corners& corners = boxes_[large].corners;
  const Vec3 low = corners.colwise().minCoeff().transpose().array() - contact_distance,
             high = corners.colwise().maxCoeff().transpose().array() + contact_distance;
  std::vector<ContactPoint> found;
  for (const auto& [point, triangle] : samples(small)) {
    if ((point.array() < low.array()).any() || (point.array() > high.array()).any()) continue;
    const auto on_large = grid(large).nearest(point);
    if (!on_large) continue;
    const Vec3 normal = normal_of(meshes_[large], *on_large);
    if (std::abs(normal.dot(normal_of(meshes_[small], triangle))) > facing) found.push_back({point, normal});
  }
  return spread(found);
}

SurfaceContact::SurfaceContact(const std::vector<ContactPoint>& points, const Hexahedron& a, const Hexahedron& b)
    : edges_b_(edges_of(b.corners)) {
  for (const auto& [point, normal] : points) {
    const auto ends = [&, p = point, n = normal](const Hexahedron& box) {
      return extent_along(box.corners, n).high - p.dot(n) <= contact_distance;
    };
    points_.push_back(
        {trilinear_weights(a.local(point)), trilinear_weights(b.local(point)), normal, ends(a) && ends(b)});
  }
  against_ = static_cast<std::size_t>(
      std::count_if(points_.begin(), points_.end(), [](const Point& point) { return !point.is_flush; }));
}

ContactShift SurfaceContact::shift(const Corners& a, const Corners& b) const {
  const Parallelepiped now_a(a), now_b(b);
  ContactShift shift;
  if (now_a.is_flat() || now_b.is_flat()) return shift;
  double lost = 0;
  for (const auto& [on_a, on_b, normal, is_flush] : points_) {
    const Vec3 point_a = interpolate(on_a, a), point_b = interpolate(on_b, b);
    // Seen from b as it was at rest, so that what is stretched with it does not count.
    const Vec3 moved = edges_b_ * (now_b.to_local * (point_a - point_b));
    double& farthest = is_flush ? shift.stepped : shift.apart;
    farthest = std::max(farthest, std::abs(moved.dot(normal)));
    if (is_flush) continue;
    if (now_b.is_beyond(point_a) || now_a.is_beyond(point_b)) ++lost;
  }
  if (against_ > 0) shift.lost = lost / static_cast<double>(against_);
  return shift;
}

}  // namespace parsel
