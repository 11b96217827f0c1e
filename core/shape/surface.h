// Surfaces as symmetry detection sees them: evenly spread samples of one, and a fast "is this point on it" for the
// other.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/geometry.h"
#include "core/shape/part.h"

namespace parsel {

/// `count` points spread over the surface by area, the same for the same mesh (stratified, seeded by a constant).
std::vector<Vec3> sample_surface(const PartMesh& mesh, std::size_t count);

struct SurfaceSample {
  Vec3 point;
  std::uint32_t triangle;
};
/// The same points, and the triangles that they lie on.
std::vector<SurfaceSample> sample_triangles(const PartMesh& mesh, std::size_t count);

/// A uniform grid over a mesh's triangles that answers whether a point lies within a fixed distance of the surface. The
/// distance is to the triangles themselves, not to samples of them, so the answer does not depend on a sampling
/// density.
class SurfaceGrid {
 public:
  /// `mesh` must outlive the grid. `distance` > 0, in the normalised frame.
  SurfaceGrid(const PartMesh& mesh, double distance);
  bool near(const Vec3& point) const;
  /// The triangle that is nearest to the point, if one is within the distance.
  std::optional<std::uint32_t> nearest(const Vec3& point) const;

 private:
  std::size_t cell(const std::array<int, 3>& at) const;
  std::array<int, 3> cell_of(const Vec3& point) const;

  const PartMesh& mesh_;
  double distance_;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero(), cell_size_ = Vec3::Ones();
  std::array<int, 3> cells_{1, 1, 1};
  std::vector<std::uint32_t> starts_;  ///< cell c's triangles are triangles_[starts_[c]] … triangles_[starts_[c+1]-1]
  std::vector<std::uint32_t> triangles_;
};

/// Distance of a point from a triangle (Ericson, Real-Time Collision Detection, §5.1.5).
double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace parsel
