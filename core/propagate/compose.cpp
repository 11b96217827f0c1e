#include "core/propagate/compose.h"

#include <algorithm>
#include <stdexcept>

#include "core/edit/readable.h"
#include "core/propagate/compose_part.h"

namespace parsel {

namespace {

/// The amount with other expressions for its parameters; as it was where that is undefined.
Amount replaced(const Amount& amount, const GiNaC::exmap& by) {
  try {
    return Amount(amount.expression().subs(by));
  } catch (const std::exception&) {  // GiNaC throws where it divides by zero
    return amount;
  }
}

/// The layer under another parameter's name.
Layer renamed(Layer layer, const std::string& name) {
  if (layer.parameter.name == name) return layer;
  const GiNaC::exmap by = {{parameter_symbol(layer.parameter.name), parameter_symbol(name)}};
  for (Statement& statement : layer.statements) statement.amount = replaced(statement.amount, by);
  layer.parameter.name = name;
  return layer;
}

}  // namespace

bool is_derived(const Statement& statement) {
  return statement.why && statement.why->kind != WhyKind::seed;
}

Layer alone(const Layer& layer) {
  Layer result = layer;
  for (Statement& statement : result.statements) {
    if (!is_derived(statement)) continue;
    GiNaC::exmap zero;
    for (const std::string& name : statement.amount.parameters()) {
      if (name != layer.parameter.name) zero[parameter_symbol(name)] = 0;
    }
    if (!zero.empty()) statement.amount = replaced(statement.amount, zero);
  }
  return result;
}

Program compose(const Shape& shape, const Program& program, std::size_t first) {
  Program composed = program;
  composed.layers.resize(std::min(first, program.layers.size()));
  for (std::size_t l = composed.layers.size(); l < program.layers.size(); ++l) {
    composed.layers.push_back(alone(program.layers[l]));
    if (l == 0) continue;
    Layer onto = LayerComposer(shape, composed).run();
    std::swap(composed.layers.back(), onto);
    if (!readable(composed, shape).ok()) composed.layers.back() = std::move(onto);
  }
  return composed;
}

Result<Program> stack_programs(const Shape& shape, const std::vector<Program>& programs) {
  Program all;
  all.shape_name = shape.name;
  all.shape_sha256 = shape.sha256;
  for (const Program& program : programs) {
    for (const Layer& layer : program.layers)
      all.layers.push_back(renamed(alone(layer), "x" + std::to_string(all.layers.size() + 1)));
  }
  if (Status status = validate(all, shape); !status.ok()) return status.error();
  return compose(shape, all);
}

}  // namespace parsel
