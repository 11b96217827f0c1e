#include "core/family/candidates.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/core/family_data.h"

using namespace parsel;
using namespace parsel::family;
using parsel::test::family_cases;
using parsel::test::FamilyCase;

namespace {

std::size_t rank_of(const std::vector<Constraint>& constraints, std::size_t parameters) {
  Elimination elimination(parameters);
  for (const Constraint& constraint : constraints) {
    for (const SparseRow& row : constraint.rows()) elimination.add(row);
  }
  CHECK_FALSE(elimination.is_lost());
  return elimination.rank();
}

Candidates candidates_of(const FamilyCase& one, Vocabulary vocabulary, double tolerance) {
  const Layout layout = layout_of(one.model, vocabulary);
  return find_candidates(layout, one.model, values_of(layout, one.model), tolerance);
}

std::size_t holding_of(const Candidates& found, ConstraintKind kind) {
  std::size_t count = 0;
  for (const Constraint& constraint : found.holding) count += constraint.kind == kind;
  return count;
}

/// A box and an upright cylinder on it.
cad::Model box_and_cylinder() {
  cad::Model model;
  model.parts.resize(2);
  model.parts[0].id = "box";
  model.parts[0].size = {4, 2, 4};
  model.parts[1].id = "can";
  model.parts[1].kind = cad::Kind::cylinder;
  model.parts[1].centre = {0, 3, 1};
  model.parts[1].size = {2, 4, 2};
  return model;
}

}  // namespace

TEST_CASE(
    "candidates: ReparamCAD's five programs have as many parameters, candidates and base constraints as its table") {
  for (const FamilyCase& one : family_cases()) {
    CAPTURE(one.name);
    const Layout layout = layout_of(one.model, Vocabulary::paper);
    CHECK(layout.size() == one.expected["table1"]["parameters"]);
    std::vector<std::string> names;
    for (const Parameter& parameter : layout.parameters) names.push_back(parameter.name);
    CHECK(nlohmann::json(names) == one.expected["parameter_names"]);
    for (const double tolerance : {1e-12, 1e-9, 1e-6, 1e-4, 2e-2}) {
      CAPTURE(tolerance);
      const Candidates found = candidates_of(one, Vocabulary::paper, tolerance);
      CHECK(found.count.all() == one.expected["candidates"]["all"]);
      CHECK(found.holding.size() == one.expected["table1"]["base_constraints"]);
      CHECK(rank_of(found.holding, layout.size()) == one.expected["holding"]["rank"]);
      std::size_t rows = 0;
      for (const Constraint& constraint : found.holding) rows += constraint.rows().size();
      CHECK(rows == one.expected["holding"]["rows"]);
      for (const ConstraintKind kind : constraint_kinds) {
        const std::string key(to_string(kind));
        CAPTURE(key);
        CHECK(found.count.by_kind[static_cast<std::size_t>(kind)] == one.expected["candidates"].value(key, 0U));
        CHECK(holding_of(found, kind) == one.expected["holding"].value(key, 0U));
      }
    }
  }
}

TEST_CASE("candidates: planes that bound wheels tie the front of a car to its rear") {
  for (const FamilyCase& one : family_cases()) {
    CAPTURE(one.name);
    const Layout layout = layout_of(one.model, Vocabulary::extended);
    const Candidates found = candidates_of(one, Vocabulary::extended, 1e-6);
    const std::size_t rank = rank_of(found.holding, layout.size());
    if (one.name == "car") {
      CHECK(found.holding.size() == 110);
      CHECK(rank == 32);
    } else {
      CHECK(rank == one.expected["holding"]["rank"]);
    }
  }
}

TEST_CASE("candidates: a box and a cylinder, counted by hand") {
  const cad::Model model = box_and_cylinder();
  const Layout layout = layout_of(model, Vocabulary::paper);
  const Candidates found = find_candidates(layout, model, values_of(layout, model), 1e-9);
  CHECK(found.count.by_kind[0] == 1 + 6 + 1);   // x and z: the box's own two; y: four planes
  CHECK(found.count.by_kind[1] == 1);           // along y
  CHECK(found.count.by_kind[2] == 10 * 9 / 2);  // eight corners and two cap centres
  CHECK(found.count.by_kind[3] == 6 * 5 / 2);
  std::vector<std::string> ids;
  for (const Constraint& constraint : found.holding) ids.push_back(constraint.id());
  CHECK(ids == std::vector<std::string>{"coplanar(box.y+,can.y-)", "equal(box.sx,box.sz)", "equal(box.sx,can.sy)",
                                        "equal(box.sy,can.sx)", "equal(box.sy,can.sz)", "equal(box.sz,can.sy)",
                                        "equal(can.sx,can.sz)"});
  const SparseRow row = found.holding[0].rows()[0];
  CHECK(row.at(layout.find("box.cy")) == Rational(1));
  CHECK(row.at(layout.find("box.sy")) == Rational(1, 2));
  CHECK(row.at(layout.find("can.cy")) == Rational(-1));
  CHECK(row.at(layout.find("can.sy")) == Rational(1, 2));
  const Layout wide = layout_of(model, Vocabulary::extended);
  CHECK(find_candidates(wide, model, values_of(wide, model), 1e-9).count.by_kind[0] == 18);
}

TEST_CASE("elimination: exact, in the order that is preferred, and honest about what does not fit") {
  Elimination natural(3);
  CHECK(natural.add({{0, Rational(1)}, {1, Rational(1, 2)}}));
  CHECK(natural.add({{0, Rational(1)}, {2, Rational(-1)}}));
  CHECK_FALSE(natural.add({{1, Rational(1, 2)}, {2, Rational(1)}}));
  CHECK(natural.rank() == 2);
  CHECK(natural.rows().at(0).at(2) == Rational(-1));
  CHECK(natural.rows().at(1).at(2) == Rational(2));
  Elimination last_first({2, 1, 0});
  CHECK(last_first.add({{0, Rational(1)}, {1, Rational(1, 2)}}));
  CHECK(last_first.rows().begin()->first == 1);

  const Rational large(std::int64_t{1} << 62);
  CHECK((large * Rational(4)).is_lost());
  CHECK((large + large).is_lost());
  CHECK((Rational(1) / Rational(0)).is_lost());
  Elimination lost(2);
  lost.add({{0, large}, {1, Rational(1, 3)}});
  lost.add({{0, Rational(1, 5)}, {1, large}});
  CHECK(lost.is_lost());
}
