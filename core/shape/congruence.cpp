#include "core/shape/congruence.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace parsel {

Congruence::Congruence(const PartData<PartMesh>& meshes, const SymmetryOptions& options)
    : meshes_(meshes), options_(options) {
  for (const PartMesh& mesh : meshes) {
    Measures m;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    Vec3 moment = Vec3::Zero();
    for (const Triangle& t : mesh.triangles) {
      const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
      low = low.cwiseMin(a).cwiseMin(b).cwiseMin(c);
      high = high.cwiseMax(a).cwiseMax(b).cwiseMax(c);
      const double area = (b - a).cross(c - a).norm() / 2;
      m.area += area;
      moment += area * (a + b + c) / 3;
    }
    m.centre = (low + high) / 2;
    m.half = (high - low) / 2;
    m.centroid = m.area > 0 ? Vec3(moment / m.area) : m.centre;
    measures_.push_back(m);
    surfaces_.push_back(nullptr);
  }
}

const Congruence::Surface& Congruence::surface(PartIndex p) {
  if (!surfaces_[p]) {
    const double distance = std::clamp(options_.surface * measures_[p].half.norm(), options_.finest, options_.position);
    auto made = std::make_unique<Surface>();
    made->samples = sample_surface(meshes_[p], options_.samples);
    made->grid = std::make_unique<SurfaceGrid>(meshes_[p], distance);
    surfaces_[p] = std::move(made);
  }
  return *surfaces_[p];
}

bool Congruence::lies_on(const Surface& from, const Vec3& from_centre, const Surface& to, const Vec3& to_centre,
                         const Mat3& linear) const {
  const auto allowed = static_cast<std::size_t>((1 - options_.agreeing) * static_cast<double>(from.samples.size()));
  std::size_t misses = 0;
  for (const Vec3& sample : from.samples) {
    if (!to.grid->near(to_centre + linear * (sample - from_centre)) && ++misses > allowed) return false;
  }
  return true;
}

bool Congruence::carries(PartIndex a, PartIndex b, const Mat3& linear, bool about_centroids) {
  const Surface &sa = surface(a), &sb = surface(b);
  const Vec3 ca = about_centroids ? centroid(a) : centre(a), cb = about_centroids ? centroid(b) : centre(b);
  return lies_on(sa, ca, sb, cb, linear) && lies_on(sb, cb, sa, ca, linear.transpose());
}

}  // namespace parsel
