#include "core/family/ranking.h"

#include <doctest/doctest.h>

#include <cmath>
#include <ctime>

#include "core/base/random.h"
#include "core/base/tolerance.h"
#include "core/family/volume.h"
#include "tests/core/family_data.h"

using namespace parsel;
using namespace parsel::family;

namespace {

struct Found {
  std::size_t constraints = 0, dimensions = 0;
};

Found cut(const Ranking& ranking, const std::vector<Constraint>& constraints, std::size_t end, std::size_t parameters) {
  Elimination elimination(parameters);
  for (std::size_t i = 0; i < end; ++i) {
    for (const SparseRow& row : constraints[ranking.order[i]].rows()) elimination.add(row);
  }
  return {end, parameters - elimination.rank()};
}

cad::Part part(cad::Kind kind, const Vec3& centre, const Vec3& size, int axis = 1) {
  cad::Part made;
  made.kind = kind;
  made.centre = centre;
  made.size = size;
  made.axis = axis;
  return made;
}

}  // namespace

TEST_CASE("ranking: the paper's selection on hand-made variations, by both cut-offs") {
  for (const test::FamilyCase& one : test::family_cases()) {
    CAPTURE(one.name);
    const Layout layout = layout_of(one.model, Vocabulary::paper);
    const Values base = values_of(layout, one.model);
    const std::vector<Constraint> constraints = find_candidates(layout, one.model, base, 1e-6).holding;
    const Ranking ranking = rank_constraints(one.model, layout, base, constraints, test::variations_of(one));
    const nlohmann::json& wanted = one.expected["votes"][0]["greedy_constraints_and_dimensions"];
    const Found mean = cut(ranking, constraints, cutoff_by_mean(ranking.losses), layout.size());
    const Found slope = cut(ranking, constraints, cutoff_by_derivative(ranking.losses), layout.size());
    CHECK(nlohmann::json{mean.constraints, mean.dimensions} == wanted["mean_shift_of_loss"]);
    CHECK(nlohmann::json{slope.constraints, slope.dimensions} == wanted["mean_shift_of_derivative"]);
    // Up to the constraints that all variations share nothing is lost.
    const std::size_t by_exact_test = one.expected["votes"][0]["exact"]["independent"];
    CHECK(ranking.losses[by_exact_test - 1] < 1e-9);
    CHECK(ranking.losses[by_exact_test] > 1e-3);
  }
}

TEST_CASE("ranking: without variations everything that holds in the base is kept, at no loss") {
  for (const test::FamilyCase& one : test::family_cases()) {
    CAPTURE(one.name);
    const Layout layout = layout_of(one.model, Vocabulary::paper);
    const Values base = values_of(layout, one.model);
    const std::vector<Constraint> constraints = find_candidates(layout, one.model, base, 1e-6).holding;
    const Ranking ranking = rank_constraints(one.model, layout, base, constraints, {});
    CHECK(ranking.losses.back() < 1e-9);
    const Found all = cut(ranking, constraints, ranking.order.size(), layout.size());
    CHECK(all.dimensions == one.expected["holding"]["null_space"]);
  }
}

TEST_CASE("ranking: one percent of noise on the chair loses and adds little") {
  for (const test::FamilyCase& one : test::family_cases()) {
    if (one.name != "chair") continue;
    const Layout layout = layout_of(one.model, Vocabulary::paper);
    const Values base = values_of(layout, one.model);
    const std::vector<Constraint> constraints = find_candidates(layout, one.model, base, 1e-6).holding;
    // The set that was written down beforehand. Both lists are in one order, so that names need no translation.
    std::map<std::string, std::size_t> by_name;
    for (std::size_t i = 0; i < constraints.size(); ++i) by_name[one.expected["holding"]["names"][i]] = i;
    Elimination expert(layout.size());
    std::vector<std::size_t> experts;
    for (const nlohmann::json& name : one.expected["expert"]["names"]) {
      experts.push_back(by_name.at(name));
      for (const SparseRow& row : constraints[experts.back()].rows()) expert.add(row);
    }
    REQUIRE(expert.rank() == one.expected["expert"]["rank"]);
    // By inclusion in the span of the other's rows.
    const auto is_in = [&](const Elimination& span, std::size_t i) {
      const std::vector<SparseRow> rows = constraints[i].rows();
      return std::none_of(rows.begin(), rows.end(), [&](const SparseRow& row) { return span.raises_rank(row); });
    };
    constexpr int seeds = 10;
    double precision = 0, recall = 0, seconds = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      std::vector<Variation> variations = test::variations_of(one);
      Random random(static_cast<std::uint64_t>(seed));
      for (Variation& variation : variations) {
        for (double& value : variation.values) {  // Gaussian, σ 1 % of the seat's width
          const double u = 1 - random.unit(), v = random.unit();
          value += 0.01 * std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * v);
        }
      }
      const std::clock_t start = std::clock();
      const Ranking ranking = rank_constraints(one.model, layout, base, constraints, variations);
      seconds = std::max(seconds, double(std::clock() - start) / CLOCKS_PER_SEC);
      const std::size_t end = cutoff_by_mean(ranking.losses);
      Elimination found(layout.size());
      for (std::size_t i = 0; i < end; ++i) {
        for (const SparseRow& row : constraints[ranking.order[i]].rows()) found.add(row);
      }
      std::size_t right = 0, met = 0;
      for (std::size_t i = 0; i < end; ++i) right += is_in(expert, ranking.order[i]);
      for (const std::size_t i : experts) met += is_in(found, i);
      const double p = double(right) / double(end), r = double(met) / double(experts.size());
      precision += p / seeds;
      recall += r / seeds;
    }
    MESSAGE("at most ", seconds, " s of processor time, precision ", precision, ", recall ", recall);
    CHECK(recall >= 0.9);
    CHECK(precision >= 0.85);
  }
}

TEST_CASE("cut-offs: where the losses rise") {
  CHECK(cutoff_by_mean({0, 0, 0, 0, 0.5, 0.6, 0.7}) == 4);
  CHECK(cutoff_by_derivative({0, 0, 0, 0, 0.5, 1.1, 1.6}) == 4);
  CHECK(cutoff_by_mean({}) == 0);
  CHECK(cutoff_by_derivative({0.1}) == 1);
}

TEST_CASE("volume: boxes exactly, round parts nearly") {
  const std::vector<bool> one = {true};
  const auto volume = [&](const cad::Part& p) { return overlap({p}, {p}, one).a; };
  CHECK(volume(part(cad::Kind::box, {1, 2, 3}, {2, 3, 4})) == doctest::Approx(24).epsilon(1e-12));
  for (int axis = 0; axis < 3; ++axis) {
    CAPTURE(axis);
    cad::Part p = part(cad::Kind::cylinder, {1, 2, 3}, {2, 2, 2}, axis);
    CHECK(volume(p) == doctest::Approx(2 * pi).epsilon(0.01));
    p.kind = cad::Kind::cone;
    for (const int towards : {-1, 1}) {
      p.towards = towards;
      for (const double top : {0.0, 1.0, 3.0}) {
        CAPTURE(top);
        p.top = top;
        const double r = top / 2;
        CHECK(volume(p) == doctest::Approx(2 * pi / 3 * (1 + r + r * r)).epsilon(0.015));
      }
    }
  }
  CHECK(volume(part(cad::Kind::sphere, {0, 0, 0}, {2, 4, 6})) == doctest::Approx(8 * pi).epsilon(0.01));

  const std::vector<cad::Part> a = {part(cad::Kind::box, {0, 0, 0}, {2, 2, 2}),
                                    part(cad::Kind::box, {1, 0, 0}, {2, 2, 2})};
  const std::vector<cad::Part> b = {part(cad::Kind::box, {0, 1, 0}, {2, 2, 2}),
                                    part(cad::Kind::box, {9, 0, 0}, {2, 2, 2})};
  const Overlap found = overlap(a, b, {true, true});
  CHECK(found.a == doctest::Approx(12));
  CHECK(found.b == doctest::Approx(16));
  CHECK(found.both == doctest::Approx(4));
  CHECK(found.iou() == doctest::Approx(4.0 / 24));
  CHECK(overlap(a, b, {false, true}).both == 0);
}
