#include "core/propagate/attempt.h"

#include <algorithm>

#include "core/propagate/slider_span.h"
#include "core/prove/reach.h"

namespace parsel {

std::vector<std::string> unused_hints(const Graph& graph, const ResolvedRequest& request) {
  const auto has = [](const std::vector<PartIndex>& parts, PartIndex part) {
    return std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  std::vector<std::string> notes;
  for (const auto& [part, hint] : request.hints) {
    const std::string words =
        "the hint " + std::string(to_string(hint)) + " for " + graph.shape().parts[part].id + " has no effect: ";
    if (!has(graph.parts(), part)) {
      notes.push_back(words + "the group is dissolved");
    } else if (has(request.seed_parts, part)) {
      notes.push_back(words + "the part has a seed edit");
    }
  }
  return notes;
}

std::string why_it_stopped(const Graph& graph, const Edits& edits) {
  bool all_edited = true, touches = false;
  for (const PartIndex part : graph.parts()) {
    all_edited = all_edited && edits[part] != nullptr;
    for (const RelationIndex relation : graph.relations(part)) {
      touches = touches || edits[part] != nullptr || edits[graph.other(relation, part)] != nullptr;
    }
  }
  if (all_edited) return "every part is edited";
  if (touches) return "no relation between an edited and an unedited part is broken";
  return "no relation ties the edited parts to any other part, so nothing follows them";
}

Propagation finished(const Shape& shape, const ResolvedRequest& request, const PropagateOptions& options,
                     const Samples& at, Layer layer, Trace trace, const Progress& progress) {
  Propagation result;
  result.program.shape_name = shape.name;
  result.program.shape_sha256 = shape.sha256;
  layer.parameter = {options.parameter, at.front(), at.back(), 0};
  result.program.layers.push_back(std::move(layer));
  Layer& made = result.program.layers[0];
  const auto id = [&](RelationIndex relation) { return shape.relations[relation].id; };
  std::set<std::string> disabled;
  for (const RelationIndex relation : request.disabled) disabled.insert(id(relation));
  report(progress, "finding the range and proving the relations", 0, 1);
  const SliderSpan span = span_of_seeds(shape, made, options.limit);
  SliderReach reach = reach_of_layer(shape, result.program, 0, disabled, options.limit, span.low, span.high);
  made.parameter.min = reach.range.min;
  made.parameter.max = reach.range.max;
  made.relations = std::move(reach.relations);
  trace.low_end = std::move(reach.range.min_reason);
  trace.high_end = std::move(reach.range.max_reason);

  trace.parameter = options.parameter;
  trace.samples.assign(at.begin(), at.end());
  trace.exact = exact;
  trace.one_edited = delta_one_edited;
  trace.both_edited = delta_both_edited;
  for (const RelationIndex relation : request.dissolved) trace.dissolved.push_back(id(relation));
  trace.disabled.assign(disabled.begin(), disabled.end());
  result.trace = std::move(trace);
  return result;
}

}  // namespace parsel
