#include "core/export/apply_cage.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/gltf/transform.h"

namespace parsel::apply {
namespace {

/// Nₖ(u) for all k, and ∂Nₖ/∂u in the columns 1 … 3.
Eigen::Matrix<double, 8, 4> shape_functions(const Vec3& u) {
  Eigen::Matrix<double, 8, 4> n;
  for (int k = 0; k < 8; ++k) {
    const Vec3 sign(corner_sign(k, 0), corner_sign(k, 1), corner_sign(k, 2));
    const Vec3 f = (Vec3::Ones() + sign.cwiseProduct(u)) / 2;
    n.row(k) << f[0] * f[1] * f[2], sign[0] / 2 * f[1] * f[2], sign[1] / 2 * f[0] * f[2], sign[2] / 2 * f[0] * f[1];
  }
  return n;
}

/// Half edge vectors of a box or parallelepiped, in columns.
Mat3 half_edges(const Corners& corners) {
  Mat3 edges = Mat3::Zero();
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) edges.col(axis) += corners.row(k).transpose() * corner_sign(k, axis) / 8;
  }
  return edges;
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
  const double length = v.norm();
  return std::isfinite(length) && length > 1e-150 ? Vec3(v / length) : otherwise;
}

}  // namespace

Vec3 CageMap::point(const Vec3& p, const Corners& c) const {
  return c.transpose() * shape_functions(to_local * p + offset).col(0);
}

Mat3 CageMap::jacobian(const Vec3& p, const Corners& c) const {
  return c.transpose() * shape_functions(to_local * p + offset).rightCols<3>() * to_local;
}

Vec3 transform_normal(const Mat3& jacobian, const Vec3& n) {
  // Cofactors instead of the inverse: finite where the cage is flat, too.
  Mat3 cofactors;
  for (int i = 0; i < 3; ++i) cofactors.col(i) = jacobian.col((i + 1) % 3).cross(jacobian.col((i + 2) % 3));
  return unit_or(cofactors * n * (jacobian.determinant() < 0 ? -1.0 : 1.0), n);
}

Vec3 transform_tangent(const Mat3& jacobian, const Vec3& t) {
  return unit_or(jacobian * t, t);
}

std::optional<CageMap> make_cage_map(const Frame& frame, const Corners& rest, const Eigen::Affine3d& rest_world,
                                     const Corners& corners, const Eigen::Affine3d& world, bool moves) {
  const Mat3 edges = half_edges(rest);
  if (!gltf::independent_columns(edges) || !gltf::independent_columns(rest_world.linear()) ||
      !gltf::independent_columns(world.linear()) || !(frame.scale > 0)) {
    return std::nullopt;
  }
  CageMap map;
  map.moves = moves;
  const Mat3 to_cage = edges.inverse() * frame.axes / frame.scale;  // from model coordinates
  const Vec3 centre = frame.to_model(rest.colwise().mean().transpose());
  map.to_local = to_cage * rest_world.linear();
  map.offset = to_cage * (rest_world.translation() - centre);
  const Eigen::Affine3d inverse = world.inverse(Eigen::Affine);
  for (int k = 0; k < 8; ++k) {
    map.corners.row(k) = (inverse * frame.to_model(corners.row(k).transpose())).transpose();
  }
  if (!map.to_local.allFinite() || !map.offset.allFinite() || !map.corners.allFinite()) return std::nullopt;
  return map;
}

void add_target(CageMap& map, const Frame& frame, const Corners& displacement, const Eigen::Affine3d& world) {
  const Mat3 inverse = world.linear().inverse() * frame.axes.transpose() * frame.scale;
  map.targets.push_back(displacement * inverse.transpose());
}

bool same_map(const CageMap& a, const CageMap& b) {
  if (a.moves != b.moves || a.targets.size() != b.targets.size()) return false;
  const Mat3 from_local = a.to_local.inverse();
  const double tolerance = 1e-7 * from_local.norm();
  for (int i = 0; i < 64; ++i) {
    const Vec3 u = Vec3(i & 3, i >> 2 & 3, i >> 4) * (2.0 / 3) - Vec3::Ones();
    const Vec3 p = from_local * (u - a.offset);
    if (!((a.point(p, a.corners) - b.point(p, b.corners)).norm() <= tolerance)) return false;
    for (std::size_t t = 0; t < a.targets.size(); ++t) {
      if (!((a.point(p, a.targets[t]) - b.point(p, b.targets[t])).norm() <= tolerance)) return false;
    }
  }
  return true;
}

std::optional<Eigen::Affine3d> affine_motion(const std::vector<Corners>& from, const std::vector<Corners>& to,
                                             double tolerance) {
  const auto rows = static_cast<Eigen::Index>(8 * from.size());
  Eigen::MatrixXd source(rows, 3), goal(rows, 3);
  for (std::size_t i = 0; i < from.size(); ++i) {
    source.middleRows<8>(static_cast<Eigen::Index>(8 * i)) = from[i];
    goal.middleRows<8>(static_cast<Eigen::Index>(8 * i)) = to[i];
  }
  const Eigen::RowVector3d source_mean = source.colwise().mean(), goal_mean = goal.colwise().mean();
  source.rowwise() -= source_mean;
  goal.rowwise() -= goal_mean;
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  // A translation is taken as exactly that, so that no rotation by rounding errors gets in.
  if (!((goal - source).cwiseAbs().maxCoeff() <= std::min(tolerance, 1e-9))) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(source);
    if (solver.rank() < 3) return std::nullopt;
    motion.linear() = solver.solve(goal).transpose();
    if (!((source * motion.linear().transpose() - goal).cwiseAbs().maxCoeff() <= tolerance)) return std::nullopt;
  }
  motion.translation() = goal_mean.transpose() - motion.linear() * source_mean.transpose();
  return motion;
}

}  // namespace parsel::apply
