#include "core/shape/frame.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/tolerance.h"

namespace parsel {
namespace {

constexpr double quarter = pi / 2;
constexpr double degree = pi / 180;

struct Facing {
  double yaw;  ///< of the normal about +y, from +x, modulo a quarter turn: [0, π/2)
  double area;
};

/// From `to` to `yaw`, modulo a quarter turn: [-π/4, π/4].
double offset(double yaw, double to) {
  return std::remainder(yaw - to, quarter);
}

std::vector<Facing> upright_faces(const PartData<PartMesh>& meshes, double upright) {
  std::vector<Facing> faces;
  for (const PartMesh& mesh : meshes) {
    for (const Triangle& t : mesh.triangles) {
      const Vec3 normal =
          (mesh.positions[t[1]] - mesh.positions[t[0]]).cross(mesh.positions[t[2]] - mesh.positions[t[0]]) / 2;
      const double area = normal.norm();
      if (!(area > 0) || std::abs(normal.y()) > upright * area) continue;
      const double yaw = std::fmod(std::atan2(-normal.z(), normal.x()) + 2 * pi, quarter);
      faces.push_back({yaw, area});
    }
  }
  return faces;
}

double area_near(const std::vector<Facing>& faces, double yaw, double within) {
  double area = 0;
  for (const Facing& face : faces) area += std::abs(offset(face.yaw, yaw)) <= within ? face.area : 0;
  return area;
}

/// The yaw in whose neighbourhood the most area lies, to the precision of the faces themselves.
double densest(const std::vector<Facing>& faces, double within) {
  constexpr std::size_t bins = 360;
  std::array<double, bins> histogram{};
  for (const Facing& face : faces) {
    histogram[std::min(bins - 1, static_cast<std::size_t>(face.yaw / quarter * bins))] += face.area;
  }
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < bins; ++i) {
    const double here = histogram[(i + bins - 1) % bins] + histogram[i] + histogram[(i + 1) % bins];
    if (here > most) most = here, best = i;
  }
  double yaw = (static_cast<double>(best) + 0.5) * quarter / bins;
  // Narrower every time: what is truly parallel decides, not what leans towards it.
  for (const double narrowing : {2.0, 1.0, 0.3, 0.1, 0.03}) {
    double area = 0, moment = 0;
    for (const Facing& face : faces) {
      const double off = offset(face.yaw, yaw);
      if (std::abs(off) > narrowing * within) continue;
      area += face.area;
      moment += face.area * off;
    }
    if (!(area > 0)) break;
    yaw += moment / area;
  }
  return yaw;
}

}  // namespace

Mat3 own_axes(const PartData<PartMesh>& meshes, const FrameOptions& options) {
  const std::vector<Facing> faces = upright_faces(meshes, options.upright);
  double all = 0;
  for (const Facing& face : faces) all += face.area;
  const double within = options.along * degree;
  const double yaw = offset(densest(faces, within), 0);
  const double held = area_near(faces, yaw, within);
  if (std::abs(yaw) < options.turned * degree || !(held > options.share * all) ||
      held < options.clearer * area_near(faces, 0, within)) {
    return Mat3::Identity();
  }
  return Eigen::AngleAxisd(yaw, Vec3::UnitY()).toRotationMatrix().transpose();
}

void turn_into(const Mat3& axes, PartData<PartMesh>& meshes, Frame& frame) {
  if (axes == Mat3::Identity()) return;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (PartMesh& mesh : meshes) {
    for (Vec3& p : mesh.positions) p = axes * p;
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t v : triangle) {
        low = low.cwiseMin(mesh.positions[v]);
        high = high.cwiseMax(mesh.positions[v]);
      }
    }
  }
  const Vec3 middle = (low + high) / 2;
  const double scale = (high - low).norm() / 2;
  for (PartMesh& mesh : meshes) {
    for (Vec3& p : mesh.positions) p = (p - middle) / scale;
  }
  const Mat3 turned = axes * frame.axes;
  frame.centre += frame.scale * (turned.transpose() * middle);
  frame.scale *= scale;
  frame.axes = turned;
}

}  // namespace parsel
