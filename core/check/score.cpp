#include "core/check/score.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/tolerance.h"
#include "core/edit/evaluate.h"
#include "core/prove/prove.h"
#include "core/prove/scope.h"

namespace parsel {

namespace {

using Signature = std::pair<Op, std::string>;

std::set<Signature> signatures(const Shape& shape, const Program& program) {
  std::set<Signature> result;
  for (const Layer& layer : program.layers) {
    for (const Statement& s : layer.statements) {
      // A part may be named by its node; its id says the same.
      const std::string operand = is_geometric(s.op) ? shape.parts[*shape.find_part(s.part)].id : s.relation;
      result.emplace(s.op, operand);
    }
  }
  return result;
}

double jaccard(const std::set<Signature>& a, const std::set<Signature>& b) {
  std::size_t common = 0;
  for (const Signature& signature : a) common += b.count(signature);
  const std::size_t all = a.size() + b.size() - common;
  return all == 0 ? 1 : static_cast<double>(common) / static_cast<double>(all);
}

/// Both programs' parameter values: 0.35, clamped into the ranges of the layers with the same number.
std::vector<double> values_for(const Program& program, const Program& other) {
  std::vector<double> values;
  for (std::size_t l = 0; l < program.layers.size(); ++l) {
    double value = std::min(tau, program.layers[l].parameter.max);
    if (l < other.layers.size()) value = std::min(value, other.layers[l].parameter.max);
    values.push_back(value);
  }
  return values;
}

double distance(const Shape& shape, const State& a, const State& b) {
  double sum = 0;
  for (const PartIndex p : shape.parts.indices()) {
    const Part& part = shape.parts[p];
    if (!part.is_virtual() && !part.group) sum += (a.parts[p] - b.parts[p]).norm();
  }
  for (const RelationIndex r : shape.relations.indices()) {
    if (!shape.relations[r].is_group()) continue;
    const auto& left = a.groups[r].instances;
    const auto& right = b.groups[r].instances;
    for (std::size_t k = 0; k < std::max(left.size(), right.size()); ++k) {
      sum += (left[std::min(k, left.size() - 1)] - right[std::min(k, right.size() - 1)]).norm();
    }
  }
  return sum;
}

enum class Kept { yes, no, without_effect };

struct States {
  std::map<std::string, Kept> of_relation;  ///< that touch an edited part; others are kept
  Scope scope;                              ///< of the last layer
};

States states_of(const Shape& shape, const Program& program) {
  States states;
  std::set<std::string> disabled;
  for (const Layer& layer : program.layers) {
    for (const RelationReport& report : layer.relations) {
      if (report.status == RelationStatus::disabled) disabled.insert(report.id);
    }
  }
  if (program.layers.empty()) return states;
  states.scope = scope_of(shape, program, program.layers.size() - 1, disabled);
  for (std::size_t l = 0; l < program.layers.size(); ++l) {
    const Scope scope = scope_of(shape, program, l, disabled);
    for (const RelationReport& report : prove_relations(shape, program, l, disabled)) {
      const RelationIndex r = *shape.find_relation(report.id);
      const bool broken = report.worst > tolerance_of(shape.relations[r], scope);
      Kept& kept = states.of_relation.emplace(report.id, Kept::yes).first->second;
      if (broken) kept = Kept::no;
    }
  }
  for (const RelationIndex r : shape.relations.indices()) {
    if (!is_active(shape, r, states.scope.dissolved)) states.of_relation[shape.relations[r].id] = Kept::without_effect;
  }
  return states;
}

void compare_states(const Shape& shape, const States& truth, const States& program, Score& score) {
  int alike = 0;
  for (const Relation& relation : shape.relations) {
    const auto touched = [&](const States& states) {
      return std::any_of(relation.parts.begin(), relation.parts.end(),
                         [&](PartIndex p) { return states.scope.edited.count(p) > 0; });
    };
    const auto kept = [&](const States& states) {
      const auto found = states.of_relation.find(relation.id);
      return found == states.of_relation.end() ? Kept::yes : found->second;
    };
    const bool idle = kept(truth) == Kept::without_effect && kept(program) == Kept::without_effect;
    if (idle || !(touched(truth) || touched(program))) continue;
    ++score.relations;
    alike += kept(truth) == kept(program) ? 1 : 0;
  }
  if (score.relations > 0) score.structural = static_cast<double>(alike) / score.relations;
}

}  // namespace

Score score_program(const Shape& shape, const Program& truth, const Program& program) {
  Score score;
  score.programmatic = jaccard(signatures(shape, truth), signatures(shape, program));
  const State expected = Evaluator(truth, shape)(values_for(truth, program));
  const State actual = Evaluator(program, shape)(values_for(program, truth));
  score.geometric = distance(shape, expected, actual);
  compare_states(shape, states_of(shape, truth), states_of(shape, program), score);
  return score;
}

nlohmann::json to_json(const Score& score) {
  return {{"programmatic", score.programmatic},
          {"geometric", score.geometric},
          {"structural", score.structural},
          {"relations", score.relations}};
}

}  // namespace parsel
