#include "core/propagate/layer_writer.h"

#include "core/propagate/transfer.h"
#include "core/prove/slack.h"

namespace parsel {

namespace {

int append(Layer& layer, Statement statement) {
  layer.statements.push_back(std::move(statement));
  return static_cast<int>(layer.statements.size()) - 1;
}

}  // namespace

int add_keep_fixed(Layer& layer, const Shape& shape, PartIndex part, Why why) {
  Statement statement;
  statement.op = Op::keep_fixed;
  statement.part = shape.parts[part].id;
  statement.why = std::move(why);
  return append(layer, std::move(statement));
}

std::vector<int> add_steps(Layer& layer, const Shape& shape, PartIndex part, const std::vector<Step>& steps,
                           const std::vector<PartIndex>& sources, const Why& why) {
  std::vector<int> indices;
  for (const Step& step : steps) {
    Statement statement = to_statement(shape, part, step, sources);
    statement.why = why;
    indices.push_back(append(layer, std::move(statement)));
  }
  return indices;
}

TraceStep held_step(Layer& layer, const Graph& graph, const Edits& edits, PartIndex part, bool by_hint) {
  const Shape& shape = graph.shape();
  std::vector<PointConstraint> constraints;
  for (const RelationIndex relation : graph.relations(part)) {
    const PartIndex other = graph.other(relation, part);
    if (edits[other] && !edits[other]->steps.empty()) add_constraints(graph, relation, part, edits, constraints);
  }
  TraceStep trace;
  trace.part = shape.parts[part].id;
  trace.kind = "keep_fixed";
  trace.held = true;
  if (by_hint) trace.hint = "keep_fixed";
  for (const auto& [relation, by] : residuals(constraints, still())) {
    trace.pulled_by.push_back({shape.relations[relation].id, by});
    if (slack_of(shape.relations[relation], by, false, true) == Slack::broken)
      trace.left_broken.push_back(shape.relations[relation].id);
  }
  trace.result = trace.pulled_by;
  trace.why = by_hint ? "a hint keeps it fixed" : "it belongs to the body of the model, which stays";
  if (!trace.left_broken.empty())
    trace.statements.push_back(add_keep_fixed(layer, shape, part, Why{WhyKind::breaking, trace.left_broken}));
  return trace;
}

}  // namespace parsel
