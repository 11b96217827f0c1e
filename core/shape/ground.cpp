#include "core/shape/ground.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/result.h"
#include "core/shape/attachment.h"

namespace parsel {
namespace {

/// The surface up to this far above a part's lowest point is its footprint. Less, and feet that are cut a little askew
/// stand on a corner; more, and a ball stands on a disc.
constexpr double print_depth = 2e-3;
/// tan 6°, the tilt that a lamp has to bear (IEC 60598-1). Less, and what hangs or leans stands; more, and tall stools
/// do not.
constexpr double least_tilt = 0.105;
/// The base's share of the narrower side. Less, and a ceiling fan stands on its globe; more, and a sunshade does not.
constexpr double least_base = 0.1;
/// An edge of a hull that is shorter than this is two roundings of one point, and has no direction.
constexpr double rounding = 1e-9;

/// Area and moment of a surface, and its ends along the axes.
struct Mass {
  double area = 0;
  Vec3 moment = Vec3::Zero();
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
};

Mass mass_of(const PartMesh& mesh) {
  Mass mass;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const double area = (b - a).cross(c - a).norm() / 2;
    mass.area += area;
    mass.moment += area * (a + b + c) / 3;
    mass.low = mass.low.cwiseMin(a).cwiseMin(b).cwiseMin(c);
    mass.high = mass.high.cwiseMax(a).cwiseMax(b).cwiseMax(c);
  }
  return mass;
}

/// Twice the signed area of a triangle seen from above.
double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.z() - a.z()) * (c.x() - a.x()) - (b.x() - a.x()) * (c.z() - a.z());
}

/// Convex hull seen from above, counter-clockwise about +Y (Andrew 1979).
Footprint hull(std::vector<Vec3> points) {
  const auto before = [](const Vec3& a, const Vec3& b) { return a.x() < b.x() || (a.x() == b.x() && a.z() < b.z()); };
  std::sort(points.begin(), points.end(), before);
  const auto same = [](const Vec3& a, const Vec3& b) { return a.x() == b.x() && a.z() == b.z(); };
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  if (points.size() < 3) return points;
  Footprint out;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = out.size();
    for (const Vec3& p : points) {
      while (out.size() >= start + 2 && turn(out[out.size() - 2], out.back(), p) <= 0) out.pop_back();
      out.push_back(p);
    }
    out.pop_back();  // the other side starts with it
    std::reverse(points.begin(), points.end());
  }
  return out;
}

Footprint print_of(const PartMesh& mesh, double low) {
  const double level = low + print_depth;
  std::vector<Vec3> points;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = mesh.positions[t[i]], &b = mesh.positions[t[(i + 1) % 3]];
      if (a.y() <= level) points.emplace_back(a.x(), low, a.z());
      if ((a.y() <= level) == (b.y() <= level)) continue;
      const Vec3 cut = a + (level - a.y()) / (b.y() - a.y()) * (b - a);
      points.emplace_back(cut.x(), low, cut.z());
    }
  }
  return hull(std::move(points));
}

/// How far inside the hull a point is, seen from above; negative outside.
double depth_inside(const Footprint& hull, const Vec3& point) {
  if (hull.size() < 3) return -std::numeric_limits<double>::infinity();
  double depth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec3 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    const double length = std::hypot(b.x() - a.x(), b.z() - a.z());
    if (length > rounding) depth = std::min(depth, turn(a, b, point) / length);
  }
  return depth;
}

bool could_stand(const PartData<Footprint>& prints, const Mass& whole) {
  std::vector<Vec3> all;
  for (const Footprint& print : prints) all.insert(all.end(), print.begin(), print.end());
  const Vec3 centre = whole.moment / whole.area;
  const Vec3 size = whole.high - whole.low;
  const double least =
      std::max(least_tilt * (centre.y() - whole.low.y()), least_base * std::min(size.x(), size.z()) / 2);
  return depth_inside(hull(std::move(all)), centre) >= least;
}

}  // namespace

PartData<Footprint> footprints(const PartData<PartMesh>& meshes) {
  Mass whole;
  std::vector<double> lows;
  for (const PartMesh& mesh : meshes) {
    const Mass mass = mass_of(mesh);
    whole.area += mass.area;
    whole.moment += mass.moment;
    whole.low = whole.low.cwiseMin(mass.low);
    whole.high = whole.high.cwiseMax(mass.high);
    lows.push_back(mass.low.y());
  }
  PartData<Footprint> prints(meshes.size());
  if (!(whole.area > 0)) return prints;  // wires have no mean
  // Whether the whole could stand is asked of all that nearly touches the floor: one foot may be a little short.
  const double floor = whole.low.y();
  for (const PartIndex p : meshes.indices()) {
    if (lows[p.value()] <= floor + far_contact_distance) prints[p] = print_of(meshes[p], lows[p.value()]);
  }
  const bool stands = could_stand(prints, whole);
  for (const PartIndex p : meshes.indices()) {
    if (!stands || lows[p.value()] > floor + contact_distance) prints[p].clear();
  }
  return prints;
}

Ground ground_contact(const Hexahedron& box, const std::vector<Footprint>& prints) {
  int up = 0;
  box.axes.col(1).cwiseAbs().maxCoeff(&up);
  Vec3 along = box.axes.row((up + 1) % 3).transpose();
  along.y() = 0;
  along.normalize();  // the two axes that are not the most upright lean by less than 55° each
  const Vec3 across = Vec3::UnitY().cross(along);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Footprint& print : prints) {
    for (const Vec3& p : print) {
      const Vec3 q(along.dot(p), p.y(), across.dot(p));
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
  }
  PARSEL_ASSERT(low.allFinite(), "what stands on the floor has a footprint");
  for (const int axis : {0, 2}) {
    if (high[axis] - low[axis] < distinct_points) low[axis] = high[axis] = (low[axis] + high[axis]) / 2;
  }
  Ground ground;
  for (const double x : {low[0], high[0]}) {
    for (const double z : {low[2], high[2]}) {
      const Vec3 point = x * along + low.y() * Vec3::UnitY() + z * across;
      const bool repeated = std::find(ground.points.begin(), ground.points.end(), point) != ground.points.end();
      if (repeated) continue;
      ground.points.push_back(point);
      ground.local.push_back(local_on_features(box, point));
    }
  }
  return ground;
}

}  // namespace parsel
