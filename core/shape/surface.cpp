#include "core/shape/surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/base/result.h"

namespace parsel {
namespace {

double area(const PartMesh& mesh, const Triangle& t) {
  return (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]).norm() / 2;
}

}  // namespace

std::vector<Vec3> sample_surface(const PartMesh& mesh, std::size_t count) {
  std::vector<Vec3> points;
  points.reserve(count);
  for (const SurfaceSample& sample : sample_triangles(mesh, count)) points.push_back(sample.point);
  return points;
}

std::vector<SurfaceSample> sample_triangles(const PartMesh& mesh, std::size_t count) {
  std::vector<double> cumulative;
  cumulative.reserve(mesh.triangles.size());
  double total = 0;
  for (const Triangle& t : mesh.triangles) cumulative.push_back(total += area(mesh, t));
  std::vector<SurfaceSample> samples;
  samples.reserve(count);
  Random random(0x5eed);
  for (std::size_t i = 0; i < count; ++i) {
    const double target = total * (static_cast<double>(i) + random.unit()) / static_cast<double>(count);
    auto found =
        static_cast<std::size_t>(std::upper_bound(cumulative.begin(), cumulative.end(), target) - cumulative.begin());
    // A surface without area (a wire) is sampled at its triangles in turn.
    if (!(total > 0)) found = i % mesh.triangles.size();
    found = std::min(found, mesh.triangles.size() - 1);
    const Triangle& t = mesh.triangles[found];
    double u = random.unit(), v = random.unit();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3& a = mesh.positions[t[0]];
    samples.push_back(
        {a + u * (mesh.positions[t[1]] - a) + v * (mesh.positions[t[2]] - a), static_cast<std::uint32_t>(found)});
  }
  return samples;
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.norm();
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.norm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return d1 - d3 > 0 ? (ap - d1 / (d1 - d3) * ab).norm() : ap.norm();
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.norm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return d2 - d6 > 0 ? (ap - d2 / (d2 - d6) * ac).norm() : ap.norm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double along = (d4 - d3) + (d5 - d6);
    return along > 0 ? (bp - (d4 - d3) / along * (c - b)).norm() : bp.norm();
  }
  const double sum = va + vb + vc;
  if (!(sum > 0)) return std::min({ap.norm(), bp.norm(), cp.norm()});  // a sliver: rounding left no face
  return (ap - vb / sum * ab - vc / sum * ac).norm();
}

SurfaceGrid::SurfaceGrid(const PartMesh& mesh, double distance) : mesh_(mesh), distance_(distance) {
  PARSEL_ASSERT(distance > 0, "a distance within which to look");
  low_.setConstant(std::numeric_limits<double>::infinity());
  high_ = -low_;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      low_ = low_.cwiseMin(mesh.positions[v]);
      high_ = high_.cwiseMax(mesh.positions[v]);
    }
  }
  low_.array() -= distance;
  high_.array() += distance;
  // About two cells a triangle, none smaller than the distance: each triangle is put into every cell that its box,
  // grown by the distance, touches, so a query looks into one cell only.
  const Vec3 size = high_ - low_;
  const double wanted = std::cbrt(size.prod() / (2.0 * static_cast<double>(mesh.triangles.size())));
  const double edge = std::max(wanted, distance);
  std::size_t total = 1;
  for (int axis = 0; axis < 3; ++axis) {
    cells_[static_cast<std::size_t>(axis)] = std::clamp(static_cast<int>(size[axis] / edge), 1, 128);
    cell_size_[axis] = size[axis] / cells_[static_cast<std::size_t>(axis)];
    total *= static_cast<std::size_t>(cells_[static_cast<std::size_t>(axis)]);
  }
  starts_.assign(total + 1, 0);
  // Counting sort: count, sum up, fill.
  const auto for_each_cell = [&](const Triangle& t, const auto& visit) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const std::array<int, 3> first = cell_of(a.cwiseMin(b).cwiseMin(c).array() - distance);
    const std::array<int, 3> last = cell_of(a.cwiseMax(b).cwiseMax(c).array() + distance);
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) visit(cell({x, y, z}));
      }
    }
  };
  for (const Triangle& t : mesh.triangles) for_each_cell(t, [&](std::size_t c) { ++starts_[c + 1]; });
  for (std::size_t c = 0; c < total; ++c) starts_[c + 1] += starts_[c];
  triangles_.resize(starts_[total]);
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for_each_cell(mesh.triangles[i], [&](std::size_t c) { triangles_[next[c]++] = static_cast<std::uint32_t>(i); });
  }
}

std::size_t SurfaceGrid::cell(const std::array<int, 3>& at) const {
  return static_cast<std::size_t>((at[2] * cells_[1] + at[1]) * cells_[0] + at[0]);
}

std::array<int, 3> SurfaceGrid::cell_of(const Vec3& point) const {
  std::array<int, 3> at;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    at[i] = std::clamp(static_cast<int>((point[axis] - low_[axis]) / cell_size_[axis]), 0, cells_[i] - 1);
  }
  return at;
}

bool SurfaceGrid::near(const Vec3& point) const {
  if ((point.array() < low_.array()).any() || (point.array() > high_.array()).any()) return false;
  const std::size_t c = cell(cell_of(point));
  for (std::uint32_t i = starts_[c]; i < starts_[c + 1]; ++i) {
    const Triangle& t = mesh_.triangles[triangles_[i]];
    const Vec3 &p0 = mesh_.positions[t[0]], &p1 = mesh_.positions[t[1]], &p2 = mesh_.positions[t[2]];
    if (distance_to_triangle(point, p0, p1, p2) <= distance_) return true;
  }
  return false;
}

std::optional<std::uint32_t> SurfaceGrid::nearest(const Vec3& point) const {
  if ((point.array() < low_.array()).any() || (point.array() > high_.array()).any()) return std::nullopt;
  const std::size_t c = cell(cell_of(point));
  std::optional<std::uint32_t> best;
  double least = distance_;
  for (std::uint32_t i = starts_[c]; i < starts_[c + 1]; ++i) {
    const Triangle& t = mesh_.triangles[triangles_[i]];
    const double distance =
        distance_to_triangle(point, mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]);
    if (distance > least) continue;
    least = distance;
    best = triangles_[i];
  }
  return best;
}

}  // namespace parsel
