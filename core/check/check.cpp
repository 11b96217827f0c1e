#include "core/check/check.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/check/check_scope.h"
#include "core/check/check_trace.h"
#include "core/check/replay.h"

namespace parsel {

namespace {

constexpr int even_values = 201;
constexpr int random_values = 40;
constexpr double at_rest = 1e-6;
constexpr double rounding = 1e-6;    ///< of numbers that were written and read again
constexpr double too_careful = 1.1;  ///< how much larger than anything seen a bound may be

class Checker {
 public:
  Checker(const Shape& shape, const Program& program, CheckReport& report)
      : shape_(shape), program_(program), report_(report) {}

  /// Whether the program makes enough sense to be evaluated.
  bool structure() {
    if (!program_.shape_sha256.empty() && !shape_.sha256.empty() && program_.shape_sha256 != shape_.sha256) {
      find("/shape/sha256", "the program was made for another file");
    }
    std::set<std::string> names;
    for (std::size_t l = 0; l < program_.layers.size(); ++l) {
      const Parameter& parameter = program_.layers[l].parameter;
      if (!names.insert(parameter.name).second) find(layer_place(l) + "/parameter/name", "used by another layer");
      for (std::size_t i = 0; i < program_.layers[l].statements.size(); ++i) {
        statement(program_.layers[l].statements[i], layer_place(l) + "/statements/" + std::to_string(i));
      }
    }
    return report_.findings.empty();
  }

  void nothing_moves_at_zero() {
    std::map<std::string, double> zero;
    for (const Layer& layer : program_.layers) zero[layer.parameter.name] = 0;
    const replay::Scene scene = replay::scene_of(shape_, program_, program_.layers.size(), zero);
    for (const Part& part : shape_.parts) {
      const replay::Box rest = replay::box_of(part.hexahedron.corners);
      for (std::size_t k = 0; k < 8; ++k) {
        if ((scene.parts.at(part.id)[k] - rest[k]).norm() <= at_rest) continue;
        find("", part.id + " moves although every parameter is 0");
        break;
      }
    }
  }

  void layer(std::size_t l) {
    const Layer& layer = program_.layers[l];
    const Parameter& parameter = layer.parameter;
    if (!(parameter.min <= 0 && 0 <= parameter.max)) find(layer_place(l) + "/parameter", "0 is not in the range");
    if (!(parameter.min <= parameter.value && parameter.value <= parameter.max)) {
      find(layer_place(l) + "/parameter/value", "outside the range");
    }
    std::set<std::string> disabled;
    for (const RelationReport& relation : layer.relations) {
      if (relation.status == RelationStatus::disabled) disabled.insert(relation.id);
    }
    const replay::Ties ties = replay::ties_of(shape_, program_, l + 1, disabled);
    const std::map<std::string, double> worst = measure(l, ties);
    if (layer.relations.empty()) return;

    std::set<std::string> reported;
    for (std::size_t i = 0; i < layer.relations.size(); ++i) {
      const RelationReport& claim = layer.relations[i];
      const std::string place = layer_place(l) + "/relations/" + std::to_string(i);
      if (!reported.insert(claim.id).second) find(place, claim.id + " is reported twice");
      if (ties.due.count(claim.id) == 0) {
        find(place, claim.id + (shape_.find_relation(claim.id) ? " does not count here" : " is not in the shape"));
        continue;
      }
      const Relation& relation = shape_.relations[*shape_.find_relation(claim.id)];
      compare(claim, worst.at(claim.id), replay::tolerance(shape_, relation, ties.moved), place);
      ++report_.relations;
    }
    for (const std::string& id : ties.due) {
      if (reported.count(id) == 0)
        find(layer_place(l) + "/relations", id + " touches an edited part but is not reported");
    }
  }

 private:
  static std::string layer_place(std::size_t l) { return "/layers/" + std::to_string(l); }

  void find(std::string place, std::string text) { report_.findings.push_back({std::move(place), std::move(text)}); }

  void statement(const Statement& s, const std::string& place) {
    if (s.op == Op::change_count || s.op == Op::change_delta) {
      const auto relation = shape_.find_relation(s.relation);
      if (!relation || !shape_.relations[*relation].is_group()) find(place + "/relation", "no group of the shape");
      return;
    }
    if (!shape_.find_part(s.part)) find(place + "/part", "no part of the shape");
    const bool origin =
        s.op == Op::rotate || s.op == Op::shear || s.op == Op::scale_1d || s.op == Op::scale_2d || s.op == Op::scale_3d;
    const bool direction = s.op == Op::translate || s.op == Op::rotate || s.op == Op::scale_1d || s.op == Op::shear;
    const bool normal = s.op == Op::scale_2d || s.op == Op::shear;
    if (origin && !s.origin) find(place, "the operator needs an origin");
    if (direction && !s.direction) find(place, "the operator needs a direction");
    if (normal && !s.normal) find(place, "the operator needs a normal");
    if (s.origin && std::holds_alternative<PartPoint>(*s.origin) &&
        !shape_.find_part(std::get<PartPoint>(*s.origin).part)) {
      find(place + "/origin", "refers to no part of the shape");
    }
    for (const auto& reference : {s.direction, s.normal}) {
      if (!reference) continue;
      if (const auto* axis = std::get_if<PartAxis>(&*reference)) {
        if (!shape_.find_part(axis->part)) find(place, "a direction refers to no part of the shape");
      } else if (!(std::get<Vec3>(*reference).norm() > 1e-9)) {
        find(place, "a direction has no length");
      }
    }
  }

  /// Largest deviation of every due relation over the layer's range; reports bad amounts and inverted cages.
  std::map<std::string, double> measure(std::size_t l, const replay::Ties& ties) {
    const Parameter& parameter = program_.layers[l].parameter;
    std::map<std::string, double> values;
    for (const Layer& layer : program_.layers) values[layer.parameter.name] = layer.parameter.value;
    std::vector<double> range = {parameter.min, parameter.max};
    for (int i = 1; i + 1 < even_values; ++i) {
      range.push_back(parameter.min + (parameter.max - parameter.min) * i / (even_values - 1));
    }
    Random random(l + 1);
    for (int i = 0; i < random_values; ++i) range.push_back(random.uniform(parameter.min, parameter.max));

    std::map<std::string, double> worst;
    std::set<std::string> faulty;  // one finding for each part or amount
    for (const double x : range) {
      values[parameter.name] = x;
      ++report_.samples;
      amounts(l, values, faulty);
      const replay::Scene scene = replay::scene_of(shape_, program_, l + 1, values);
      inversions(l, scene, ties, faulty);
      for (const std::string& id : ties.due) {
        const Relation& relation = shape_.relations[*shape_.find_relation(id)];
        double& largest = worst[id];
        largest = std::max(largest, replay::deviation_of(shape_, relation, scene));
      }
    }
    return worst;
  }

  void amounts(std::size_t l, const std::map<std::string, double>& values, std::set<std::string>& faulty) {
    const std::vector<Statement>& statements = program_.layers[l].statements;
    for (std::size_t i = 0; i < statements.size(); ++i) {
      if (statements[i].op == Op::keep_fixed) continue;
      if (std::abs(replay::value_of(statements[i].amount.text(), values)) < 5) continue;
      const std::string place = layer_place(l) + "/statements/" + std::to_string(i) + "/amount";
      if (faulty.insert(place).second) find(place, "undefined or beyond 5 somewhere in the range");
    }
  }

  void inversions(std::size_t l, const replay::Scene& scene, const replay::Ties& ties, std::set<std::string>& faulty) {
    for (const Part& part : shape_.parts) {
      const bool in_group = part.group && ties.dissolved.count(shape_.relations[*part.group].id) == 0;
      const bool replaced = part.group && !in_group && part.is_virtual();
      if (replaced || (in_group && !part.is_virtual())) continue;  // instances follow
      judge(l, scene.parts.at(part.id), part, faulty);
    }
    for (const auto& [id, group] : scene.groups) {
      if (ties.dissolved.count(id) > 0) continue;
      const Relation& relation = shape_.relations[*shape_.find_relation(id)];
      for (std::size_t k = 0; k < group.instances.size(); ++k) {
        judge(l, group.instances[k], shape_.parts[relation.parts[static_cast<std::size_t>(group.source[k])]], faulty);
      }
    }
  }

  void judge(std::size_t l, const replay::Box& box, const Part& part, std::set<std::string>& faulty) {
    if (replay::smallest_volume(box, replay::box_of(part.hexahedron.corners)) > 0) return;
    if (faulty.insert(part.id).second) find(layer_place(l) + "/parameter", part.id + " is inverted in the range");
  }

  void compare(const RelationReport& claim, double seen, double tolerance, const std::string& place) {
    const bool within = claim.worst <= tolerance;
    if (seen > claim.worst + rounding) {
      find(place + "/worst", claim.id + " deviates by " + std::to_string(seen) + ", more than its bound");
    }
    const bool loose_proof = claim.proof == Proof::certified && within;
    if (!loose_proof && claim.worst > seen * too_careful + rounding) {
      find(place + "/worst", claim.id + " deviates by no more than " + std::to_string(seen));
    }
    if (claim.status == RelationStatus::disabled) return;
    if ((claim.status == RelationStatus::held) != within) {
      find(place + "/status", claim.id + "'s status does not follow from its bound");
    }
    if (claim.status == RelationStatus::held && seen > tolerance + rounding) {
      find(place + "/status", claim.id + " is broken, not held");
    }
    if (claim.status == RelationStatus::broken && seen * too_careful <= tolerance) {
      find(place + "/status", claim.id + " is held, not broken");
    }
  }

  const Shape& shape_;
  const Program& program_;
  CheckReport& report_;
};

CheckReport check(const Shape& shape, const Program& program, const nlohmann::json* trace, std::size_t layer) {
  CheckReport report;
  Checker checker(shape, program, report);
  if (!checker.structure()) return report;
  checker.nothing_moves_at_zero();
  for (std::size_t l = 0; l < program.layers.size(); ++l) checker.layer(l);
  if (trace != nullptr) replay::check_trace(shape, program, layer, *trace, report);
  return report;
}

}  // namespace

CheckReport check_program(const Shape& shape, const Program& program) {
  return check(shape, program, nullptr, 0);
}

CheckReport check_program(const Shape& shape, const Program& program, const nlohmann::json& trace, std::size_t layer) {
  return check(shape, program, &trace, layer);
}

nlohmann::json to_json(const CheckReport& report) {
  nlohmann::json findings = nlohmann::json::array();
  for (const Finding& finding : report.findings) findings.push_back({{"place", finding.place}, {"text", finding.text}});
  return {{"accepted", report.accepted()},
          {"relations", report.relations},
          {"samples", report.samples},
          {"claims", report.claims},
          {"findings", findings}};
}

}  // namespace parsel
