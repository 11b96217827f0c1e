#include "core/check/score.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/tolerance.h"
#include "core/check/check_scope.h"
#include "core/check/replay.h"
#include "core/check/tie.h"

namespace parsel {

namespace {

using replay::Replay;

using Signature = std::pair<Op, std::string>;

std::set<Signature> signatures(const Replay& replay) {
  std::set<Signature> result;
  for (const Layer& layer : replay.program().layers) {
    for (const Statement& s : layer.statements) {
      // A part may be named by its node; its id says the same.
      const bool of_group = s.op == Op::change_count || s.op == Op::change_delta;
      result.emplace(s.op, of_group ? s.relation : replay.shape().parts[*replay.part(s.part)].id);
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

/// The program with its parameters at 0.35, clamped into the ranges of the layers of both with the same number.
replay::Scene scene_of(const Replay& replay, const Program& other) {
  const Program& program = replay.program();
  replay::Values values;
  for (std::size_t l = 0; l < program.layers.size(); ++l) {
    double value = std::min(tau, program.layers[l].parameter.max);
    if (l < other.layers.size()) value = std::min(value, other.layers[l].parameter.max);
    values[program.layers[l].parameter.name] = value;
  }
  return replay.scene(program.layers.size(), values);
}

double distance(const replay::Box& a, const replay::Box& b) {
  double square = 0;
  for (std::size_t k = 0; k < 8; ++k) square += (a[k] - b[k]).squaredNorm();
  return std::sqrt(square);
}

double distance(const Shape& shape, const replay::Scene& a, const replay::Scene& b) {
  double sum = 0;
  for (const PartIndex p : shape.parts.indices()) {
    const Part& part = shape.parts[p];
    if (!part.is_virtual() && !part.group) sum += distance(a.parts[p], b.parts[p]);
  }
  for (const RelationIndex r : shape.relations.indices()) {
    if (!shape.relations[r].is_group()) continue;
    const auto& left = a.groups[r].instances;
    const auto& right = b.groups[r].instances;
    for (std::size_t k = 0; k < std::max(left.size(), right.size()); ++k) {
      sum += distance(left[std::min(k, left.size() - 1)], right[std::min(k, right.size() - 1)]);
    }
  }
  return sum;
}

enum class Kept { yes, no, without_effect };

struct States {
  RelationData<Kept> of_relation;
  std::set<PartIndex> moved;
};

States states_of(const Replay& replay) {
  const Program& program = replay.program();
  const Shape& shape = replay.shape();
  States states{RelationData<Kept>(shape.relations.size(), Kept::yes), {}};
  std::set<RelationIndex> disabled;
  for (const Layer& layer : program.layers) disabled.merge(replay::disabled_in(replay, layer));
  std::set<RelationIndex> dissolved;
  for (std::size_t l = 0; l < program.layers.size(); ++l) {
    const replay::Ties ties = replay::ties_of(replay, l + 1, disabled);
    std::vector<std::pair<replay::Tie, double>> due;  // with its tolerance
    for (const RelationIndex r : ties.due) {
      if (!replay::counts(shape, r, ties.dissolved)) continue;
      due.emplace_back(replay::Tie(shape, r), replay::tolerance(shape.relations[r], ties.moved));
    }
    replay::Values values = replay::values_of(program);
    for (const double x : replay::looked_at(program.layers[l].parameter, l)) {
      values[program.layers[l].parameter.name] = x;
      const replay::Scene scene = replay.scene(l + 1, values);
      for (const auto& [tie, tolerance] : due) {
        if (tie.off(scene) > tolerance) states.of_relation[tie.index()] = Kept::no;
      }
    }
    states.moved = ties.moved;
    dissolved = ties.dissolved;
  }
  for (const RelationIndex r : shape.relations.indices()) {
    if (!replay::counts(shape, r, dissolved)) states.of_relation[r] = Kept::without_effect;
  }
  return states;
}

void compare_states(const Shape& shape, const States& truth, const States& program, Score& score) {
  int alike = 0;
  for (const RelationIndex r : shape.relations.indices()) {
    const std::vector<PartIndex>& parts = shape.relations[r].parts;
    const auto touched = [&](const States& states) {
      return std::any_of(parts.begin(), parts.end(), [&](PartIndex p) { return states.moved.count(p) > 0; });
    };
    const Kept expected = truth.of_relation[r], actual = program.of_relation[r];
    const bool idle = expected == Kept::without_effect && actual == Kept::without_effect;
    if (idle || !(touched(truth) || touched(program))) continue;
    ++score.relations;
    alike += expected == actual ? 1 : 0;
  }
  if (score.relations > 0) score.structural = static_cast<double>(alike) / score.relations;
}

}  // namespace

Score score_program(const Shape& shape, const Program& truth, const Program& program) {
  const Replay expected(shape, truth), actual(shape, program);
  Score score;
  score.programmatic = jaccard(signatures(expected), signatures(actual));
  score.geometric = distance(shape, scene_of(expected, program), scene_of(actual, truth));
  compare_states(shape, states_of(expected), states_of(actual), score);
  return score;
}

nlohmann::json to_json(const Score& score) {
  return {{"programmatic", score.programmatic},
          {"geometric", score.geometric},
          {"structural", score.structural},
          {"relations", score.relations}};
}

}  // namespace parsel
