#include "core/family/family.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text.h"
#include "core/family/ranking.h"

namespace parsel::family {

namespace {

std::size_t rank_of(const std::vector<Constraint>& constraints, std::size_t parameters) {
  Elimination elimination(parameters);
  for (const Constraint& constraint : constraints) {
    for (const SparseRow& row : constraint.rows()) elimination.add(row);
  }
  return elimination.rank();
}

Status check_choices(const Options& options, const std::vector<Constraint>& constraints) {
  std::set<std::string> known;
  for (const Constraint& constraint : constraints) known.insert(constraint.id());
  for (const auto& [id, choice] : options.choices) {
    if (known.count(id) == 0) {
      return Error{"family", printable(id), "no constraint of the base has this name",
                   "use one of the ids that the family lists"};
    }
  }
  return success();
}

/// Keeps what the options' selection says instead of what agrees; choices count all the same.
void select_otherwise(Family& family) {
  for (Evidence& evidence : family.evidence) evidence.is_kept = false;
  if (family.options.selection != Selection::none) {
    const Ranking ranking =
        rank_constraints(family.model, family.layout, family.base, family.constraints, family.variations);
    const std::size_t end = family.options.selection == Selection::ranking ? cutoff_by_mean(ranking.losses)
                                                                           : cutoff_by_derivative(ranking.losses);
    for (std::size_t i = 0; i < end; ++i) family.evidence[ranking.order[i]].is_kept = true;
  }
  for (std::size_t i = 0; i < family.constraints.size(); ++i) {
    const auto choice = family.options.choices.find(family.constraints[i].id());
    if (choice != family.options.choices.end()) family.evidence[i].is_kept = choice->second == Choice::forced;
  }
}

void warn(Family& family) {
  if (family.model.parts.size() == 1)
    family.warnings.push_back("the model has one part: its sliders are its own sizes");
  if (family.variations.empty()) {
    family.warnings.push_back(
        "there are no variations: every constraint of the base is kept, also what is so by accident");
  } else if (family.variations.size() < 3) {
    family.warnings.push_back("there are fewer than three variations: more is kept than is meant");
  }
  if (!family.constraints.empty() && family.independent.empty()) {
    family.warnings.push_back(
        "the variations share none of the model's constraints: every size has a slider of its own");
  }
  for (std::size_t p = 0; p < family.model.parts.size(); ++p) {
    const bool is_seen = family.variations.empty() || std::any_of(family.variations.begin(), family.variations.end(),
                                                                  [&](const Variation& v) { return v.has(p); });
    if (!is_seen) family.warnings.push_back("no variation has the " + family.model.parts[p].name);
  }
}

}  // namespace

cad::Model Family::at(const Eigen::VectorXd& setting) const {
  return with_values(layout, model, basis.values(setting, pinned));
}

Interval reach(const Family& family, std::size_t slider) {
  const Slider& own = family.sliders[slider];
  const bool is_changed = own.max - own.min > family.tolerance;
  const double beyond = (is_changed ? own.max - own.min : std::max(std::abs(own.value), family.tolerance * 1e3)) / 4;
  const Interval stops = interval(family.bounds, family.base_setting, slider);
  return {std::min(own.min, std::max(own.min - beyond, stops.low)),
          std::max(own.max, std::min(own.max + beyond, stops.high)), stops.low_stop, stops.high_stop};
}

Result<Family> make_family(const cad::Model& model, std::vector<Variation> variations, const Options& options) {
  if (model.parts.size() > FamilyLimits::parts) {
    return Error{"family", "", "the model has more than " + std::to_string(FamilyLimits::parts) + " parts",
                 "take a model with fewer parts, or unite some"};
  }
  Family family;
  family.model = model;
  family.options = options;
  family.tolerance = options.tolerance * half_diagonal(model);
  family.layout = layout_of(model, options.vocabulary);
  family.base = values_of(family.layout, model);
  family.variations = std::move(variations);

  Candidates found = find_candidates(family.layout, model, family.base, family.tolerance);
  family.candidates = found.count;
  family.constraints = std::move(found.holding);
  if (const Status known = check_choices(options, family.constraints); !known) return known.error();
  family.base_rank = rank_of(family.constraints, family.layout.size());
  family.evidence = find_agreement(family.constraints, family.variations, family.tolerance, options.choices);
  if (options.selection != Selection::agreement) select_otherwise(family);
  family.independent = independent(family.constraints, family.evidence, family.layout.size());

  family.pins = find_pins(family.layout, model, family.constraints, family.evidence, family.variations);
  family.pinned = pin_values(family.pins, family.base);
  Result<Basis> basis = find_basis(family.layout, model, family.constraints, family.evidence, family.pins);
  if (!basis) return basis.error();
  family.basis = std::move(*basis);
  family.base_setting = family.basis.free_values(family.base);
  family.base = family.basis.values(family.base_setting, family.pinned);

  for (const Variation& variation : family.variations) {
    const Values all =
        filled(family.layout, family.constraints, family.evidence, variation, family.base, family.tolerance);
    family.settings.push_back(projected(family.layout, family.basis, family.pins, family.pinned, all));
  }
  family.sliders =
      find_sliders(family.layout, model, family.basis, family.base_setting, family.variations, family.settings);
  family.orders = find_orders(family.layout, model, family.base, family.variations, family.tolerance);
  family.bounds = find_bounds(family.layout, family.orders, family.basis, family.pinned, family.base, family.variations,
                              family.tolerance);
  family.optional = optional_groups(family.variations, model.parts.size());
  warn(family);
  return family;
}

}  // namespace parsel::family
