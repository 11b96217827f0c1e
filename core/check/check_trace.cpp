#include "core/check/check_trace.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/check/check_scope.h"
#include "core/check/replay.h"
#include "core/check/tie.h"

namespace parsel::replay {

namespace {

using nlohmann::json;

constexpr double exact = 0.002;
constexpr double one_edited = 0.0144;
constexpr double both_edited = 0.0433;
/// The propagation works with displacements and rounds amounts afterwards, a little below this.
constexpr double replay_error = 1e-5;

class TraceChecker {
 public:
  TraceChecker(const Shape& shape, const Program& program, std::size_t layer, const json& trace, CheckReport& report)
      : shape_(shape),
        replay_(shape, program),
        program_(program),
        layer_(program.layers[layer]),
        number_(layer),
        trace_(trace),
        report_(report),
        ties_of_(shape.parts.size()) {}

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
      if (!identity(step, kind)) continue;
      if (!is_seed && held_.count(part_) == 0) was_pulled_at();
      if (!is_seed) compare(step, "pulled_by");
      own_statements(step, kind);
      if (!is_seed) {
        compare(step, "result");
        left_broken(step, kind);
      }
      numbers(step);
      if (kind == "left_alone") {
        left_alone_[part_] = edited_ties(part_).size();
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
    if (!holds) {
      report_.findings.push_back({place_, text, "propagate the edit again with --trace: each trace is of one program"});
    }
    return holds;
  }

  const std::string& id(PartIndex part) const { return shape_.parts[part].id; }

  void header() {
    place_ = "trace";
    claim(trace_.at("format") == "parsel/trace" && trace_.at("version") == 1, "not a trace of version 1");
    claim(trace_.at("parameter") == layer_.parameter.name, "another parameter than the layer's");
    const json& tolerances = trace_.at("tolerances");
    claim(tolerances.at("exact") == exact && tolerances.at("one_edited") == one_edited &&
              tolerances.at("both_edited") == both_edited,
          "tolerances are not the project's");
    std::vector<double> samples;
    for (const double x : trace_.at("samples")) samples.push_back(x);
    claim(!samples.empty() && std::is_sorted(samples.begin(), samples.end()), "samples are not ascending");
    for (const std::string id : trace_.at("disabled")) {
      const auto relation = replay_.relation(id);
      if (claim(relation.has_value(), "disabled relation " + id + " does not exist")) disabled_.insert(*relation);
    }
    const Ties ties = ties_of(replay_, number_ + 1, disabled_);
    std::set<RelationIndex> dissolved;
    for (const std::string id : trace_.at("dissolved")) {
      const auto relation = replay_.relation(id);
      if (claim(relation.has_value(), "dissolved group " + id + " does not exist")) dissolved.insert(*relation);
    }
    claim(dissolved == ties.dissolved, "dissolved groups are not those that the program takes apart");
    const std::set<RelationIndex> reported = disabled_in(replay_, layer_);
    for (const RelationReport& report : layer_.relations) {
      const auto relation = replay_.relation(report.id);
      const bool is_same = relation && (reported.count(*relation) > 0) == (disabled_.count(*relation) > 0);
      claim(is_same, report.id + " is disabled in one place only");
    }
    for (const PartIndex p : shape_.parts.indices()) {
      if (counts(shape_.parts[p], dissolved)) active_.insert(p);
    }
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      // The search follows relations between parts: what one part does by itself pulls at no other.
      if (relation.parts.size() != 2 || disabled_.count(r) > 0 || !counts(shape_, r, dissolved)) continue;
      for (const PartIndex p : relation.parts) ties_of_[p].push_back(ties_.size());
      tie_of_[relation.id] = ties_.size();
      ties_.emplace_back(shape_, r);
      off_.push_back(0);
    }
    for (const double x : samples) {
      Values values = values_of(program_);
      values[layer_.parameter.name] = x;
      start_.push_back(replay_.scene(number_, values));
      values_.push_back(std::move(values));
    }
    now_ = start_;
    for (std::size_t t = 0; t < ties_.size(); ++t) measure(t);  // earlier layers may have moved them
  }

  /// Parts that are held, by a hint or with the body of the model, count as edited from the start; their steps stand at
  /// the end.
  void find_held(const json& steps) {
    for (const json& step : steps) {
      if (step.at("kind") != "keep_fixed" || !step.value("held", false)) continue;
      if (const auto part = replay_.part(step.at("part").get<std::string>())) held_.insert(*part);
    }
    edited_ = held_;
  }

  /// Whether the step's part is one that it can speak of.
  bool identity(const json& step, const std::string& kind) {
    const std::string name = step.at("part");
    const auto part = replay_.part(name);
    if (!claim(part && active_.count(*part) == 1, name + " is no part that counts here")) return false;
    part_ = *part;
    claim(edited_.count(part_) == 0 || held_.count(part_) > 0, name + " is edited twice");
    static const std::set<std::string> kinds = {"seed",     "symmetry", "attachment", "neighbour",
                                                "breaking", "group",    "keep_fixed", "left_alone"};
    return claim(kinds.count(kind) == 1, "unknown kind " + kind);
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
    bool moves = false;
    if (kind == "left_alone") claim(indices.empty(), "a part left alone has statements");
    if (kind != "left_alone" && kind != "keep_fixed") claim(!indices.empty(), "an edit without statements");
    for (const std::size_t index : indices) {
      if (!claim(index < layer_.statements.size(), "there is no statement " + std::to_string(index))) continue;
      claim(used_.insert(index).second, "statement " + std::to_string(index) + " belongs to two steps");
      const Statement& statement = layer_.statements[index];
      claim(target_of(statement) == part_, "statement " + std::to_string(index) + " does not edit " + id(part_));
      const bool fixed = statement.op == Op::keep_fixed;
      if (kind != "seed") claim(fixed == (kind == "keep_fixed"), "keep_fixed in one place only");
      if (statement.why && !fixed) claim(name_of(statement.why->kind) == kind, "the statement gives another reason");
      moves = moves || !fixed;
      for (std::size_t s = 0; s < now_.size(); ++s) replay_.run(number_, index, start_[s], values_[s], now_[s]);
    }
    if (moves) moved_.insert(part_);
    for (const std::size_t t : ties_of_[part_]) measure(t);
  }

  /// The part that counts and that the statement moves.
  std::optional<PartIndex> target_of(const Statement& statement) const {
    if (statement.op != Op::change_count && statement.op != Op::change_delta) return replay_.part(statement.part);
    const Relation& group = shape_.relations[*replay_.relation(statement.relation)];
    const auto* line = std::get_if<Translation>(&group.detail);
    return line != nullptr ? line->parent : std::get<Rotation>(group.detail).parent;
  }

  /// A statement moves its own part (and the instances of its group, which do not count) alone, so only that part's
  /// ties need be measured again.
  void measure(std::size_t tie) {
    off_[tie] = 0;
    for (const Scene& scene : now_) off_[tie] = std::max(off_[tie], ties_[tie].off(scene));
  }

  PartIndex other(std::size_t tie, PartIndex part) const {
    const std::vector<PartIndex>& parts = ties_[tie].relation().parts;
    return parts[0] == part ? parts[1] : parts[0];
  }

  std::vector<std::size_t> edited_ties(PartIndex part) const {
    std::vector<std::size_t> result;
    for (const std::size_t t : ties_of_[part]) {
      if (edited_.count(other(t, part)) > 0) result.push_back(t);
    }
    return result;
  }

  /// A broken symmetry that is none of one above the other, number of broken relations.
  using Urgency = std::pair<bool, int>;

  Urgency urgency(PartIndex part, double threshold) const {
    Urgency result{false, 0};
    for (const std::size_t t : edited_ties(part)) {
      if (off_[t] <= threshold) continue;
      const Relation& relation = ties_[t].relation();
      const auto* mirror = std::get_if<Reflection>(&relation.detail);
      const bool is_stacked = mirror != nullptr && mirror->normal.y() * mirror->normal.y() > 0.5;
      result.first = result.first || (relation.is_symmetry() && !is_stacked);
      ++result.second;
    }
    return result;
  }

  bool waits(PartIndex part) const {
    const auto alone = left_alone_.find(part);
    return edited_.count(part) == 0 && (alone == left_alone_.end() || alone->second != edited_ties(part).size());
  }

  /// What was not pulled at had no reason to be edited. Which part came first is the search's affair.
  void was_pulled_at() {
    claim(urgency(part_, exact - replay_error).second > 0, id(part_) + " was taken although nothing pulls at it");
  }

  void compare(const json& step, const char* key) {
    std::set<std::string> named;
    for (const json& entry : step.at(key)) {
      const std::string id = entry.at("relation");
      named.insert(id);
      const auto found = tie_of_.find(id);
      if (!claim(found != tie_of_.end(), std::string(key) + " names " + id + ", which does not count here")) continue;
      const double by = entry.at("by"), seen = off_[found->second];
      claim(std::abs(by - seen) <= replay_error, std::string(key) + ": " + id + " is off by " + std::to_string(seen));
    }
    for (const std::size_t t : edited_ties(part_)) {
      const std::string& id = ties_[t].relation().id;
      claim(off_[t] <= exact + replay_error || named.count(id) > 0, std::string(key) + " leaves out " + id);
    }
  }

  void left_broken(const json& step, const std::string& kind) {
    std::set<std::string> listed;
    for (const std::string id : step.at("left_broken")) listed.insert(id);
    for (const json& entry : step.at("result")) {
      const std::string id = entry.at("relation");
      const auto found = tie_of_.find(id);
      const double by = found != tie_of_.end() ? off_[found->second] : 0;
      const double allowed = found != tie_of_.end() ? tolerance(ties_[found->second].relation(), moved_) : 0;
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
    for (const PartIndex part : active_) {
      if (!waits(part)) continue;
      claim(urgency(part, exact + replay_error).second == 0, id(part) + " is pulled at but was never edited");
    }
    const bool all = std::all_of(active_.begin(), active_.end(), [&](PartIndex p) { return edited_.count(p) > 0; });
    if (stop.rfind("every part", 0) == 0) claim(all, "not every part is edited");
  }

  const Shape& shape_;
  const Replay replay_;
  const Program& program_;
  const Layer& layer_;
  std::size_t number_;
  const json& trace_;
  CheckReport& report_;
  std::string place_;
  PartIndex part_;                  ///< of the step
  std::vector<Values> values_;      ///< of every sample
  std::vector<Scene> start_, now_;  ///< at every sample: when the layer begins, and with the steps so far
  std::vector<Tie> ties_;           ///< what the search must follow
  std::vector<double> off_;         ///< how far each is off now, at worst
  std::map<std::string, std::size_t> tie_of_;
  PartData<std::vector<std::size_t>> ties_of_;
  std::set<RelationIndex> disabled_;
  std::set<PartIndex> active_, held_, edited_, moved_;
  std::map<PartIndex, std::size_t> left_alone_;  ///< with the number of ties to edited parts then
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
    report.findings.push_back({"trace", std::string("not of the format: ") + error.what(),
                               "give the trace that parsel propagate --trace wrote"});
  }
}

}  // namespace parsel::replay
