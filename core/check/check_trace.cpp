#include "core/check/check_trace.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/check/check_scope.h"
#include "core/check/replay.h"

namespace parsel::replay {

namespace {

using nlohmann::json;

constexpr double exact = 0.002;
constexpr double one_edited = 0.0144;
constexpr double both_edited = 0.0433;
/// The propagation works with displacements and rounds amounts afterwards, a little below this.
constexpr double replay_error = 1e-5;

using Deviations = std::map<std::string, double>;  ///< by relation id

class TraceChecker {
 public:
  TraceChecker(const Shape& shape, const Program& program, std::size_t layer, const json& trace, CheckReport& report)
      : shape_(shape), layer_(program.layers[layer]), number_(layer), trace_(trace), report_(report) {
    replayed_ = program;
    replayed_.layers.resize(layer + 1);
  }

  void run() {
    header();
    bool seeding = true;
    const json& steps = trace_.at("steps");
    find_held(steps);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      place_ = "trace /steps/" + std::to_string(i);
      const json& step = steps[i];
      const std::string kind = step.at("kind");
      const bool is_seed = kind == "seed";
      claim(seeding || !is_seed, "a seed comes after another edit");
      seeding = seeding && is_seed;
      identity(step, kind);
      if (!is_seed && held_.count(part_) == 0) order();
      const Deviations before = measure();
      own_statements(step, kind);
      const Deviations after = measure();
      if (!is_seed) {
        compare(step, "pulled_by", before);
        compare(step, "result", after);
        left_broken(step, kind, after);
      }
      numbers(step);
      if (kind == "left_alone") {
        left_alone_[part_] = edited_relations(part_).size();
      } else {
        edited_.insert(part_);
      }
    }
    place_ = "trace";
    for (std::size_t s = 0; s < layer_.statements.size(); ++s) {
      claim(used_.count(s) == 1, "statement " + std::to_string(s) + " belongs to no step");
    }
    ending();
  }

 private:
  bool claim(bool holds, const std::string& text) {
    ++report_.claims;
    if (!holds) report_.findings.push_back({place_, text});
    return holds;
  }

  void header() {
    place_ = "trace";
    claim(trace_.at("format") == "parsel/trace" && trace_.at("version") == 1, "not a trace of version 1");
    claim(trace_.at("parameter") == layer_.parameter.name, "another parameter than the layer's");
    const json& tolerances = trace_.at("tolerances");
    claim(tolerances.at("exact") == exact && tolerances.at("one_edited") == one_edited &&
              tolerances.at("both_edited") == both_edited,
          "tolerances are not the project's");
    for (const double x : trace_.at("samples")) samples_.push_back(x);
    claim(!samples_.empty() && std::is_sorted(samples_.begin(), samples_.end()), "samples are not ascending");
    for (const std::string id : trace_.at("disabled")) {
      disabled_.insert(id);
      claim(shape_.find_relation(id).has_value(), "disabled relation " + id + " does not exist");
    }
    const Ties ties = ties_of(shape_, replayed_, number_ + 1, disabled_);
    for (const std::string id : trace_.at("dissolved")) dissolved_.insert(id);
    claim(dissolved_ == ties.dissolved, "dissolved groups are not those that the program takes apart");
    for (const RelationReport& relation : layer_.relations) {
      const bool reported = relation.status == RelationStatus::disabled;
      claim(reported == (disabled_.count(relation.id) > 0), relation.id + " is disabled in one place only");
    }
    for (const Part& part : shape_.parts) {
      const bool stands = part.group && dissolved_.count(shape_.relations[*part.group].id) == 0;
      if (!part.group || stands == part.is_virtual()) active_.insert(part.id);
    }
    replayed_.layers[number_].statements.clear();
    for (const Relation& relation : shape_.relations) {
      // A trace tells of relations between parts: what one part does by itself pulls at no other.
      if (relation.parts.size() != 2 || relation.is_group() || disabled_.count(relation.id) > 0 ||
          !counts(shape_, relation, dissolved_))
        continue;
      relations_.push_back(&relation);
    }
  }

  /// Parts that a hint holds count as edited from the start; their steps stand at the end.
  void find_held(const json& steps) {
    for (const json& step : steps) {
      if (step.at("kind") == "keep_fixed" && step.value("hint", "") == "keep_fixed") held_.insert(step.at("part"));
    }
    edited_ = held_;
  }

  void identity(const json& step, const std::string& kind) {
    part_ = step.at("part");
    claim(active_.count(part_) == 1, part_ + " is no part that counts here");
    claim(edited_.count(part_) == 0 || held_.count(part_) > 0, part_ + " is edited twice");
    static const std::set<std::string> kinds = {"seed",     "symmetry", "attachment", "neighbour",
                                                "breaking", "group",    "keep_fixed", "left_alone"};
    claim(kinds.count(kind) == 1, "unknown kind " + kind);
  }

  static std::string name_of(WhyKind kind) {
    static const std::map<WhyKind, std::string> names = {
        {WhyKind::seed, "seed"},           {WhyKind::symmetry, "symmetry"}, {WhyKind::attachment, "attachment"},
        {WhyKind::neighbour, "neighbour"}, {WhyKind::breaking, "breaking"}, {WhyKind::group, "group"}};
    return names.at(kind);
  }

  /// Checks that the step's statements are its part's, and applies them.
  void own_statements(const json& step, const std::string& kind) {
    const json& indices = step.at("statements");
    moves_ = false;
    if (kind == "left_alone") claim(indices.empty(), "a part left alone has statements");
    if (kind != "left_alone" && kind != "keep_fixed") claim(!indices.empty(), "an edit without statements");
    for (const std::size_t index : indices) {
      if (!claim(index < layer_.statements.size(), "there is no statement " + std::to_string(index))) continue;
      claim(used_.insert(index).second, "statement " + std::to_string(index) + " belongs to two steps");
      const Statement& statement = layer_.statements[index];
      claim(target_of(statement) == part_, "statement " + std::to_string(index) + " does not edit " + part_);
      const bool fixed = statement.op == Op::keep_fixed;
      if (kind != "seed") claim(fixed == (kind == "keep_fixed"), "keep_fixed in one place only");
      if (statement.why && !fixed) claim(name_of(statement.why->kind) == kind, "the statement gives another reason");
      moves_ = moves_ || !fixed;
      replayed_.layers[number_].statements.push_back(statement);
    }
  }

  std::string target_of(const Statement& statement) const {
    if (is_geometric(statement.op)) return shape_.parts[*shape_.find_part(statement.part)].id;
    const RelationIndex group = *shape_.find_relation(statement.relation);
    for (const Part& part : shape_.parts) {
      if (part.is_virtual() && part.group == group) return part.id;
    }
    return "";
  }

  /// Deviations of every relation at the samples, with the statements so far.
  Deviations measure() const {
    Deviations worst;
    std::map<std::string, double> values;
    for (const Layer& layer : replayed_.layers) values[layer.parameter.name] = layer.parameter.value;
    for (const double x : samples_) {
      values[layer_.parameter.name] = x;
      const Scene scene = scene_of(shape_, replayed_, number_ + 1, values);
      for (const Relation* relation : relations_) {
        double& largest = worst[relation->id];
        largest = std::max(largest, deviation_of(shape_, *relation, scene));
      }
    }
    return worst;
  }

  std::vector<const Relation*> edited_relations(const std::string& part) const {
    std::vector<const Relation*> result;
    for (const Relation* relation : relations_) {
      const std::string& a = shape_.parts[relation->parts[0]].id;
      const std::string& b = shape_.parts[relation->parts[1]].id;
      if ((a == part && edited_.count(b) > 0) || (b == part && edited_.count(a) > 0)) result.push_back(relation);
    }
    return result;
  }

  /// A broken symmetry that is none of one above the other, number of broken relations.
  using Urgency = std::pair<bool, int>;

  Urgency urgency(const std::string& part, const Deviations& deviations, double threshold) const {
    Urgency result{false, 0};
    for (const Relation* relation : edited_relations(part)) {
      if (deviations.at(relation->id) <= threshold) continue;
      const auto* mirror = std::get_if<Reflection>(&relation->detail);
      const bool is_stacked = mirror != nullptr && mirror->normal.y() * mirror->normal.y() > 0.5;
      result.first = result.first || (relation->is_symmetry() && !is_stacked);
      ++result.second;
    }
    return result;
  }

  bool waits(const std::string& part) const {
    const auto alone = left_alone_.find(part);
    return edited_.count(part) == 0 && (alone == left_alone_.end() || alone->second != edited_relations(part).size());
  }

  void order() {
    const Deviations deviations = measure();
    const Urgency most = urgency(part_, deviations, exact - replay_error);
    const Urgency least = urgency(part_, deviations, exact + replay_error);
    claim(most.second > 0, part_ + " was taken although nothing pulls at it");
    for (const std::string& other : active_) {
      if (other == part_ || !waits(other)) continue;
      const Urgency rival = urgency(other, deviations, exact + replay_error);
      const bool sure_tie = rival == most && most == least && rival == urgency(other, deviations, exact - replay_error);
      claim(!(rival > most) && !(sure_tie && other < part_), other + " should have been taken before " + part_);
    }
  }

  void compare(const json& step, const char* key, const Deviations& deviations) {
    std::set<std::string> named;
    for (const json& entry : step.at(key)) {
      const std::string id = entry.at("relation");
      named.insert(id);
      const auto found = deviations.find(id);
      if (!claim(found != deviations.end(), std::string(key) + " names " + id + ", which does not count here"))
        continue;
      const double by = entry.at("by");
      claim(std::abs(by - found->second) <= replay_error,
            std::string(key) + ": " + id + " is off by " + std::to_string(found->second));
    }
    for (const Relation* relation : edited_relations(part_)) {
      const bool off = deviations.at(relation->id) > exact + replay_error;
      claim(!off || named.count(relation->id) > 0, std::string(key) + " leaves out " + relation->id);
    }
  }

  void left_broken(const json& step, const std::string& kind, const Deviations& after) {
    std::set<std::string> listed;
    for (const std::string id : step.at("left_broken")) listed.insert(id);
    const double allowed = moves_ ? both_edited : one_edited;
    for (const json& entry : step.at("result")) {
      const std::string id = entry.at("relation");
      const double by = after.count(id) > 0 ? after.at(id) : 0;
      if (by > allowed + replay_error && kind != "left_alone") claim(listed.count(id) == 1, id + " is broken as well");
      if (by < allowed - replay_error) claim(listed.count(id) == 0, id + " is not broken");
      listed.erase(id);
    }
    claim(listed.empty(), "left_broken names a relation without a result");
  }

  void numbers(const json& step) {
    const json& candidates = step.at("candidates");
    const int screened =
        candidates.at("own").get<int>() + candidates.at("neighbour").get<int>() + candidates.at("pairs").get<int>();
    const int survivors = step.at("survivors");
    const int solved = step.at("solved");
    claim(screened >= 0 && survivors >= 0 && solved >= 0, "a number of candidates is negative");
    claim(screened > 0 || survivors + solved == 0, "candidates solved that were never screened");
    for (const json& other : step.at("runners_up")) {
      claim(other.at("symmetry_cost").get<int>() >= 0 && other.at("energy").get<double>() >= 0,
            "a runner-up with a negative cost");
    }
  }

  void ending() {
    const std::string stop = trace_.at("stop");
    const Deviations deviations = measure();
    for (const std::string& part : active_) {
      if (waits(part)) {
        claim(urgency(part, deviations, exact + replay_error).second == 0, part + " is pulled at but was never edited");
      }
    }
    const bool all = std::all_of(active_.begin(), active_.end(), [&](const auto& id) { return edited_.count(id) > 0; });
    if (stop.rfind("every part", 0) == 0) claim(all, "not every part is edited");
  }

  const Shape& shape_;
  const Layer& layer_;
  std::size_t number_;
  const json& trace_;
  CheckReport& report_;
  Program replayed_;  ///< with the statements of the steps so far
  std::string place_, part_;
  bool moves_ = false;
  std::vector<double> samples_;
  std::set<std::string> disabled_, dissolved_, active_, held_, edited_;
  std::vector<const Relation*> relations_;
  std::map<std::string, std::size_t> left_alone_;  ///< with the number of relations to edited parts then
  std::set<std::size_t> used_;
};

}  // namespace

void check_trace(const Shape& shape, const Program& program, std::size_t layer, const nlohmann::json& trace,
                 CheckReport& report) {
  PARSEL_ASSERT(layer < program.layers.size(), "the layer exists");
  try {
    TraceChecker(shape, program, layer, trace, report).run();
  } catch (const nlohmann::json::exception& error) {
    // A trace is untrusted: a missing or mistyped field is a finding, not a crash.
    report.findings.push_back({"trace", std::string("not of the format: ") + error.what()});
  }
}

}  // namespace parsel::replay
