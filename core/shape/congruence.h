// Whether a part is the moved image of another, verified on their surfaces.
#pragma once

#include <memory>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/index.h"
#include "core/shape/part.h"
#include "core/shape/surface.h"
#include "core/shape/symmetry_options.h"

namespace parsel {

/// Samples, grids and measures of parts, made when first needed.
class Congruence {
 public:
  Congruence(const PartData<PartMesh>& meshes, const SymmetryOptions& options);

  /// Centre and half extents of the axis-aligned box.
  const Vec3& centre(PartIndex p) const { return measures_[p].centre; }
  const Vec3& half_extents(PartIndex p) const { return measures_[p].half; }
  /// Mean of the surface by area, which turns with the part, unlike centre().
  const Vec3& centroid(PartIndex p) const { return measures_[p].centroid; }
  double area(PartIndex p) const { return measures_[p].area; }

  /// Whether `linear` (orthogonal), applied about centre(a) and followed by the move to centre(b), carries a's surface
  /// onto b's and back. With `about_centroids` the centroids take the place of the centres.
  bool carries(PartIndex a, PartIndex b, const Mat3& linear, bool about_centroids = false);

 private:
  struct Measures {
    Vec3 centre, half, centroid;
    double area = 0;
  };
  struct Surface {
    std::vector<Vec3> samples;
    std::unique_ptr<SurfaceGrid> grid;
  };
  const Surface& surface(PartIndex p);
  bool lies_on(const Surface& from, const Vec3& from_centre, const Surface& to, const Vec3& to_centre,
               const Mat3& linear) const;

  const PartData<PartMesh>& meshes_;
  const SymmetryOptions& options_;
  PartData<Measures> measures_;
  PartData<std::unique_ptr<Surface>> surfaces_;
};

}  // namespace parsel
