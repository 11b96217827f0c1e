#include "core/cad/scad_print.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/amount/number.h"

namespace parsel::cad {

namespace {

/// Our axis as OpenSCAD's, and the sign of OpenSCAD's along ours.
constexpr int scad_axis[] = {0, 2, 1};
constexpr int scad_sign[] = {1, 1, -1};

/// Turns OpenSCAD's z into the axis of a round part.
std::string turn_text(const Part& part) {
  const int axis = scad_axis[part.axis];
  const int sign = scad_sign[part.axis] * (part.kind == Kind::cone ? part.towards : 1);
  if (axis == 0) return sign > 0 ? "rotate([0, 90, 0]) " : "rotate([0, -90, 0]) ";
  if (part.kind != Kind::cone) return axis == 1 ? "rotate([90, 0, 0]) " : "";
  if (axis == 1) return sign > 0 ? "rotate([-90, 0, 0]) " : "rotate([90, 0, 0]) ";
  return sign > 0 ? "" : "rotate([180, 0, 0]) ";
}

/// The same for a prism, whose first corner must come to lie where it was.
std::string prism_turn_text(const Part& part) {
  Vec3 z = Vec3::Zero(), x = Vec3::Zero();
  z[scad_axis[part.axis]] = scad_sign[part.axis] * part.towards;
  const int along = (part.axis + 1 + part.phase % 2) % 3;
  x[scad_axis[along]] = scad_sign[along] * (part.phase < 2 ? 1 : -1);
  const Vec3 y = z.cross(x);
  std::string text = "multmatrix([";
  for (int i = 0; i < 3; ++i) {
    text += "[" + decimal(x[i]) + ", " + decimal(y[i]) + ", " + decimal(z[i]) + ", 0], ";
  }
  return text + "[0, 0, 0, 1]]) ";
}

/// Which of our axes a round part's local x and y lie along once it is turned.
std::pair<int, int> local_axes(const Part& part) {
  const int u = (part.axis + 1) % 3, v = (part.axis + 2) % 3;
  if (part.sides > 0) return part.phase % 2 == 0 ? std::pair{u, v} : std::pair{v, u};
  // rotate([0, ±90, 0]) takes x to OpenSCAD's z, our y; the others leave x where it is.
  return part.axis == 0 ? std::pair{1, 2} : part.axis == 1 ? std::pair{0, 2} : std::pair{0, 1};
}

std::string round_text(const Part& part, const PartText& text) {
  std::string out = part.sides > 0 ? prism_turn_text(part) : turn_text(part);
  const auto [x, y] = local_axes(part);
  const std::string& height = text.size[static_cast<std::size_t>(part.axis)];
  const std::string &wide = text.size[static_cast<std::size_t>(x)], &deep = text.size[static_cast<std::size_t>(y)];
  const std::string fn = part.sides > 0 ? ", $fn = " + std::to_string(part.sides) : "";
  const int u = (part.axis + 1) % 3;
  const std::string& base = text.size[static_cast<std::size_t>(u)];
  if (text.is_round) {
    out += "cylinder(h = " + height +
           (part.kind == Kind::cone ? ", d1 = " + base + ", d2 = " + text.top : ", d = " + base);
  } else {
    out += "scale([" + wide + ", " + deep + ", 1]) cylinder(h = " + height;
    out += part.kind == Kind::cone ? ", d1 = 1, d2 = (" + text.top + ") / (" + base + ")" : ", d = 1";
  }
  return out + ", center = true" + fn + ")";
}

std::string vector_text(const std::string& x, const std::string& y, const std::string& z) {
  return "[" + x + ", " + y + ", " + z + "]";
}

void tree_into(const Model& model, const Node& node, const std::string& indent,
               const std::function<std::string(std::size_t, const std::string&)>& leaf, std::string& out) {
  if (node.op == Node::Op::leaf) {
    out += leaf(node.part, indent);
    return;
  }
  out += indent + (node.op == Node::Op::unite      ? "union"
                   : node.op == Node::Op::subtract ? "difference"
                                                   : "intersection");
  out += "() {\n";
  for (const Node& child : node.children) tree_into(model, child, indent + "  ", leaf, out);
  out += indent + "}\n";
}

}  // namespace

std::string decimal(double value) {
  if (value == 0) return "0";  // and no negative zero
  const double size = std::abs(value);
  for (int places = 0; size >= 1e-4 && size < 1e15 && places <= 17; ++places) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", places, value);
    if (std::strtod(text, nullptr) == value) return text;
  }
  return shortest_decimal(value);
}

PartText literal_text(const Part& part) {
  PartText text;
  for (int i = 0; i < 3; ++i) {
    text.centre[static_cast<std::size_t>(i)] = decimal(part.centre[i]);
    text.size[static_cast<std::size_t>(i)] = decimal(part.size[i]);
  }
  text.minus_z = decimal(-part.centre.z());
  text.top = decimal(part.top);
  text.is_round = part.size[(part.axis + 1) % 3] == part.size[(part.axis + 2) % 3];
  return text;
}

std::string statement_of(const Part& part, const PartText& text) {
  std::string out;
  if (part.colour[3] > 0) {
    out += "color([";
    for (std::size_t i = 0; i < 3; ++i) out += (i ? ", " : "") + decimal(part.colour[i]);
    out += (part.colour[3] < 1 ? ", " + decimal(part.colour[3]) : "") + "]) ";
  }
  out += "translate(" + vector_text(text.centre[0], text.minus_z, text.centre[1]) + ") ";
  const std::string size = vector_text(text.size[0], text.size[2], text.size[1]);
  if (part.kind == Kind::sphere) {
    out += "scale(" + size + ") sphere(d = 1)";
  } else if (part.kind == Kind::cylinder || part.kind == Kind::cone) {
    out += round_text(part, text);
  } else {
    out += "cube(" + size + ", center = true)";
  }
  return out + ";";
}

std::string tree_text(const Model& model,
                      const std::function<std::string(std::size_t part, const std::string& indent)>& leaf) {
  std::string out;
  if (model.tree.op == Node::Op::unite) {
    for (const Node& child : model.tree.children) tree_into(model, child, "", leaf, out);
  } else {
    tree_into(model, model.tree, "", leaf, out);
  }
  return out;
}

std::string to_scad(const Model& model) {
  return "$fn = 128;\n\n" + tree_text(model, [&](std::size_t i, const std::string& indent) {
           const Part& part = model.parts[i];
           return indent + "// " + part.label + "\n" + indent + statement_of(part, literal_text(part)) + "\n";
         });
}

}  // namespace parsel::cad
