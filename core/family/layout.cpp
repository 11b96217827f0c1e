#include "core/family/layout.h"

#include <algorithm>

namespace parsel::family {

std::string_view to_string(Vocabulary vocabulary) {
  return vocabulary == Vocabulary::paper ? "paper" : "extended";
}

std::size_t Layout::find(std::string_view name) const {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [&](const Parameter& p) { return p.name == name; });
  return static_cast<std::size_t>(found - parameters.begin());
}

Layout layout_of(const cad::Model& model, Vocabulary vocabulary) {
  Layout layout;
  layout.vocabulary = vocabulary;
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    const cad::Part& part = model.parts[i];
    layout.first.push_back(layout.size());
    for (const Quantity quantity : {Quantity::centre, Quantity::size}) {
      for (int axis = 0; axis < 3; ++axis) {
        const char letters[] = {'.', quantity == Quantity::centre ? 'c' : 's', "xyz"[axis]};
        layout.parameters.push_back({i, quantity, axis, part.id + std::string(letters, 3)});
      }
    }
    if (part.kind == cad::Kind::cone) {
      const char* name = vocabulary == Vocabulary::paper ? ".r_top" : ".top";
      layout.parameters.push_back({i, Quantity::top, (part.axis + 1) % 3, part.id + name});
    }
  }
  return layout;
}

Values values_of(const Layout& layout, const cad::Model& model) {
  Values values(static_cast<Eigen::Index>(layout.size()));
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const Parameter& p = layout.parameters[i];
    const cad::Part& part = model.parts[p.part];
    double value = p.quantity == Quantity::centre ? part.centre[p.axis] : part.size[p.axis];
    if (p.quantity == Quantity::top) {
      value = layout.vocabulary == Vocabulary::paper ? part.top / (2 * part.size[p.axis]) : part.top;
    }
    values[static_cast<Eigen::Index>(i)] = value;
  }
  return values;
}

cad::Model with_values(const Layout& layout, const cad::Model& model, const Values& values) {
  cad::Model made = model;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const Parameter& p = layout.parameters[i];
    cad::Part& part = made.parts[p.part];
    const double value = values[static_cast<Eigen::Index>(i)];
    if (p.quantity == Quantity::centre) part.centre[p.axis] = value;
    if (p.quantity == Quantity::size) part.size[p.axis] = value;
    if (p.quantity == Quantity::top) {  // comes after the sizes of its part
      part.top = layout.vocabulary == Vocabulary::paper ? value * 2 * part.size[p.axis] : value;
    }
  }
  return made;
}

double half_diagonal(const cad::Model& model) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const cad::Part& part : model.parts) {
    const cad::Extent box = cad::extent(part);
    low = low.cwiseMin(part.centre + box.low);
    high = high.cwiseMax(part.centre + box.high);
  }
  return (high - low).norm() / 2;
}

}  // namespace parsel::family
