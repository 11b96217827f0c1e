#include "core/export/apply_change.h"

#include "core/export/apply_accessor.h"

namespace parsel::apply {
namespace {

Vec4 with_w(const Vec3& v, double w) {
  return {v[0], v[1], v[2], w};
}

}  // namespace

bool Change::agrees(const Change& other) const {
  if (role != other.role) return false;
  if (role == Role::untouched) return true;
  return position == other.position && base == other.base && target_position == other.target_position &&
         (map == other.map || same_map(*map, *other.map));
}

Status Source::load(std::size_t accessor) {
  if (values_.count(accessor) > 0) return success();
  const auto where = gltf::layout(document_, accessor);
  if (!where) return where.error();
  auto values = gltf::read_accessor(document_, accessor);
  if (!values) return values.error();
  values_[accessor] = {where->components, std::move(values).value()};
  return success();
}

Vec4 Source::element(std::size_t accessor, std::size_t i) const {
  const auto& [n, values] = values_.at(accessor);
  Vec4 out = Vec4::Zero();
  for (std::size_t c = 0; c < n; ++c) out[static_cast<Eigen::Index>(c)] = values[i * n + c];
  return out;
}

Vec4 changed(const Source& source, const Change& change, std::size_t accessor, std::size_t i) {
  const Vec4 old = source.element(accessor, i);
  const Vec3 value = old.head<3>();
  if (change.role == Role::untouched) return old;
  const CageMap& map = *change.map;
  if (change.role == Role::position) return with_w(map.point(value, map.corners), 0);
  const Vec3 p = source.element(*change.position, i).head<3>();
  if (!p.allFinite()) return old;
  if (change.role == Role::target_position) {
    return with_w(map.point(p + value, map.corners) - map.point(p, map.corners), 0);
  }
  const Mat3 jacobian = map.jacobian(p, map.corners);
  if (change.role == Role::normal) return with_w(transform_normal(jacobian, value), 0);
  if (change.role == Role::tangent) {
    return with_w(transform_tangent(jacobian, value), jacobian.determinant() < 0 ? -old[3] : old[3]);
  }
  const Vec3 q = change.target_position ? Vec3(p + source.element(*change.target_position, i).head<3>()) : p;
  const Mat3 moved = map.jacobian(q, map.corners);
  const Vec3 base = source.element(*change.base, i).head<3>();
  if (change.role == Role::target_normal) {
    return with_w(transform_normal(moved, base + value) - transform_normal(jacobian, base), 0);
  }
  return with_w(transform_tangent(moved, base + value) - transform_tangent(jacobian, base), 0);
}

}  // namespace parsel::apply
