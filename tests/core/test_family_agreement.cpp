#include "core/family/agreement.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/family/basis.h"
#include "core/family/fill.h"
#include "core/family/order.h"
#include "tests/core/family_data.h"

using namespace parsel;
using namespace parsel::family;
using parsel::test::family_cases;
using parsel::test::FamilyCase;
using parsel::test::variations_of;

namespace {

constexpr double tolerance = 1e-6;

/// A case on its way to a family, step by step.
struct Steps {
  Layout layout;
  Values base;
  std::vector<Variation> variations;
  std::vector<Constraint> constraints;
  std::vector<Evidence> evidence;
  Pins pins;

  explicit Steps(const FamilyCase& one, Vocabulary vocabulary = Vocabulary::paper, std::size_t set = 0)
      : layout(layout_of(one.model, vocabulary)),
        base(values_of(layout, one.model)),
        variations(variations_of(one, set)) {
    constraints = find_candidates(layout, one.model, base, tolerance).holding;
    evidence = find_agreement(constraints, variations, tolerance);
    pins = find_pins(layout, one.model, constraints, evidence, variations);
  }
};

std::size_t kept_of(const std::vector<Evidence>& evidence) {
  return static_cast<std::size_t>(
      std::count_if(evidence.begin(), evidence.end(), [](const Evidence& e) { return e.is_kept; }));
}

}  // namespace

TEST_CASE("agreement: the constraints that hand-made variations of ReparamCAD's programs share") {
  for (const FamilyCase& one : family_cases()) {
    for (std::size_t set = 0; set < one.expected["votes"].size(); ++set) {
      CAPTURE(one.name);
      CAPTURE(set);
      const Steps steps(one, Vocabulary::paper, set);
      const nlohmann::json& exact = one.expected["votes"][set]["exact"];
      CHECK(kept_of(steps.evidence) == exact["common"]);
      CHECK(independent(steps.constraints, steps.evidence, steps.layout.size()).size() == exact["independent"]);
      std::size_t near = 0;
      for (const Evidence& evidence : steps.evidence) near += evidence.agreement == Agreement::near;
      CHECK(near == exact["broken_by_one_variation_only"].size());
      const Result<Basis> basis = find_basis(steps.layout, one.model, steps.constraints, steps.evidence, steps.pins);
      REQUIRE(basis.ok());
      CHECK(steps.layout.size() - basis->rank == exact["dimensions"]);
      CHECK(basis->rank == exact["rank"]);
      if (set == 0) CHECK(basis->free.size() == one.expected["sliders_with_three_translations_pinned"]);
      for (const auto& row : basis->coefficients) {
        for (const Rational& c : row) CHECK((c.is_zero() || c * c == Rational(1) || c * c == Rational(1, 4)));
      }
    }
  }
}

TEST_CASE("orders: as many pairs of planes keep their order as were counted by hand") {
  for (const FamilyCase& one : family_cases()) {
    CAPTURE(one.name);
    const Steps steps(one);
    const Orders orders = find_orders(steps.layout, one.model, steps.base, steps.variations, tolerance);
    CHECK(orders.in_base == one.expected["plane_order_relations_base_and_kept"][0]);
    CHECK(orders.kept.size() == one.expected["plane_order_relations_base_and_kept"][1]);
  }
}

TEST_CASE("basis: every kept constraint holds to 1e-12 over 1,000 random settings within the stops") {
  for (const FamilyCase& one : family_cases()) {
    for (const Vocabulary vocabulary : {Vocabulary::paper, Vocabulary::extended}) {
      CAPTURE(one.name);
      Steps steps(one, vocabulary);
      if (vocabulary == Vocabulary::extended) {  // tops as lengths
        for (Variation& variation : steps.variations) {
          for (std::size_t i = 0; i < steps.layout.size(); ++i) {
            const Parameter& p = steps.layout.parameters[i];
            const auto at = static_cast<Eigen::Index>(i);
            if (p.quantity != Quantity::top) continue;
            const auto size = static_cast<Eigen::Index>(steps.layout.extent(p.part, p.axis));
            variation.values[at] *= 2 * variation.values[size];
          }
        }
      }
      const Result<Basis> basis = find_basis(steps.layout, one.model, steps.constraints, steps.evidence, steps.pins);
      REQUIRE(basis.ok());
      const Eigen::Vector3d pins = pin_values(steps.pins, steps.base);
      const Eigen::VectorXd base = basis->free_values(steps.base);
      CHECK((basis->values(base, pins) - steps.base).cwiseAbs().maxCoeff() < 1e-12);
      const Orders orders = find_orders(steps.layout, one.model, steps.base, steps.variations, tolerance);
      const std::vector<Bound> bounds =
          find_bounds(steps.layout, orders, *basis, pins, steps.base, steps.variations, tolerance);
      Eigen::VectorXd low = base, high = base;
      for (const Variation& variation : steps.variations) {
        const Values all = filled(steps.layout, steps.constraints, steps.evidence, variation, steps.base, tolerance);
        const Eigen::VectorXd free = projected(steps.layout, *basis, steps.pins, pins, all);
        // On the family's space a variation is itself where it has parts.
        const Values back = basis->values(free, pins), placed = pinned_to(steps.layout, steps.pins, pins, all);
        for (std::size_t i = 0; i < steps.layout.size(); ++i) {
          if (!variation.has(steps.layout.parameters[i].part)) continue;
          CHECK(std::abs(back[static_cast<Eigen::Index>(i)] - placed[static_cast<Eigen::Index>(i)]) < 1e-9);
        }
        low = low.cwiseMin(free);
        high = high.cwiseMax(free);
      }
      Random random(7);
      Eigen::VectorXd free = base;
      double worst = 0, least_size = 1, least_gap = 1;
      int moved = 0;
      for (int k = 0; k < 1000; ++k) {
        const std::size_t slider = random.below(basis->free.size());
        const auto s = static_cast<Eigen::Index>(slider);
        const Interval stops = interval(bounds, free, slider);
        REQUIRE(stops.low <= free[s] + 1e-12);
        REQUIRE(stops.high >= free[s] - 1e-12);
        const double from = std::max(low[s], stops.low), to = std::min(high[s], stops.high);
        if (from < to) {
          free[s] = random.uniform(from, to);
          ++moved;
        }
        const Values values = basis->values(free, pins);
        for (std::size_t i = 0; i < steps.constraints.size(); ++i) {
          if (steps.evidence[i].is_kept) worst = std::max(worst, steps.constraints[i].residual(values));
        }
        for (std::size_t i = 0; i < steps.layout.size(); ++i) {
          if (steps.layout.parameters[i].quantity == Quantity::size) {
            least_size = std::min(least_size, values[static_cast<Eigen::Index>(i)]);
          }
        }
        for (const Bound& bound : bounds) least_gap = std::min(least_gap, bound.form.dot(free) + bound.constant);
      }
      CHECK(worst < 1e-12);
      CHECK(least_size > 0);
      CHECK(least_gap > -1e-12);
      CHECK(moved > 900);
    }
  }
}

TEST_CASE("optional parts: chair arms, backs, camera grips and flashes, table shelves come in groups") {
  const std::map<std::string, std::vector<std::vector<std::string>>> wanted = {
      {"bottle", {}},
      {"car", {}},
      {"camera", {{"grip"}, {"flash"}}},
      {"chair", {{"back"}, {"left_arm", "right_arm"}}},
      {"table", {{"table_middle"}}}};
  for (const FamilyCase& one : family_cases()) {
    CAPTURE(one.name);
    std::vector<std::vector<std::string>> found;
    for (const OptionalGroup& group : optional_groups(variations_of(one), one.model.parts.size())) {
      std::vector<std::string>& ids = found.emplace_back();
      for (const std::size_t part : group.parts) ids.push_back(one.model.parts[part].id);
    }
    CHECK(found == wanted.at(one.name));
  }
}

TEST_CASE("mixing starts at the base, ends at a variation, and is continuous") {
  const Eigen::VectorXd base = Eigen::VectorXd::Constant(1, 1.0), a = Eigen::VectorXd::Constant(1, 2.0),
                        b = Eigen::VectorXd::Constant(1, 5.0);
  CHECK(mixed(base, {a, b}, {0, 0})[0] == 1);
  CHECK(mixed(base, {a, b}, {1, 0})[0] == 2);
  CHECK(mixed(base, {a, b}, {0.5, 0})[0] == doctest::Approx(1.5));
  CHECK(mixed(base, {a, b}, {2, 2})[0] == doctest::Approx(3.5));
  CHECK(mixed(base, {a, b}, {1e-9, 0})[0] == doctest::Approx(1).epsilon(1e-8));
}
