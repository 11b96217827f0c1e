#include "core/cad/placing.h"

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/base/tolerance.h"

namespace parsel::cad {

double tidy(double value) {
  if (std::abs(value) < 1e-12) return 0;
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return std::strtod(text, nullptr);
}

Map to_gltf_frame() {
  Map map;
  map.linear << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return map;
}

namespace {

/// The only axis along which a vector has a component, or -1.
int only_axis(const Vec3& v) {
  int axis = 0;
  v.cwiseAbs().maxCoeff(&axis);
  for (int i = 0; i < 3; ++i) {
    if (i != axis && std::abs(v[i]) > 1e-9 * v.norm()) return -1;
  }
  return axis;
}

/// Half the box of a solid in any position: what its points reach along each global axis.
Vec3 half_box(const Raw& raw, const Mat3& m) {
  const Vec3 half = raw.size / 2;
  if (raw.kind == Kind::box || raw.kind == Kind::opaque) return m.cwiseAbs() * half;
  if (raw.kind == Kind::sphere) return (m * half.asDiagonal()).rowwise().norm();
  // Its widest disc at both ends: exact for a cylinder, never too small for a cone.
  const double wider = std::max(half.x(), raw.top / 2);
  const Vec3 disc = (m.leftCols<2>() * wider).rowwise().norm();
  return disc + m.col(2).cwiseAbs() * half.z();
}

/// Whether the discs of a round solid stay ellipses along the axes; `axis` is the one it now turns about.
bool is_round_along(const Mat3& m, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double scale = m.leftCols<2>().norm();
  if (m.row(axis).head<2>().norm() > 1e-9 * scale) return false;
  return std::abs(m.row(u).head<2>().dot(m.row(v).head<2>())) <= 1e-9 * scale * scale;
}

/// Fills in axis, sizes, top and phase; false when the solid does not lie along the axes.
bool place_round(const Raw& raw, const Mat3& m, Part& part) {
  const int axis = only_axis(m.col(2));
  if (axis < 0 || !is_round_along(m, axis)) return false;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  part.axis = axis;
  part.towards = m(axis, 2) > 0 ? 1 : -1;
  part.size[axis] = std::abs(m(axis, 2)) * raw.size.z();
  const double wide_u = m.row(u).head<2>().norm(), wide_v = m.row(v).head<2>().norm();
  part.size[u] = wide_u * raw.size.x();
  part.size[v] = wide_v * raw.size.y();
  part.top = wide_u * raw.top;
  if (part.kind == Kind::cone && raw.size.x() == 0) {  // a cone stands on its wide end
    part.towards = -part.towards;
    part.size[u] = wide_u * raw.top;
    part.size[v] = wide_v * raw.top;
    part.top = 0;
  }
  if (raw.sides == 0) return true;
  const int first = only_axis(m.col(0));
  if (first < 0) return false;
  part.sides = raw.sides;
  part.phase = (first == u ? 0 : 1) + (m(first, 0) < 0 ? 2 : 0);
  return true;
}

}  // namespace

std::optional<Part> placed(const Raw& raw, const Map& map) {
  Part part;
  part.kind = raw.kind;
  part.centre = map.linear * raw.centre + map.offset;
  bool is_along = true;
  if (raw.kind == Kind::sphere) {
    const Mat3 square = map.linear * map.linear.transpose();
    for (int i = 0; i < 3; ++i) {
      is_along &= std::abs(square(i, (i + 1) % 3)) <= 1e-9 * square.trace();
      part.size[i] = std::sqrt(square(i, i)) * raw.size[i];
    }
  } else if (raw.kind == Kind::cylinder || raw.kind == Kind::cone) {
    is_along = place_round(raw, map.linear, part);
  } else {
    for (int i = 0; i < 3; ++i) {
      const int axis = only_axis(map.linear.col(i));
      is_along &= axis >= 0;
      if (axis >= 0) part.size[axis] = std::abs(map.linear(axis, i)) * raw.size[i];
    }
  }
  if (!is_along) {
    part = Part{};
    part.kind = Kind::opaque;
    part.centre = map.linear * raw.centre + map.offset;
    part.size = 2 * half_box(raw, map.linear);
  }
  part.top = tidy(part.top);
  for (int i = 0; i < 3; ++i) {
    part.centre[i] = tidy(part.centre[i]);
    part.size[i] = tidy(part.size[i]);
    if (!(part.size[i] > 0)) return std::nullopt;
  }
  if (!(std::abs(map.linear.determinant()) > 0)) return std::nullopt;
  return part;
}

}  // namespace parsel::cad
