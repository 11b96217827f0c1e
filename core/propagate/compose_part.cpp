#include "core/propagate/compose_part.h"

#include <algorithm>

#include "core/base/random.h"
#include "core/base/tolerance.h"
#include "core/edit/cage.h"
#include "core/propagate/compose.h"
#include "core/prove/range.h"
#include "core/prove/scope.h"

namespace parsel {

namespace {

/// Settings of the earlier layers that are looked at, beyond those where one of them moves.
constexpr int random_settings = 4;
constexpr std::uint64_t sampling_seed = 1;
/// The part that a statement moves, with what rides on it.
std::vector<PartIndex> moved_by(const Shape& shape, PartIndex part) {
  std::vector<PartIndex> all = shape.parts[part].members;
  all.push_back(part);
  return all;
}

}  // namespace

bool LayerComposer::Score::operator<(const Score& other) const {
  if (failed != other.failed) return failed < other.failed;
  if (broken != other.broken) return broken < other.broken;
  return off < 0.9 * other.off;
}

LayerComposer::LayerComposer(const Shape& shape, const Program& program)
    : shape_(shape),
      program_(program),
      last_(program.layers.size() - 1),
      layer_(program.layers.back()),
      layers_(program.layers),
      groups_(groups_of(shape)),
      closed_(shape, layers_) {
  for (const Layer& layer : program.layers) names_.push_back(layer.parameter.name);
  choose_samples();
  Program before = program_;
  before.layers.pop_back();
  const Evaluator evaluate(before, shape);
  for (const auto& values : samples_) starts_.push_back(evaluate({values.begin(), values.end() - 1}));
  states_ = starts_;
  for (const Statement& statement : layer_.statements) {
    if (statement.op == Op::keep_fixed) continue;
    if (const auto part = part_of(shape, statement)) edited_.insert(*part);
  }
  find_ties();
}

void LayerComposer::choose_samples() {
  std::vector<std::vector<double>> settings;
  const auto end = [&](std::size_t l, double share) {
    const Parameter& p = program_.layers[l].parameter;
    return share < 0 ? -share * p.min : share * p.max;
  };
  for (std::size_t l = 0; l < last_; ++l) {
    for (const double share : last_ == 1 ? std::vector<double>{-1, -0.5, 0.5, 1} : std::vector<double>{-1, 1}) {
      settings.emplace_back(last_, 0.0);
      settings.back()[l] = end(l, share);
    }
  }
  if (last_ > 1) {
    for (const double share : {-1.0, 1.0}) {
      std::vector<double>& all = settings.emplace_back();
      for (std::size_t l = 0; l < last_; ++l) all.push_back(end(l, share));
    }
    Random random(sampling_seed);
    for (int i = 0; i < random_settings; ++i) {
      std::vector<double>& all = settings.emplace_back();
      for (std::size_t l = 0; l < last_; ++l) all.push_back(end(l, random.uniform(-1, 1)));
    }
  }
  for (const auto& setting : settings) {
    for (const double share : {-1.0, -0.5, 0.5, 1.0}) {
      samples_.push_back(setting);
      samples_.back().push_back(end(last_, share));
    }
  }
}

void LayerComposer::find_ties() {
  std::set<std::string> disabled;
  for (const Layer& layer : program_.layers) {
    for (const RelationReport& report : layer.relations) {
      if (report.status == RelationStatus::disabled) disabled.insert(report.id);
    }
  }
  const Scope scope = scope_of(shape_, program_, last_, disabled);
  const Evaluator evaluate(program_, shape_);
  std::vector<State> alone;
  for (const double share : {-1.0, -0.5, 0.5, 1.0}) {
    std::vector<double> values(last_, 0.0);
    const Parameter& p = layer_.parameter;
    values.push_back(share < 0 ? -share * p.min : share * p.max);
    alone.push_back(evaluate(values));
  }
  for (const RelationIndex r : scope.relations) {
    const Relation& relation = shape_.relations[r];
    if (is_disabled(relation, disabled)) continue;
    Tie tie{make_constraint(shape_, r), tolerance_of(relation, scope), 0, {}};
    for (const State& state : alone) tie.off_alone = std::max(tie.off_alone, deviation(tie.constraint, state));
    double before = 0;
    for (const State& state : starts_) before = std::max(before, deviation(tie.constraint, state));
    if (tie.off_alone > tie.tolerance || before > tie.tolerance) continue;
    tie.off_alone = std::max(tie.off_alone, before);
    std::vector<PartIndex> parts = relation.parts;
    if (relation.is_group()) parts.push_back(parent_of(relation));
    for (const PartIndex p : parts) {
      if (edited_.count(p) > 0) tie.movers.insert(p);
      const auto& group = shape_.parts[p].group;
      if (group && edited_.count(parent_of(shape_.relations[*group])) > 0)
        tie.movers.insert(parent_of(shape_.relations[*group]));
    }
    if (!tie.movers.empty()) ties_.push_back(std::move(tie));
  }
}

Layer LayerComposer::run() {
  std::vector<PartIndex> order;
  std::map<PartIndex, std::vector<std::size_t>> numbers;
  for (std::size_t i = 0; i < layer_.statements.size(); ++i) {
    const Statement& statement = layer_.statements[i];
    if (statement.op == Op::keep_fixed) continue;
    const auto part = part_of(shape_, statement);
    PARSEL_ASSERT(part, "a validated program names parts of the shape");
    if (numbers.count(*part) == 0) order.push_back(*part);
    numbers[*part].push_back(i);
  }
  const Layer by_itself = layer_;
  std::vector<Statement> all;
  for (const Statement& statement : by_itself.statements) {
    if (statement.op != Op::keep_fixed) all.push_back(statement);
  }
  const Score before = score(all_ties(), order, moved(all));
  for (const PartIndex part : order) compose_part(part, numbers[part]);
  // Part by part is greedy: what helps one may cost the next more.
  return score(all_ties(), order, states_) < before ? layer_ : by_itself;
}

std::vector<const LayerComposer::Tie*> LayerComposer::all_ties() const {
  std::vector<const Tie*> all;
  for (const Tie& tie : ties_) all.push_back(&tie);
  return all;
}

std::vector<const LayerComposer::Tie*> LayerComposer::ties_of(PartIndex part) const {
  std::vector<const Tie*> found;
  for (const Tie& tie : ties_) {
    if (tie.movers.count(part) == 0) continue;
    const bool known =
        std::all_of(tie.movers.begin(), tie.movers.end(), [&](PartIndex p) { return p == part || done_.count(p) > 0; });
    if (known) found.push_back(&tie);
  }
  return found;
}

std::vector<State> LayerComposer::moved(const Statements& statements) const {
  std::vector<State> states = states_;
  for (const Statement& statement : statements) {
    const StatementRun run(statement, names_, shape_, groups_);
    for (std::size_t s = 0; s < states.size(); ++s)
      run.run(run.resolve(starts_[s]), run.amount(samples_[s].data()), groups_, states[s]);
  }
  return states;
}

LayerComposer::Score LayerComposer::score(const std::vector<const Tie*>& ties, const std::vector<PartIndex>& parts,
                                          const std::vector<State>& states) const {
  Score score;
  for (const State& state : states) {
    for (const Tie* tie : ties) {
      const double off = deviation(tie->constraint, state);
      if (!(off <= tie->tolerance)) ++score.broken;
      const double beyond = std::max(0.0, off - tie->off_alone);
      score.off += beyond;
      score.worst = std::max(score.worst, beyond);
    }
    for (const PartIndex part : parts) {
      for (const PartIndex p : moved_by(shape_, part)) {
        if (relative_jacobians(state.parts[p], shape_.parts[p].hexahedron.corners).minCoeff() < collapse_ratio)
          ++score.failed;
      }
    }
  }
  return score;
}

void LayerComposer::commit(PartIndex part, const std::vector<std::size_t>& numbers, const Statements& statements) {
  states_ = moved(statements);
  for (std::size_t i = 0; i < numbers.size(); ++i) layer_.statements[numbers[i]] = statements[i];
  layers_.back() = layer_;
  done_.insert(part);
}

void LayerComposer::compose_part(PartIndex part, const std::vector<std::size_t>& numbers) {
  Statements as_alone;
  for (const std::size_t i : numbers) as_alone.push_back(layer_.statements[i]);
  Statements best = as_alone;
  const std::vector<const Tie*> ties = ties_of(part);
  Score least = score(ties, {part}, moved(best));
  const auto good = [&] { return least.failed == 0 && least.broken == 0 && least.worst <= exact; };
  const auto consider = [&](Statements tried) {
    const Score found = score(ties, {part}, moved(tried));
    if (!(found < least)) return;
    least = found;
    best = std::move(tried);
  };
  const bool follows = std::all_of(as_alone.begin(), as_alone.end(), is_derived);
  std::vector<Statements> forms = {as_alone};
  for (std::size_t form = 0; form < forms.size() && !good(); ++form) {
    if (form == 0) {
      for (Statements& other : turned_along(part, as_alone)) forms.push_back(std::move(other));
    } else {
      consider(forms[form]);
    }
    if (!follows) continue;
    const Statements base = forms[form];
    std::vector<std::vector<Equation>> found;
    for (std::size_t u = 0; u < base.size() && !good(); ++u) {
      found.push_back(equations(part, base, u));
      for (const Equation& equation : found[u]) {
        if (good()) break;
        const auto solution = solved(equation, part, base, u);
        const auto amount = solution ? accepted(*solution, base[u].amount) : std::nullopt;
        if (!amount) continue;
        Statements tried = base;
        tried[u].amount = *amount;
        consider(std::move(tried));
      }
    }
    if (base.size() != 2 || found.size() != 2) continue;
    for (const Equation& first : found[0]) {
      for (const Equation& second : found[1]) {
        if (good()) break;
        const auto solution = solved_pair(first, second, part, base);
        if (!solution) continue;
        const auto a = accepted((*solution)[0], base[0].amount), b = accepted((*solution)[1], base[1].amount);
        if (!a || !b) continue;
        Statements tried = base;
        tried[0].amount = *a;
        tried[1].amount = *b;
        consider(std::move(tried));
      }
    }
  }
  commit(part, numbers, best);
}

/// The same statements along the part's own axes where these lie along the directions that are given, for parts that an
/// earlier layer turns.
std::vector<LayerComposer::Statements> LayerComposer::turned_along(PartIndex part, const Statements& statements) const {
  const Part& of = shape_.parts[part];
  Statements turned = statements;
  bool changed = false;
  const auto turn = [&](std::optional<DirectionReference>& reference) {
    const auto* literal = reference ? std::get_if<Vec3>(&*reference) : nullptr;
    if (literal == nullptr) return;
    const Vec3 along = literal->normalized();
    for (int axis = 0; axis < 3; ++axis) {
      if (of.hexahedron.axes.row(axis).dot(along.transpose()) < 1 - 1e-9) continue;
      const auto differs = [&](const State& state) {
        const auto now = axis_direction(state.parts[part], axis);
        return now && (*now - along).norm() > 1e-6;
      };
      if (std::none_of(starts_.begin(), starts_.end(), differs)) continue;
      reference = PartAxis{of.id, axis};
      changed = true;
      return;
    }
  };
  for (Statement& statement : turned) {
    turn(statement.direction);
    turn(statement.normal);
  }
  return changed ? std::vector<Statements>{turned} : std::vector<Statements>{};
}

}  // namespace parsel
