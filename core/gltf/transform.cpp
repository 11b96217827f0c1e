#include "core/gltf/transform.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace parsel::gltf {
namespace {

/// A shorter quaternion is rounding noise rather than a direction.
constexpr double shortest_rotation = 1e-6;
/// Columns less perpendicular than this shear, which no rotation and scale can say.
constexpr double largest_shear = 1e-6;
/// A column shorter than this cannot be divided by its length.
constexpr double shortest_column = 1e-150;
/// Three unit columns that span less than this are in one plane but for rounding.
constexpr double smallest_volume = 1e-12;

template <int N>
std::optional<Eigen::Matrix<double, N, 1>> numbers(const nlohmann::json& node, const char* key) {
  const auto found = node.find(key);
  if (found == node.end() || !found->is_array() || found->size() != N) return std::nullopt;
  Eigen::Matrix<double, N, 1> out;
  for (int i = 0; i < N; ++i) {
    const nlohmann::json& number = (*found)[static_cast<std::size_t>(i)];
    if (!number.is_number()) return std::nullopt;
    out[i] = number.get<double>();
  }
  return out;
}

}  // namespace

Eigen::Affine3d Placement::matrix() const {
  Eigen::Affine3d out = Eigen::Affine3d::Identity();
  out.linear() = rotation.toRotationMatrix() * scale.asDiagonal();
  out.translation() = translation;
  return out;
}

Transform read_transform(const nlohmann::json& node) {
  Transform out;
  if (const auto m = numbers<16>(node, "matrix")) {
    out.matrix.emplace();
    out.matrix->matrix() = Eigen::Map<const Eigen::Matrix4d>(m->data());  // column-major, as Eigen's
    out.matrix->makeAffine();
  }
  if (const auto t = numbers<3>(node, "translation")) out.placement.translation = *t;
  if (const auto s = numbers<3>(node, "scale")) out.placement.scale = *s;
  if (const auto r = numbers<4>(node, "rotation")) {
    const Eigen::Quaterniond rotation((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
    const double length = rotation.norm();
    if (length > shortest_rotation && std::isfinite(length)) {
      out.placement.rotation = rotation.normalized();
    } else {
      out.sound = out.matrix.has_value();
    }
  }
  out.sound = out.sound && out.affine().matrix().allFinite();
  return out;
}

std::optional<Placement> decompose(const Eigen::Affine3d& transform, const Vec3& signs) {
  Placement out;
  out.translation = transform.translation();
  Mat3 axes = transform.linear();
  for (int i = 0; i < 3; ++i) {
    out.scale[i] = axes.col(i).norm() * (signs[i] < 0 ? -1 : 1);
    if (!std::isfinite(out.scale[i]) || std::abs(out.scale[i]) < shortest_column) return std::nullopt;
    axes.col(i) /= out.scale[i];
  }
  if (!((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() < largest_shear) || axes.determinant() < 0) {
    return std::nullopt;
  }
  out.rotation = Eigen::Quaterniond(axes).normalized();
  return out;
}

bool independent_columns(Mat3 m) {
  for (int i = 0; i < 3; ++i) {
    const double length = m.col(i).norm();
    if (!std::isfinite(length) || length < shortest_column) return false;
    m.col(i) /= length;
  }
  const double size = m.norm();
  return std::abs(m.determinant()) > smallest_volume * size * size * size;
}

}  // namespace parsel::gltf
