// Whether a program makes sense for a shape.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "core/amount/amount_range.h"
#include "core/amount/number.h"
#include "core/edit/program_fields.h"

namespace parsel {

namespace {

/// Thrown and caught inside this file only.
struct Refusal {
  std::string place, cause, fix;
};

[[noreturn]] void refuse(std::string place, std::string cause, std::string fix) {
  throw Refusal{std::move(place), std::move(cause), std::move(fix)};
}

class Checker {
 public:
  Checker(const Program& program, const Shape& shape) : program_(program), shape_(shape) {
    for (const PartIndex p : shape.parts.indices()) parts_[shape.parts[p].id] = p;
    for (const RelationIndex r : shape.relations.indices()) relations_[shape.relations[r].id] = r;
  }

  void run() {
    if (program_.layers.size() > ProgramLimits::layers)
      refuse("/layers", "there are more than " + std::to_string(ProgramLimits::layers) + " layers", "split it");
    parameters();
    std::size_t statements = 0;
    for (std::size_t l = 0; l < program_.layers.size(); ++l) {
      const Layer& layer = program_.layers[l];
      const std::string place = "/layers/" + std::to_string(l);
      statements += layer.statements.size();
      if (statements > ProgramLimits::statements) {
        refuse(place + "/statements",
               "there are more than " + std::to_string(ProgramLimits::statements) + " statements", "split the program");
      }
      for (std::size_t i = 0; i < layer.statements.size(); ++i) {
        statement(layer.statements[i], place + "/statements/" + std::to_string(i));
      }
      if (layer.relations.size() > ProgramLimits::reports) {
        refuse(place + "/relations", "there are more than " + std::to_string(ProgramLimits::reports) + " reports",
               "leave some out");
      }
      for (std::size_t i = 0; i < layer.relations.size(); ++i) {
        relation(layer.relations[i].id, place + "/relations/" + std::to_string(i) + "/id");
      }
    }
  }

 private:
  void parameters() {
    std::set<std::string> seen;
    for (std::size_t l = 0; l < program_.layers.size(); ++l) {
      const Parameter& p = program_.layers[l].parameter;
      const std::string place = "/layers/" + std::to_string(l) + "/parameter";
      const std::string fault = parameter_name_fault(p.name);
      if (!fault.empty()) refuse(place + "/name", fault, "rename it, to x1 for one");
      if (!seen.insert(p.name).second) {
        refuse(place + "/name", "the parameter " + p.name + " has a layer already", "rename it");
      }
      if (!std::isfinite(p.min) || !std::isfinite(p.max) || !std::isfinite(p.value)) {
        refuse(place, "the range is not finite", "give finite numbers");
      }
      if (p.min > 0 || p.max < 0) refuse(place, "the range does not hold 0, the shape at rest", "widen it to 0");
      if (p.value < p.min || p.value > p.max)
        refuse(place + "/value", "the value is outside the range", "move it inside");
      names_.push_back(p.name);
      ranges_.push_back({p.min, p.max});
    }
  }

  PartIndex part(const std::string& id, const std::string& place) const {
    if (const auto known = parts_.find(id); known != parts_.end()) return known->second;
    const auto found = shape_.find_part(id);  // "node:3" is a name as well
    if (!found) refuse(place, "the shape has no part " + shown(id), "name a part that parsel inspect lists");
    return *found;
  }

  RelationIndex relation(const std::string& id, const std::string& place) const {
    const auto found = relations_.find(id);
    if (found == relations_.end())
      refuse(place, "the shape has no relation " + shown(id), "name a relation that parsel inspect lists");
    return found->second;
  }

  void statement(const Statement& s, const std::string& place) {
    fields(s, place);
    if (is_geometric(s.op)) {
      const PartIndex p = part(s.part, place + "/part");
      for (const RelationIndex changed : counts_changed_) {
        const auto& members = shape_.relations[changed].parts;
        if (s.op != Op::keep_fixed && std::find(members.begin(), members.end(), p) != members.end()) {
          refuse(place + "/part",
                 "the instance " + shown(s.part) + " is edited after the count of its group is changed",
                 "edit it before, or edit the whole group through " + shown(parent_id(changed)));
        }
      }
    } else {
      const RelationIndex r = relation(s.relation, place + "/relation");
      if (!shape_.relations[r].is_group()) {
        refuse(place + "/relation", shown(s.relation) + " is no translation or rotation group",
               "name the relation of a group");
      }
      if (s.op == Op::change_count) counts_changed_.insert(r);
    }
    if (s.origin) point(*s.origin, place + "/origin");
    if (s.direction) direction(*s.direction, place + "/" + std::string(direction_field(s.op)));
    if (s.normal) direction(*s.normal, place + "/normal");
    amount(s, place + "/amount");
    if (!s.why) return;
    for (std::size_t i = 0; i < s.why->relations.size(); ++i) {
      relation(s.why->relations[i], place + "/why/relations/" + std::to_string(i));
    }
  }

  std::string parent_id(RelationIndex group) const {
    const auto& detail = shape_.relations[group].detail;
    const auto* line = std::get_if<Translation>(&detail);
    return shape_.parts[line != nullptr ? line->parent : std::get<Rotation>(detail).parent].id;
  }

  static void fields(const Statement& s, const std::string& place) {
    const std::map<std::string, bool> given = {
        {"part", !s.part.empty()},        {"relation", !s.relation.empty()},
        {"origin", s.origin.has_value()}, {std::string(direction_field(s.op)), s.direction.has_value()},
        {"normal", s.normal.has_value()}, {"feature", s.feature != LocalTriple{0, 0, 0}}};
    for (const auto& [field, there] : given) {
      const Presence wanted = presence(s.op, field);
      const std::string op(to_string(s.op));
      if (there && wanted == Presence::refused) refuse(place + "/" + field, op + " takes no " + field, "remove it");
      if (!there && wanted == Presence::required) refuse(place, op + " needs " + field, "add it");
    }
    for (const int f : s.feature) {
      if (f < -1 || f > 1) refuse(place + "/feature", "a feature is a triple of -1, 0 and 1", "correct it");
    }
  }

  void point(const PointReference& reference, const std::string& place) const {
    if (const auto* of_part = std::get_if<PartPoint>(&reference)) {
      part(of_part->part, place + "/part");
    } else if (const std::string fault = point_fault(std::get<Vec3>(reference)); !fault.empty()) {
      refuse(place, fault, "correct it");
    }
  }

  void direction(const DirectionReference& reference, const std::string& place) const {
    if (const auto* of_part = std::get_if<PartAxis>(&reference)) {
      part(of_part->part, place + "/part");
      if (of_part->axis < 0 || of_part->axis > 2) refuse(place + "/axis", "an axis is 0, 1 or 2", "correct it");
    } else if (const std::string fault = direction_fault(std::get<Vec3>(reference)); !fault.empty()) {
      refuse(place, fault, "correct it");
    }
  }

  void amount(const Statement& s, const std::string& place) {
    if (s.op == Op::keep_fixed) {
      if (!s.amount.is_zero()) refuse(place, "keep_fixed takes no amount", "remove it");
      return;
    }
    for (const std::string& name : s.amount.parameters()) {
      if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
        refuse(place, "no layer has the parameter " + shown(name), "use the parameter of a layer");
      }
    }
    if (accepted_.insert(s.amount.written()->text).second) bounded(s.amount, ProgramLimits::amount, place);
    if (s.op == Op::change_count) bounded(s.amount, ProgramLimits::instances, place);
  }

  /// By the rule of amount_range.h, which is the page's as well.
  void bounded(const Amount& amount, double limit, const std::string& place) {
    const auto written = amount.written();
    // Only over the parameters that occur: the others would be halved in vain.
    const std::vector<std::string>& own = written->names;
    std::vector<Interval> box;
    for (const std::string& name : own) {
      box.push_back(ranges_[static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin())]);
    }
    const auto fault = find_fault(CompiledAmount(written->code), box, limit, budget_);
    if (budget_ < 0) refuse(place, "the amounts are too many or too long to check", "shorten them");
    if (!fault) return;
    std::string where;
    for (std::size_t i = 0; i < own.size(); ++i) {
      where += (i > 0 ? ", " : " at ") + own[i] + " = " + shortest_decimal(fault->at[i]);
    }
    refuse(place, "the amount has " + fault->cause + where, "narrow the parameter's range or change the amount");
  }

  const Program& program_;
  const Shape& shape_;
  std::vector<std::string> names_;
  std::vector<Interval> ranges_;
  std::unordered_map<std::string, PartIndex> parts_;
  std::unordered_map<std::string, RelationIndex> relations_;
  std::set<RelationIndex> counts_changed_;
  std::set<std::string> accepted_;  ///< texts of amounts that have been judged
  int budget_ = judging_budget;
};

}  // namespace

Status validate(const Program& program, const Shape& shape) {
  try {
    Checker(program, shape).run();
    return success();
  } catch (const Refusal& refusal) {
    return Error{"edit/program", refusal.place, refusal.cause, refusal.fix};
  }
}

}  // namespace parsel
