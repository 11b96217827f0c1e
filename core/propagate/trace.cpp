#include "core/propagate/trace.h"

#include <nlohmann/json.hpp>

namespace parsel {

using nlohmann::json;

namespace {

json relations(const std::vector<TracedRelation>& list) {
  json result = json::array();
  for (const TracedRelation& entry : list) result.push_back({{"relation", entry.relation}, {"by", entry.by}});
  return result;
}

json step_json(const TraceStep& step) {
  json result = {
      {"part", step.part},
      {"kind", step.kind},
      {"statements", step.statements},
      {"pulled_by", relations(step.pulled_by)},
      {"result", relations(step.result)},
      {"left_broken", step.left_broken},
      {"tolerance", step.tolerance},
      {"candidates", {{"own", step.own_candidates}, {"neighbour", step.neighbour_candidates}, {"pairs", step.pairs}}},
      {"survivors", step.survivors},
      {"solved", step.solved},
      {"symmetry_cost", step.symmetry_cost},
      {"energy", step.energy},
      {"runners_up", json::array()},
      {"why", step.why}};
  if (!step.hint.empty()) result["hint"] = step.hint;
  if (step.held) result["held"] = true;
  for (const RunnerUp& other : step.runners_up) {
    result["runners_up"].push_back({{"statement", other.statement},
                                    {"symmetry_cost", other.symmetry_cost},
                                    {"energy", other.energy},
                                    {"error", other.error}});
  }
  return result;
}

}  // namespace

json to_json(const Trace& trace) {
  json steps = json::array();
  for (const TraceStep& step : trace.steps) steps.push_back(step_json(step));
  return {
      {"format", "parsel/trace"},
      {"version", 1},
      {"parameter", trace.parameter},
      {"samples", trace.samples},
      {"tolerances", {{"exact", trace.exact}, {"one_edited", trace.one_edited}, {"both_edited", trace.both_edited}}},
      {"dissolved", trace.dissolved},
      {"disabled", trace.disabled},
      {"steps", steps},
      {"ends", {{"min", trace.low_end}, {"max", trace.high_end}}},
      {"notes", trace.notes},
      {"stop", trace.stop}};
}

}  // namespace parsel
