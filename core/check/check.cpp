#include "core/check/check.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/check/check_scope.h"
#include "core/check/check_trace.h"
#include "core/check/replay.h"
#include "core/check/replay_operator.h"
#include "core/check/tie.h"

namespace parsel {

namespace {

constexpr double at_rest = 1e-6;
constexpr double rounding = 1e-6;    ///< of numbers that were written and read again
constexpr double too_careful = 1.1;  ///< how much larger than anything seen a bound may be

// What would remove the findings of a kind.
constexpr const char* choose_shape = "check it with the model that it was made for";
constexpr const char* choose_name = "name one that parsel inspect lists";
constexpr const char* complete = "give every field that the operator needs, or leave the statement out";
constexpr const char* narrow = "narrow the layer's range or change the amount";
constexpr const char* anew = "propagate the edit again: what it does to relations is then worked out anew";

class Checker {
 public:
  Checker(const Shape& shape, const Program& program, CheckReport& report)
      : shape_(shape), replay_(shape, program), program_(program), report_(report) {}

  /// Whether the program makes enough sense to be evaluated.
  bool structure() {
    if (!program_.shape_sha256.empty() && !shape_.sha256.empty() && program_.shape_sha256 != shape_.sha256) {
      find("/shape/sha256", "the program was made for another file", choose_shape);
    }
    std::set<std::string> names;
    for (std::size_t l = 0; l < program_.layers.size(); ++l) {
      const Parameter& parameter = program_.layers[l].parameter;
      if (!names.insert(parameter.name).second)
        find(layer_place(l) + "/parameter/name", "used by another layer", "rename it");
      for (std::size_t i = 0; i < program_.layers[l].statements.size(); ++i) {
        statement(program_.layers[l].statements[i], layer_place(l) + "/statements/" + std::to_string(i));
      }
    }
    return report_.findings.empty();
  }

  void nothing_moves_at_zero() {
    replay::Values zero;
    for (const Layer& layer : program_.layers) zero[layer.parameter.name] = 0;
    const replay::Scene rest = replay_.rest();
    const replay::Scene scene = replay_.scene(program_.layers.size(), zero);
    for (const PartIndex p : shape_.parts.indices()) {
      for (std::size_t k = 0; k < 8; ++k) {
        if ((scene.parts[p][k] - rest.parts[p][k]).norm() <= at_rest) continue;
        find("", shape_.parts[p].id + " moves although every parameter is 0",
             "let every amount on it be 0 when all parameters are");
        break;
      }
    }
  }

  void layer(std::size_t l) {
    const Layer& layer = program_.layers[l];
    const Parameter& parameter = layer.parameter;
    if (!(parameter.min <= 0 && 0 <= parameter.max)) {
      find(layer_place(l) + "/parameter", "0 is not in the range", "widen the range to 0");
    }
    if (!(parameter.min <= parameter.value && parameter.value <= parameter.max)) {
      find(layer_place(l) + "/parameter/value", "outside the range", "move it inside");
    }
    const replay::Ties ties = replay::ties_of(replay_, l + 1, replay::disabled_in(replay_, layer));
    std::map<RelationIndex, double> due = measure(l, ties);
    if (layer.relations.empty()) return;

    std::set<std::string> reported;
    for (std::size_t i = 0; i < layer.relations.size(); ++i) {
      const RelationReport& claim = layer.relations[i];
      const std::string place = layer_place(l) + "/relations/" + std::to_string(i);
      if (!reported.insert(claim.id).second) find(place, claim.id + " is reported twice", "remove one of the reports");
      const auto relation = replay_.relation(claim.id);
      const auto seen = relation ? due.find(*relation) : due.end();
      if (seen == due.end()) {
        find(place, claim.id + (relation ? " does not count here" : " is not in the shape"), "remove the report");
        continue;
      }
      compare(claim, seen->second, replay::tolerance(shape_.relations[*relation], ties.moved), place);
      ++report_.relations;
    }
    for (const auto& [r, unused] : due) {
      const std::string& id = shape_.relations[r].id;
      if (reported.count(id) == 0)
        find(layer_place(l) + "/relations", id + " touches an edited part but is not reported", anew);
    }
  }

 private:
  static std::string layer_place(std::size_t l) { return "/layers/" + std::to_string(l); }

  void find(std::string place, std::string text, std::string fix) {
    report_.findings.push_back({std::move(place), std::move(text), std::move(fix)});
  }

  void statement(const Statement& s, const std::string& place) {
    if (s.op == Op::change_count || s.op == Op::change_delta) {
      const auto relation = replay_.relation(s.relation);
      if (!relation || !shape_.relations[*relation].is_group()) {
        find(place + "/relation", "no group of the shape", choose_name);
      }
      return;
    }
    if (!replay_.part(s.part)) find(place + "/part", "no part of the shape", choose_name);
    const replay::Needs needs = replay::needs_of(s.op);
    if (needs.origin && !s.origin) find(place, "the operator needs an origin", complete);
    if (needs.direction && !s.direction) find(place, "the operator needs a direction", complete);
    if (needs.normal && !s.normal) find(place, "the operator needs a normal", complete);
    if (s.origin && std::holds_alternative<PartPoint>(*s.origin) &&
        !replay_.part(std::get<PartPoint>(*s.origin).part)) {
      find(place + "/origin", "refers to no part of the shape", choose_name);
    }
    for (const auto& reference : {s.direction, s.normal}) {
      if (!reference) continue;
      if (const auto* axis = std::get_if<PartAxis>(&*reference)) {
        if (!replay_.part(axis->part)) find(place, "a direction refers to no part of the shape", choose_name);
      } else if (!(std::get<Vec3>(*reference).norm() > 1e-9)) {
        find(place, "a direction has no length", "give one that has");
      }
    }
  }

  /// Largest deviation of every due relation over the layer's range; reports bad amounts and inverted cages. Without
  /// relations of instances that do not exist at the start of the layer.
  std::map<RelationIndex, double> measure(std::size_t l, const replay::Ties& ties) {
    const Parameter& parameter = program_.layers[l].parameter;
    replay::Values values = replay::values_of(program_);
    values[parameter.name] = 0;
    const replay::Scene start = replay_.scene(l + 1, values);
    std::vector<replay::Tie> due;
    for (const RelationIndex r : ties.due) {
      replay::Tie tie(shape_, r);
      if (tie.exists(start)) due.push_back(std::move(tie));
    }
    std::vector<double> worst(due.size(), 0);
    std::set<std::string> faulty;  // one finding for each part or amount
    for (const double x : replay::looked_at(parameter, l)) {
      values[parameter.name] = x;
      ++report_.samples;
      amounts(l, values, faulty);
      const replay::Scene scene = replay_.scene(l + 1, values);
      inversions(l, scene, ties, faulty);
      for (std::size_t i = 0; i < due.size(); ++i) worst[i] = std::max(worst[i], due[i].off(scene));
    }
    std::map<RelationIndex, double> result;
    for (std::size_t i = 0; i < due.size(); ++i) result[due[i].index()] = worst[i];
    return result;
  }

  void amounts(std::size_t l, const replay::Values& values, std::set<std::string>& faulty) {
    const std::vector<Statement>& statements = program_.layers[l].statements;
    for (std::size_t i = 0; i < statements.size(); ++i) {
      if (statements[i].op == Op::keep_fixed) continue;
      const bool is_count = statements[i].op == Op::change_count;
      if (std::abs(replay_.amount(l, i, values)) < (is_count ? 1000 : 5)) continue;
      const std::string place = layer_place(l) + "/statements/" + std::to_string(i) + "/amount";
      if (faulty.insert(place).second)
        find(place, std::string("undefined or beyond ") + (is_count ? "1000" : "5") + " somewhere in the range",
             narrow);
    }
  }

  void inversions(std::size_t l, const replay::Scene& scene, const replay::Ties& ties, std::set<std::string>& faulty) {
    for (const PartIndex p : shape_.parts.indices()) {
      if (replay::counts(shape_.parts[p], ties.dissolved)) judge(l, scene.parts[p], shape_.parts[p], faulty);
    }
    for (const RelationIndex r : shape_.relations.indices()) {
      if (ties.dissolved.count(r) > 0) continue;
      const replay::Group& group = scene.groups[r];  // its instances follow it
      for (std::size_t k = 0; k < group.instances.size(); ++k) {
        const PartIndex original = shape_.relations[r].parts[static_cast<std::size_t>(group.source[k])];
        judge(l, group.instances[k], shape_.parts[original], faulty);
      }
    }
  }

  void judge(std::size_t l, const replay::Box& box, const Part& part, std::set<std::string>& faulty) {
    if (replay::smallest_volume(box, replay::box_of(part.hexahedron.corners)) > 0) return;
    if (faulty.insert(part.id).second)
      find(layer_place(l) + "/parameter", part.id + " is inverted in the range", narrow);
  }

  void compare(const RelationReport& claim, double seen, double tolerance, const std::string& place) {
    const bool within = claim.worst <= tolerance;
    if (seen > claim.worst + rounding) {
      find(place + "/worst", claim.id + " deviates by " + std::to_string(seen) + ", more than its bound", anew);
    }
    const bool loose_proof = claim.proof == Proof::certified && within;
    if (!loose_proof && claim.worst > seen * too_careful + rounding) {
      find(place + "/worst", claim.id + " deviates by no more than " + std::to_string(seen), anew);
    }
    if (claim.status == RelationStatus::disabled) return;
    if ((claim.status == RelationStatus::held) != within) {
      find(place + "/status", claim.id + "'s status does not follow from its bound", anew);
    }
    if (claim.status == RelationStatus::held && seen > tolerance + rounding) {
      find(place + "/status", claim.id + " is broken, not held", anew);
    }
    if (claim.status == RelationStatus::broken && seen * too_careful <= tolerance) {
      find(place + "/status", claim.id + " is held, not broken", anew);
    }
  }

  const Shape& shape_;
  const replay::Replay replay_;
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
  for (const Finding& finding : report.findings) {
    findings.push_back({{"place", finding.place}, {"text", finding.text}, {"fix", finding.fix}});
  }
  return {{"accepted", report.accepted()},
          {"relations", report.relations},
          {"samples", report.samples},
          {"claims", report.claims},
          {"findings", findings}};
}

}  // namespace parsel
