#include "core/prove/together.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/random.h"
#include "core/prove/prove.h"
#include "core/prove/scope.h"
#include "core/shape/words.h"

namespace parsel {

namespace {

constexpr const char* stage = "prove/together";
constexpr double decimals = 1e4;

double drawn(const Parameter& parameter, Random& random) {
  const double value = random.uniform(parameter.min, parameter.max);
  return std::clamp(std::round(value * decimals) / decimals, parameter.min, parameter.max);
}

}  // namespace

Together::Together(const Shape& shape, const Program& program, Alone alone)
    : shape_(shape), evaluate_(program, shape), failure_(shape, program) {
  Program at_rest = program;
  for (Layer& layer : at_rest.layers) layer.parameter.value = 0;
  std::set<std::string> not_kept, disabled;
  for (std::size_t i = 0; i < program.layers.size(); ++i) {
    const std::set<std::string> own = disabled_in(program.layers[i]);
    disabled.insert(own.begin(), own.end());
    std::vector<RelationReport> reports = program.layers[i].relations;
    if (alone == Alone::proven || reports.empty()) reports = prove_relations(shape, at_rest, i, own);
    for (const RelationReport& report : reports) {
      if (report.status != RelationStatus::held) not_kept.insert(report.id);
    }
  }
  const Scope scope = scope_of(shape, program, program.layers.size() - 1, disabled);
  for (const RelationIndex r : scope.relations) {
    const Relation& relation = shape.relations[r];
    judged_.push_back({make_constraint(shape, r), tolerance_of(relation, scope),
                       not_kept.count(relation.id) == 0 && !is_disabled(relation, disabled)});
    if (judged_.back().is_kept_alone) kept_alone_.push_back(relation.id);
  }
}

Together::Look Together::look(const std::vector<double>& values) const {
  const State state = evaluate_(values);
  Look look;
  look.failure = failure_(values, state);
  std::size_t number = 0;
  for (const Judged& judged : judged_) {
    const bool kept = deviation(judged.constraint, state) <= judged.tolerance;
    look.kept += kept;
    if (!judged.is_kept_alone) continue;
    if (!kept) look.lost.push_back(number);
    ++number;
  }
  return look;
}

std::string Together::fault(const std::vector<double>& values) const {
  const Look seen = look(values);
  if (!seen.failure.empty()) return seen.failure;
  if (seen.lost.empty()) return "";
  const auto relation = shape_.find_relation(kept_alone_[seen.lost.front()]);
  return "no longer true: " + describe(shape_, *relation);
}

Together::Count Together::relations(const std::vector<double>& values) const {
  return {look(values).kept, static_cast<int>(judged_.size())};
}

Result<Siblings> draw_siblings(const Shape& shape, const Program& program, int count, std::uint64_t seed) {
  if (count < 1 || count > most_siblings) {
    return Error{stage, "count", "it is not from 1 to " + std::to_string(most_siblings), "ask for 9, say"};
  }
  if (program.layers.empty()) {
    return Error{stage, "/layers", "the program has no layers, so that all siblings would be alike",
                 "add an edit with a slider first"};
  }
  const Together together(shape, program);
  Random random(seed);
  Siblings siblings;
  int in_vain = 0;
  while (static_cast<int>(siblings.values.size()) < count) {
    std::vector<double> values;
    for (const Layer& layer : program.layers) values.push_back(drawn(layer.parameter, random));
    std::string fault = together.fault(values);
    if (fault.empty()) {
      siblings.values.push_back(std::move(values));
      in_vain = 0;
      continue;
    }
    ++siblings.rejected;
    if (++in_vain == sibling_tries) {
      return Error{stage, "/layers",
                   "of " + std::to_string(sibling_tries) + " random settings none is sound; of the last, " + fault,
                   "leave a slider out, or make its range smaller"};
    }
    ++siblings.reasons[std::move(fault)];
  }
  return siblings;
}

nlohmann::json to_json(const Siblings& siblings) {
  std::vector<std::pair<std::string, int>> reasons(siblings.reasons.begin(), siblings.reasons.end());
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [reason, count] : reasons) list.push_back({{"reason", reason}, {"count", count}});
  return {{"siblings", siblings.values}, {"rejected", siblings.rejected}, {"reasons", std::move(list)}};
}

}  // namespace parsel
