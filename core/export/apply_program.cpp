#include <algorithm>

#include "core/export/apply.h"

namespace parsel {
namespace {

/// The sweep is evaluated at this many steps; keys are chosen among them, so a jump (a changed count) takes one step.
constexpr std::size_t sweep_steps = 256;

}  // namespace

Result<Applied> apply_program(std::string_view file, const Shape& shape, const Program& program,
                              const std::vector<double>& values, const std::optional<Animate>& animate,
                              ApplyOptions options) {
  if (values.size() != program.layers.size()) {
    return Error{"edit/apply_program", "values",
                 std::to_string(values.size()) + " are given for " + std::to_string(program.layers.size()) + " layers",
                 "give one value a layer"};
  }
  const Evaluator evaluate(program, shape);
  if (animate) {
    const auto layer = std::find_if(program.layers.begin(), program.layers.end(),
                                    [&](const Layer& l) { return l.parameter.name == animate->parameter; });
    if (layer == program.layers.end()) {
      return Error{"edit/apply_program", animate->parameter, "the program has no such parameter",
                   "animate one that it has"};
    }
    Sweep sweep{animate->parameter, {}, animate->seconds};
    std::vector<double> at = values;
    double& x = at[static_cast<std::size_t>(layer - program.layers.begin())];
    const double step = (layer->parameter.max - layer->parameter.min) / static_cast<double>(sweep_steps);
    for (std::size_t i = 0; i <= sweep_steps; ++i) {
      x = i == sweep_steps ? layer->parameter.max : layer->parameter.min + static_cast<double>(i) * step;
      sweep.samples.push_back(evaluate(at));
    }
    options.sweep = std::move(sweep);
  }
  PARSEL_ASSERT(!options.repair || (!options.sweep && options.poses.empty()), "gaps are closed in one state");
  State state = evaluate(values);
  ClosedGaps gaps;
  if (options.repair) gaps = close_gaps(shape, state);
  auto applied = apply_state(file, shape, state, options);
  if (applied.ok()) applied->gaps = std::move(gaps);
  return applied;
}

}  // namespace parsel
