#include "core/infer/cad_words.h"

#include <cmath>

#include "core/cad/scad_print.h"
#include "core/shape/words.h"

namespace parsel {

namespace {

/// What halves and sums leave behind the sixth decimal is no number that anyone wrote.
std::string coordinate(double value) {
  return cad::decimal(std::round(value * 1e6) / 1e6);
}

/// "box", "cylinder along y", "cone along z, its top towards −z".
std::string kind_words(const cad::Part& part) {
  const std::string axis(1, "xyz"[part.axis]);
  if (part.kind == cad::Kind::opaque) return "something in a box";
  if (part.kind == cad::Kind::box || part.kind == cad::Kind::sphere) return std::string(to_string(part.kind));
  std::string words = std::string(to_string(part.kind)) + " along " + axis;
  if (part.sides > 0) words += " of " + std::to_string(part.sides) + " sides";
  if (part.kind == cad::Kind::cone) words += ", its top towards " + std::string(part.towards > 0 ? "+" : "-") + axis;
  return words;
}

std::string line(const cad::Part& part) {
  std::string text = "- " + part.id;
  if (!says_the_same(part.id, part.name)) text += " " + quoted_name(part.name);
  text += ": " + kind_words(part);
  for (int axis = 0; axis < 3; ++axis) {
    const double half = part.size[axis] / 2;
    text += std::string(", ") + "xyz"[axis] + " " + coordinate(part.centre[axis] - half) + " to " +
            coordinate(part.centre[axis] + half);
  }
  if (part.kind == cad::Kind::cone) text += ", top " + coordinate(part.top);
  if (part.role == cad::Role::cut) text += "; taken away from others";
  if (part.role == cad::Role::meet) text += "; others are cut to it";
  return text + "\n";
}

}  // namespace

std::string describe(const cad::Model& model) {
  Vec3 low = Vec3::Constant(cad::Limits::coordinate), high = -low;
  for (const cad::Part& part : model.parts) {
    const cad::Extent reach = extent(part);
    low = low.cwiseMin(part.centre + reach.low);
    high = high.cwiseMax(part.centre + reach.high);
  }
  std::string text =
      "The program " + quoted_name(model.name) + " in " + quoted_name(model.unit) + ": the whole reaches";
  for (int axis = 0; axis < 3; ++axis) {
    text += std::string(axis == 0 ? " " : ", ") + "xyz"[axis] + " " + coordinate(low[axis]) + " to " +
            coordinate(high[axis]);
  }
  text += ". Its " + std::to_string(model.parts.size()) + " parts:\n";
  for (const cad::Part& part : model.parts) text += line(part);
  text.pop_back();
  return text;
}

}  // namespace parsel
