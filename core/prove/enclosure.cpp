#include "core/prove/enclosure.h"

#include <algorithm>

namespace parsel {

Enclosure::Enclosure(const Shape& shape, const Program& program, std::size_t layer) : shape_(&shape), layer_(layer) {
  PARSEL_ASSERT(layer < program.layers.size(), "the layer exists");
  std::vector<std::string> names;
  for (const Layer& l : program.layers) {
    names.push_back(l.parameter.name);
    values_.emplace_back(l.parameter.value);
  }
  const std::string& varying = program.layers[layer].parameter.name;
  bool earlier_vary = false;
  Questions questions;
  for (std::size_t l = 0; l <= layer; ++l) {
    std::vector<Step> steps;
    for (const Statement& s : program.layers[l].statements) {
      if (s.op == Op::keep_fixed) continue;
      const std::vector<std::string> used = s.amount.parameters();
      if (l < layer && std::find(used.begin(), used.end(), varying) != used.end()) earlier_vary = true;
      Step step{s.op, s.feature, s.anchor, {}, {}, s.origin, s.direction, s.normal, s.amount.compile(names), {}, 0};
      step.questions = questions.of(step.amount);
      step.count = questions.count();
      if (is_geometric(s.op)) {
        step.part = shape.find_part(s.part);
      } else {
        step.relation = shape.find_relation(s.relation);
      }
      PARSEL_ASSERT(step.part || step.relation, "a validated program names parts and relations of the shape");
      steps.push_back(std::move(step));
    }
    layers_.push_back(std::move(steps));
  }
  base_ = rest_jets(shape);
  for (; first_ < layer && !earlier_vary; ++first_) run(layers_[first_], values_, {}, base_);
}

Jet Enclosure::Step::value(const Jet* parameters, const std::vector<Case>& cases,
                           std::vector<OpenQuestion>* open) const {
  const Casework casework{&questions, &cases, open};
  const Jet jet = evaluate(amount, parameters, casework);
  return op == Op::change_count ? counted(jet, count, casework) : jet;
}

std::vector<Jet> Enclosure::parameters_over(const Interval& x) const {
  std::vector<Jet> parameters = values_;
  parameters[layer_] = Jet::variable(x);
  return parameters;
}

JetState Enclosure::operator()(const Interval& x, const std::vector<Case>& cases) const {
  const std::vector<Jet> parameters = parameters_over(x);
  JetState state = base_;
  for (std::size_t l = first_; l <= layer_; ++l) run(layers_[l], parameters, cases, state);
  return state;
}

bool Enclosure::is_smooth(const Interval& x) const {
  const std::vector<Jet> parameters = parameters_over(x);
  for (std::size_t l = first_; l <= layer_; ++l) {
    for (const Step& step : layers_[l]) {
      const Jet amount = step.value(parameters.data(), {}, nullptr);
      if (!amount.smooth || !amount.defined) return false;
    }
  }
  return true;
}

std::vector<std::vector<Case>> Enclosure::cases_over(const Interval& x, std::size_t most) const {
  std::vector<std::vector<Case>> all;
  std::vector<Case> cases;
  if (!extend(x, cases, most, all)) return {};
  return all;
}

/// Answers the first open question in every possible way, and so on; false when there are too many cases.
bool Enclosure::extend(const Interval& x, std::vector<Case>& cases, std::size_t most,
                       std::vector<std::vector<Case>>& all) const {
  const std::vector<Jet> parameters = parameters_over(x);
  std::vector<OpenQuestion> open;
  for (std::size_t l = first_; l <= layer_ && open.empty(); ++l) {
    for (const Step& step : layers_[l]) {
      step.value(parameters.data(), cases, &open);
      if (!open.empty()) break;
    }
  }
  if (open.empty()) {
    all.push_back(cases);
    return all.size() <= most;
  }
  // The first that is noted lies innermost: what is asked about it may be answered with it.
  const OpenQuestion& question = open.front();
  if (question.answers.empty()) return false;
  for (const double answer : question.answers) {
    cases.push_back({question.question, answer});
    const bool few = extend(x, cases, most, all);
    cases.pop_back();
    if (!few) return false;
  }
  return true;
}

bool Enclosure::amounts_below(double limit, double most_instances, const Interval& x) const {
  const std::vector<Jet> parameters = parameters_over(x);
  for (const Step& step : layers_[layer_]) {
    const Jet amount = evaluate(step.amount, parameters.data());
    const double largest = step.op == Op::change_count ? most_instances : limit;
    if (!amount.defined || !(amount.c[0].magnitude() < largest)) return false;
  }
  return true;
}

void Enclosure::run(const std::vector<Step>& steps, const std::vector<Jet>& parameters, const std::vector<Case>& cases,
                    JetState& state) const {
  struct References {
    bool idle = false;
    JetPoint origin, direction, normal;
  };
  std::vector<References> references;
  for (const Step& step : steps) {
    References resolved;
    if (step.origin && needs_origin(step.op)) resolved.origin = resolve(*shape_, state, *step.origin);
    const auto take = [&](const std::optional<DirectionReference>& reference, bool needed, JetPoint& into) {
      if (!needed || !reference) return;
      const auto direction = resolve(*shape_, state, *reference);
      if (direction) into = *direction;
      resolved.idle = resolved.idle || !direction;
    };
    take(step.direction, needs_direction(step.op), resolved.direction);
    take(step.normal, needs_normal(step.op), resolved.normal);
    references.push_back(resolved);
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Step& step = steps[i];
    if (references[i].idle) continue;
    const Jet amount = step.value(parameters.data(), cases, nullptr);
    if (step.op == Op::change_count) {
      change_count(*shape_, *step.relation, amount, step.anchor, state);
      continue;
    }
    if (step.op == Op::change_delta) {
      change_delta(*shape_, *step.relation, amount, step.anchor, state);
      continue;
    }
    const JetMotion motion(step.op, references[i].origin, references[i].direction, references[i].normal, amount);
    const Part& part = shape_->parts[*step.part];
    if (part.is_virtual()) {
      PARSEL_ASSERT(part.group, "a virtual part stands for a group");
      edit_parent(*shape_, *step.part, *part.group, motion, step.feature, state);
      continue;
    }
    JetCorners& corners = state.parts[*step.part];
    for (int k = 0; k < 8; ++k) {
      JetPoint& corner = corners[static_cast<std::size_t>(k)];
      if (selects(step.feature, k)) corner = motion(corner);
    }
    if (!part.group) continue;
    const std::vector<PartIndex>& members = shape_->relations[*part.group].parts;
    const auto member =
        static_cast<std::size_t>(std::find(members.begin(), members.end(), *step.part) - members.begin());
    JetGroup& group = state.groups[*part.group];
    group.instances[std::min(member, group.instances.size() - 1)] = corners;
  }
}

}  // namespace parsel
