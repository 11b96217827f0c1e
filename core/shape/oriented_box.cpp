#include "core/shape/oriented_box.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/result.h"
#include "core/base/tolerance.h"

namespace parsel {
namespace {

using Vec2 = Eigen::Vector2d;

struct Extent {
  Vec3 low, high;  ///< along the axes
  double volume() const { return (high - low).cwiseMax(2 * min_half_extent).prod(); }
};

Extent extent_along(const std::vector<Vec3>& points, const Mat3& axes) {
  Extent extent{Vec3::Constant(std::numeric_limits<double>::infinity()),
                Vec3::Constant(-std::numeric_limits<double>::infinity())};
  for (const Vec3& p : points) {
    const Vec3 q = axes * p;
    extent.low = extent.low.cwiseMin(q);
    extent.high = extent.high.cwiseMax(q);
  }
  return extent;
}

std::vector<Vec3> used_vertices(const PartMesh& mesh) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) used[v] = true;
  }
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) points.push_back(mesh.positions[i]);
  }
  return points;
}

/// The points that are extreme in 128 directions spread over the sphere: what orientations are tried on. Exact for the
/// boxes and prisms of furniture; the final extents are taken over all points.
std::vector<Vec3> extreme_points(const std::vector<Vec3>& points) {
  constexpr std::size_t pairs = 64;
  if (points.size() <= pairs) return points;
  const double golden_angle = pi * (3 - std::sqrt(5.0));
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < pairs; ++i) {
    const double z = (static_cast<double>(i) + 0.5) / static_cast<double>(pairs);  // half a sphere: both ends count
    const double angle = golden_angle * static_cast<double>(i), r = std::sqrt(1 - z * z);
    const Vec3 direction(r * std::cos(angle), r * std::sin(angle), z);
    std::size_t lowest = 0, highest = 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double along = direction.dot(points[k]);
      if (along < low) low = along, lowest = k;
      if (along > high) high = along, highest = k;
    }
    chosen.push_back(lowest);
    chosen.push_back(highest);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Vec3> out;
  for (const std::size_t k : chosen) out.push_back(points[k]);
  return out;
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Vec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Vec2& p : points) {
      while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// The axes of the tightest box that keeps `up` (unit) as an axis: a minimal rectangle has a side on a hull edge
/// (Freeman, Shapira 1975).
Mat3 tightest_about(const std::vector<Vec3>& points, const Vec3& up) {
  const Vec3 e1 = up.unitOrthogonal(), e2 = up.cross(e1);
  std::vector<Vec2> flat;
  for (const Vec3& p : points) flat.emplace_back(e1.dot(p), e2.dot(p));
  const std::vector<Vec2> hull = convex_hull(std::move(flat));
  Vec2 best(1, 0);
  double best_area = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    if (edge.norm() < 1e-9) continue;
    const Vec2 d = edge.normalized(), n(-d.y(), d.x());
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec2& p : hull) {
      const Vec2 q(d.dot(p), n.dot(p));
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
    const double area = (high - low).cwiseMax(2 * min_half_extent).prod();
    if (area < best_area * (1 - 1e-9)) best_area = area, best = d;
  }
  Mat3 axes;
  axes.row(0) = (best.x() * e1 + best.y() * e2).transpose();
  axes.row(1) = up.transpose();
  axes.row(2) = axes.row(0).cross(axes.row(1));
  return axes;
}

Mat3 principal_axes(const std::vector<Vec3>& points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Mat3 covariance = Mat3::Zero();
  for (const Vec3& p : points) covariance += (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvectors().transpose();
}

}  // namespace

Mat3 near_global(const Mat3& axes) {
  constexpr std::array<std::array<int, 3>, 6> permutations = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  const std::array<int, 3>* best = &permutations[0];
  double best_sum = -1;
  for (const auto& permutation : permutations) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += std::abs(axes(permutation[static_cast<std::size_t>(i)], i));
    // A diagonal part ties: noise must not decide between two equally good orders.
    if (sum > best_sum + 1e-6) best_sum = sum, best = &permutation;
  }
  Mat3 ordered;
  for (int i = 0; i < 3; ++i) {
    ordered.row(i) = axes.row((*best)[static_cast<std::size_t>(i)]);
    if (ordered(i, i) < -1e-9) ordered.row(i) *= -1;
  }
  if (ordered.determinant() < 0) {
    int weakest = 0;
    for (int i = 1; i < 3; ++i) {
      if (ordered(i, i) < ordered(weakest, weakest) - 1e-9) weakest = i;
    }
    ordered.row(weakest) *= -1;
  }
  return ordered;
}

Hexahedron oriented_box(const PartMesh& mesh) {
  const std::vector<Vec3> points = used_vertices(mesh);
  PARSEL_ASSERT(!points.empty(), "a part has a triangle");
  const std::vector<Vec3> extremes = extreme_points(points);

  const double aligned_volume = extent_along(points, Mat3::Identity()).volume();
  Mat3 turned = Mat3::Identity();
  double turned_volume = aligned_volume;
  for (int axis = 0; axis < 3; ++axis) {
    const Mat3 axes = tightest_about(extremes, Mat3::Identity().row(axis).transpose());
    const double volume = extent_along(extremes, axes).volume();
    if (volume < turned_volume * (1 - 1e-6)) turned_volume = volume, turned = axes;
  }
  Mat3 free = principal_axes(extremes);
  for (int round = 0; round < 6; ++round) free = tightest_about(extremes, free.row(round % 3).transpose());
  const double free_volume = extent_along(extremes, free).volume();

  Mat3 axes = Mat3::Identity();
  if (aligned_volume > axis_snap_ratio * std::min(turned_volume, free_volume)) {
    axes = near_global(turned_volume <= 1.1 * free_volume ? turned : free);
  }
  const Extent extent = extent_along(points, axes);
  const Vec3 half = ((extent.high - extent.low) / 2).cwiseMax(min_half_extent);
  return make_box(axes.transpose() * ((extent.low + extent.high) / 2), axes, half);
}

}  // namespace parsel
