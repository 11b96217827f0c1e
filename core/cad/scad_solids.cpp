#include "core/cad/scad_solids.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/base/tolerance.h"
#include "core/cad/scad_token.h"

namespace parsel::cad {

namespace {

/// $fn as the number of corners of a prism; 0 where the solid counts as round.
int corners(const CallArguments& given, const Evaluator& evaluator) {
  constexpr double roundest_prism = 15;
  const Value fn = given.has("$fn") ? given["$fn"] : evaluator.special("$fn");
  if (!fn.number() || !(fn.number()->value > 0)) return 0;
  const double count = std::max(3.0, std::floor(fn.number()->value));
  return count <= roundest_prism ? static_cast<int>(count) : 0;
}

/// A radius given as such or as a diameter, with the literal; the radius is half the literal then.
std::optional<Number> radius(const CallArguments& given, std::string_view r, std::string_view d) {
  if (const auto diameter = given.number(d)) return Number{diameter->value / 2, diameter->literal};
  return given.number(r);
}

ReadSolid read_cube(const CallArguments& given, double depth_of_two) {
  const auto size = given.triple("size", depth_of_two, true);
  if (given["size"].vector() == nullptr && given["size"].number() == nullptr && given.has("size")) {
    given.refuse("its size is no number or vector", "write cube([width, depth, height])");
  }
  ReadSolid solid;
  if (size) {
    solid.raw.size = size->value;
    solid.literals = size->literals;
  }
  if (!given.is_true("center")) solid.raw.centre = solid.raw.size / 2;
  return solid;
}

ReadSolid read_cylinder(const CallArguments& given, int sides) {
  const Number height = given.number("h").value_or(Number{1, {}});
  const Number both = radius(given, "r", "d").value_or(Number{1, {}});
  const Number low = radius(given, "r1", "d1").value_or(both), high = radius(given, "r2", "d2").value_or(both);
  if (low.value < 0 || high.value < 0) given.refuse("a radius is negative", "use a positive one");
  ReadSolid solid;
  solid.raw.kind = low.value == high.value ? Kind::cylinder : Kind::cone;
  solid.raw.size = {2 * low.value, 2 * low.value, height.value};
  solid.raw.top = solid.raw.kind == Kind::cone ? 2 * high.value : 0;
  solid.raw.sides = sides;
  if (!given.is_true("center")) solid.raw.centre.z() = height.value / 2;
  solid.literals = {low.literal, low.literal, height.literal};
  return solid;
}

ReadSolid read_sphere(const CallArguments& given) {
  const Number r = radius(given, "r", "d").value_or(Number{1, {}});
  ReadSolid solid;
  solid.raw.kind = Kind::sphere;
  solid.raw.size = Vec3::Constant(2 * r.value);
  solid.literals.fill(r.literal);
  return solid;
}

ReadSolid read_polyhedron(const CallArguments& given) {
  const Vector* points = given["points"].vector();
  if (!points || points->empty()) given.refuse("it has no points", "give it points");
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Value& point : *points) {
    const Vector* xyz = point.vector();
    for (std::size_t i = 0; i < 3; ++i) {
      const Number* number = xyz && xyz->size() == 3 ? (*xyz)[i].number() : nullptr;
      if (!number || !(std::abs(number->value) <= Limits::coordinate)) {
        given.refuse("a point is not made of three numbers", "write [x, y, z]");
      }
      const int axis = static_cast<int>(i);
      low[axis] = std::min(low[axis], number->value);
      high[axis] = std::max(high[axis], number->value);
    }
  }
  ReadSolid solid;
  solid.raw.kind = Kind::opaque;
  solid.raw.centre = (low + high) / 2;
  solid.raw.size = high - low;
  return solid;
}

/// A flat shape stands from 0 to the height, or about 0.
ReadSolid extruded(ReadSolid solid, const Extrusion& extrusion) {
  solid.raw.size.z() = extrusion.height.value;
  solid.raw.centre.z() = extrusion.is_centred ? 0 : extrusion.height.value / 2;
  solid.literals[2] = extrusion.height.literal;
  if (solid.raw.kind == Kind::cylinder && extrusion.scale != 1) {
    solid.raw.kind = Kind::cone;
    solid.raw.top = extrusion.scale * solid.raw.size.x();
  }
  return solid;
}

Mat3 turn(double degrees, int axis) {
  Mat3 m = Mat3::Identity();
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  m(u, u) = m(v, v) = cos_degrees(degrees);
  m(v, u) = sin_degrees(degrees);
  m(u, v) = -m(v, u);
  return m;
}

Map read_rotation(const CallArguments& given) {
  Map map;
  const Value& angle = given["a"];
  const auto about = given.triple("v", 0, false);
  if (angle.number()) {
    const double degrees = given.number("a")->value;
    if (!about) {
      map.linear = turn(degrees, 2);
      return map;
    }
    if (!(about->value.norm() > 0)) return map;  // as OpenSCAD has it
    for (int axis = 0; axis < 3; ++axis) {
      if (about->value[axis] != 0 && about->value.cwiseAbs().sum() == std::abs(about->value[axis])) {
        map.linear = turn(about->value[axis] > 0 ? degrees : -degrees, axis);
        return map;
      }
    }
    map.linear = Eigen::AngleAxisd(degrees * pi / 180, about->value.normalized()).toRotationMatrix();
    return map;
  }
  const auto angles = given.triple("a", 0, false);
  if (!angles) given.refuse("its angle is missing", "give it an angle or three");
  map.linear = turn(angles->value.z(), 2) * turn(angles->value.y(), 1) * turn(angles->value.x(), 0);
  return map;
}

Map read_matrix(const CallArguments& given) {
  Map map;
  const Vector* rows = given["m"].vector();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector* row = rows && i < rows->size() ? (*rows)[i].vector() : nullptr;
    for (std::size_t j = 0; j < 4; ++j) {
      const Number* number = row && j < row->size() ? (*row)[j].number() : nullptr;
      if (!number || !(std::abs(number->value) <= Limits::coordinate)) {
        given.refuse("its matrix is not made of 4 × 4 numbers", "write four rows of four numbers");
      }
      const int r = static_cast<int>(i);
      (j < 3 ? map.linear(r, static_cast<int>(j)) : map.offset[r]) = number->value;
    }
  }
  return map;
}

}  // namespace

std::optional<ReadSolid> read_solid(Evaluator& evaluator, const Statement& call, const Scope& scope,
                                    const std::optional<Extrusion>& extrusion) {
  const std::string& name = call.name;
  const auto arguments = [&](std::initializer_list<std::string_view> names) {
    return CallArguments(evaluator, call, scope, names);
  };
  if (name == "square" || name == "circle") {
    const CallArguments given = name == "square" ? arguments({"size", "center"}) : arguments({"r"});
    if (!extrusion) given.refuse("a flat shape is no solid", "put it under linear_extrude");
    if (name == "circle") return extruded(read_cylinder(given, corners(given, evaluator)), *extrusion);
    if (extrusion->scale != 1) given.refuse("an extrusion that narrows is read of circles alone", "take its scale out");
    return extruded(read_cube(given, 1), *extrusion);
  }
  std::optional<ReadSolid> solid;
  if (name == "cube") solid = read_cube(arguments({"size", "center"}), 1);
  if (name == "sphere") solid = read_sphere(arguments({"r"}));
  if (name == "polyhedron") solid = read_polyhedron(arguments({"points", "faces"}));
  if (name == "cylinder") {
    const CallArguments given = arguments({"h", "r1", "r2", "center"});
    solid = read_cylinder(given, corners(given, evaluator));
  }
  if (solid && extrusion) throw Refused{refusal(call.place, name + " is no flat shape", "take linear_extrude away")};
  return solid;
}

std::optional<Map> read_map(Evaluator& evaluator, const Statement& call, const Scope& scope) {
  const auto arguments = [&](std::initializer_list<std::string_view> names) {
    return CallArguments(evaluator, call, scope, names);
  };
  Map map;
  if (call.name == "translate") {
    const CallArguments given = arguments({"v"});
    const auto by = given.triple("v", 0, false);
    if (!by) given.refuse("its vector is missing", "write translate([x, y, z])");
    map.offset = by->value;
  } else if (call.name == "scale") {
    const CallArguments given = arguments({"v"});
    const auto by = given.triple("v", 1, true);
    if (!by) given.refuse("its factors are missing", "write scale([x, y, z])");
    map.linear = by->value.asDiagonal();
  } else if (call.name == "rotate") {
    map = read_rotation(arguments({"a", "v"}));
  } else if (call.name == "mirror") {
    const CallArguments given = arguments({"v"});
    const auto normal = given.triple("v", 0, false);
    if (normal && normal->value.norm() > 0) {
      const Vec3 n = normal->value.normalized();
      map.linear -= 2 * n * n.transpose();
    }
  } else if (call.name == "multmatrix") {
    map = read_matrix(arguments({"m"}));
  } else {
    return std::nullopt;
  }
  return map;
}

Extrusion read_extrusion(const CallArguments& given) {
  Extrusion made;
  made.height = given.number("height").value_or(Number{100, {}});
  made.is_centred = given.is_true("center");
  if (const auto twist = given.number("twist"); twist && twist->value != 0) {
    given.refuse("it twists", "take its twist out");
  }
  if (const auto scale = given.triple("scale", 1, true)) {
    made.scale = scale->value.x();
    if (scale->value.x() != scale->value.y() || !(made.scale >= 0)) {
      given.refuse("it scales its two directions differently", "give both one factor of at least 0");
    }
  }
  return made;
}

void refuse_module(const Statement& call) {
  constexpr std::string_view known[] = {"minkowski",      "text",    "import", "surface",
                                        "rotate_extrude", "polygon", "offset", "resize",
                                        "projection",     "roof",    "fill"};
  if (std::find(std::begin(known), std::end(known), call.name) != std::end(known)) {
    throw Refused{refusal(call.place, call.name + " is not read: it has no parameters that a family could vary",
                          "take it out, or replace it by cubes, cylinders and spheres")};
  }
  throw Refused{refusal(call.place, "no module is called '" + printable(call.name, 40) + "'",
                        "define it, or open the .csg that OpenSCAD writes of this program")};
}

}  // namespace parsel::cad
