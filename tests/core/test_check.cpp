#include "core/check/check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/check/replay.h"
#include "core/edit/evaluate.h"
#include "core/prove/prove.h"
#include "core/prove/range.h"
#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

namespace {

Program proven(const Shape& shape, Program program, const std::set<std::string>& disabled = {}) {
  for (std::size_t l = 0; l < program.layers.size(); ++l) {
    Parameter& parameter = program.layers[l].parameter;
    const Range range = find_range(shape, program, l, -0.35, 0.35);
    parameter.min = range.min;
    parameter.max = range.max;
    program.layers[l].relations = prove_relations(shape, program, l, disabled);
  }
  return program;
}

Program widened(const Shape& shape) {
  return proven(shape, hand::program(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1"),
                                             statement(Op::translate, "leg_left", Vec3::UnitX(), "0.3*x1"),
                                             statement(Op::translate, "leg_right", -Vec3::UnitX(), "0.3*x1"),
                                             statement(Op::scale_1d, "back", Vec3::UnitX(), "x1")}));
}

std::string first_finding(const CheckReport& report) {
  return report.accepted() ? "" : report.findings[0].place + ": " + report.findings[0].text;
}

}  // namespace

TEST_CASE("the checker's evaluator agrees with the real one") {
  Random random(11);
  for (const Shape& shape : {hand::chair(), hand::slats(), hand::ring(), hand::fan()}) {
    for (int i = 0; i < 20; ++i) {
      Program program = hand::random_program(shape, random);
      for (const Relation& relation : shape.relations) {
        if (!relation.is_group() || random.below(2) == 0) continue;
        const auto anchor = static_cast<Anchor>(random.below(4));
        auto& statements = program.layers[0].statements;
        statements.erase(std::remove_if(statements.begin(), statements.end(),
                                        [&](const Statement& s) {
                                          const Part& part = shape.parts[*shape.find_part(s.part)];
                                          return part.group && !part.is_virtual();
                                        }),
                         statements.end());
        statements.push_back(hand::group_statement(Op::change_delta, relation.id, "0.5*x1", anchor));
        statements.push_back(hand::group_statement(Op::change_count, relation.id, "12*x1", anchor));
        statements.push_back(hand::group_statement(Op::change_delta, relation.id, "x1", anchor));
      }
      const Evaluator evaluator(program, shape);
      const replay::Replay replay(shape, program);
      for (const double x : {-0.35, -0.123, 0.0, 0.2, 0.35}) {
        const State state = evaluator({x});
        const replay::Scene scene = replay.scene(1, {{"x1", x}});
        for (const PartIndex p : shape.parts.indices()) {
          const replay::Box& box = scene.parts[p];
          for (int k = 0; k < 8; ++k) {
            CHECK((box[static_cast<std::size_t>(k)] - state.parts[p].row(k).transpose()).norm() < 1e-8);
          }
        }
        for (const RelationIndex r : shape.relations.indices()) {
          if (!shape.relations[r].is_group()) continue;
          CHECK(scene.groups[r].instances.size() == state.groups[r].instances.size());
        }
      }
    }
  }
}

TEST_CASE("the checker reads amounts as the grammar says") {
  const std::map<std::string, double> at = {{"x1", 0.5}, {"y", 2}};
  CHECK(replay::value_of("-x1^2", at) == doctest::Approx(-0.25));
  CHECK(replay::value_of("2^3^2", at) == doctest::Approx(512));
  CHECK(replay::value_of("x1^-2", at) == doctest::Approx(4));
  CHECK(replay::value_of("1 - 2 - 3*x1/y", at) == doctest::Approx(-1.75));
  CHECK(replay::value_of("max(min(y,1),x1,-pi)+floor(-0.5)+abs(-2)", at) == doctest::Approx(2));
  CHECK(replay::value_of("atan2(1,0)+sqrt(4)+sin(0)+cos(0)+tan(0)", at) == doctest::Approx(3 + 1.5707963267948966));
  for (const std::string bad : {"", "x", "1/0", "sqrt(-1)", "x1+", "(x1", "x1)", "2 3", "sin(1,2)", "foo(1)"}) {
    CAPTURE(bad);
    CHECK(std::isnan(replay::value_of(bad, at)));
  }
}

TEST_CASE("genuine programs are accepted") {
  Random random(5);
  for (const Shape& shape : {hand::chair(), hand::slats(), hand::ring(), hand::fan()}) {
    for (int i = 0; i < 6; ++i) {
      const Program program = proven(shape, hand::random_program(shape, random));
      const CheckReport report = check_program(shape, program);
      CHECK_MESSAGE(report.accepted(), first_finding(report));
      CHECK(report.relations == static_cast<int>(program.layers[0].relations.size()));
    }
  }
  const Shape shape = hand::chair();
  CHECK(check_program(shape, widened(shape)).accepted());
  const Shape row = hand::slats();
  const CheckReport counted = check_program(
      row, proven(row, hand::program(row, {hand::group_statement(Op::change_count, "t1", "10*x1", Anchor::middle),
                                           statement(Op::scale_1d, "rail", Vec3::UnitX(), "floor(10*x1)/5")})));
  CHECK_MESSAGE(counted.accepted(), first_finding(counted));
  const Program apart =
      proven(row, hand::program(row, {statement(Op::translate, "rail", Vec3::UnitZ(), "x1")}), {"t1"});
  CHECK_MESSAGE(check_program(row, apart).accepted(), first_finding(check_program(row, apart)));
}

TEST_CASE("the joints of instances must be told, as far as the instances exist") {
  const Shape shape = hand::fan();
  const Program wider =
      proven(shape, hand::program(shape, {hand::group_statement(Op::change_delta, "o1", "x1", Anchor::fit),
                                          hand::group_statement(Op::change_count, "o1", "5*x1", Anchor::fit)}));
  const CheckReport genuine = check_program(shape, wider);
  CHECK_MESSAGE(genuine.accepted(), first_finding(genuine));
  CHECK(genuine.relations == 7);
  Program silent = wider;
  std::erase_if(silent.layers[0].relations, [](const RelationReport& report) { return report.id == "a3"; });
  CHECK(first_finding(check_program(shape, silent)).find("a3 touches an edited part but is not reported") !=
        std::string::npos);
  Program bold = wider;
  for (RelationReport& report : bold.layers[0].relations) {
    if (report.id == "a3") report = {"a3", RelationStatus::held, 0.001, Proof::certified, {}};
  }
  CHECK_FALSE(check_program(shape, bold).accepted());

  Program later = hand::program(shape, {hand::group_statement(Op::change_count, "o1", "10*x1", Anchor::fit)});
  later.layers[0].parameter.value = 0.25;
  later.layers.push_back(hand::program(shape, {statement(Op::translate, "feet", Vec3::UnitY(), "0.1*x2")}).layers[0]);
  later.layers[1].parameter.name = "x2";
  for (std::size_t l = 0; l < 2; ++l) later.layers[l].relations = prove_relations(shape, later, l, {});
  CHECK_MESSAGE(check_program(shape, later).accepted(), first_finding(check_program(shape, later)));
  later.layers[1].relations.push_back({"a2", RelationStatus::held, 0, Proof::certified, {}});
  CHECK_FALSE(check_program(shape, later).accepted());
}

TEST_CASE("every finding says what would remove it") {
  const Shape shape = hand::chair();
  Program program = widened(shape);
  program.layers[0].parameter.value = 3;
  program.layers[0].relations.pop_back();
  program.layers[0].relations[0].worst *= 2;
  program.layers[0].statements[1].amount = parse_amount("0.3*x1+0.001").value();
  const CheckReport report = check_program(shape, program, nlohmann::json::object(), 0);
  CHECK(report.findings.size() >= 5);
  for (const Finding& finding : report.findings) {
    CAPTURE(finding.text);
    CHECK_FALSE(finding.fix.empty());
  }
}

TEST_CASE("programs that were tampered with are rejected") {
  const Shape shape = hand::chair();
  const Program genuine = widened(shape);
  REQUIRE(check_program(shape, genuine).accepted());
  const auto rejects = [&](const char* what, const auto& change) {
    Program program = genuine;
    change(program.layers[0]);
    CAPTURE(what);
    CHECK_FALSE(check_program(shape, program).accepted());
  };
  rejects("changed amount", [](Layer& l) { l.statements[1].amount = parse_amount("0.31*x1").value(); });
  rejects("an amount that is not 0 at 0",
          [](Layer& l) { l.statements[1].amount = parse_amount("0.3*x1+0.001").value(); });
  rejects("missing statement", [](Layer& l) { l.statements.pop_back(); });
  rejects("another operator", [](Layer& l) { l.statements[0].op = Op::scale_3d; });
  rejects("another part", [](Layer& l) { l.statements[3].part = "handle"; });
  rejects("unknown part", [](Layer& l) { l.statements[3].part = "ghost"; });
  rejects("missing direction", [](Layer& l) { l.statements[1].direction.reset(); });
  rejects("wrong status", [](Layer& l) {
    for (RelationReport& r : l.relations) {
      if (r.status == RelationStatus::held) r.status = RelationStatus::broken;
    }
  });
  rejects("a broken relation called held", [](Layer& l) {
    for (RelationReport& r : l.relations) r.status = RelationStatus::held;
  });
  rejects("a broken relation called held with a small bound", [](Layer& l) {
    for (RelationReport& r : l.relations) {
      if (r.status == RelationStatus::broken) r = {r.id, RelationStatus::held, 0.001, r.proof, {}};
    }
  });
  rejects("a bound far too large", [](Layer& l) {
    for (RelationReport& r : l.relations) {
      if (r.status == RelationStatus::broken) r.worst *= 2;
    }
  });
  rejects("missing report", [](Layer& l) { l.relations.pop_back(); });
  rejects("report twice", [](Layer& l) { l.relations.push_back(l.relations[0]); });
  rejects("report of an unknown relation", [](Layer& l) { l.relations[0].id = "a99"; });
  rejects("range without 0", [](Layer& l) { l.parameter.min = 0.1; });
  rejects("range beyond collapse", [](Layer& l) { l.parameter.min = -1.5; });
  rejects("value outside the range", [](Layer& l) { l.parameter.value = 0.7; });
  rejects("amount beyond 5", [](Layer& l) { l.statements[0].amount = parse_amount("20*x1").value(); });
  Program foreign = genuine;
  foreign.shape_sha256 = std::string(64, 'f');
  CHECK_FALSE(check_program(shape, foreign).accepted());
}

TEST_CASE("a trace is a claim like any other") {
  const Shape shape = hand::chair();
  Program program = widened(shape);
  auto& statements = program.layers[0].statements;
  const WhyKind kinds[] = {WhyKind::seed, WhyKind::attachment, WhyKind::symmetry, WhyKind::attachment};
  // leg_left and leg_right come after back, which is first by id among equals; leg_right then has a broken symmetry.
  std::rotate(statements.begin() + 1, statements.begin() + 3, statements.end());
  const WhyKind order[] = {kinds[0], kinds[3], kinds[1], kinds[2]};
  for (std::size_t i = 0; i < 4; ++i) statements[i].why = Why{order[i], {}};
  program.layers[0].relations = prove_relations(shape, program, 0, {});

  using nlohmann::json;
  const auto step = [](const std::string& part, const std::string& kind, int statement, const json& before,
                       const json& after) {
    json entries[2] = {json::array(), json::array()};
    for (int i = 0; i < 2; ++i) {
      for (const auto& [id, by] : (i == 0 ? before : after).items())
        entries[i].push_back({{"relation", id}, {"by", by}});
    }
    return json{{"part", part},
                {"kind", kind},
                {"statements", json::array({statement})},
                {"pulled_by", entries[0]},
                {"result", entries[1]},
                {"left_broken", json::array()},
                {"tolerance", 0.002},
                {"candidates", {{"own", 100}, {"neighbour", 0}, {"pairs", 0}}},
                {"survivors", 3},
                {"solved", 1},
                {"symmetry_cost", 0},
                {"energy", 0.5},
                {"runners_up", json::array()},
                {"why", ""}};
  };
  const json trace = {
      {"format", "parsel/trace"},
      {"version", 1},
      {"parameter", "x1"},
      {"samples", {-0.35, -0.1, 0.1, 0.35}},
      {"tolerances", {{"exact", 0.002}, {"one_edited", 0.0144}, {"both_edited", 0.0433}}},
      {"dissolved", json::array()},
      {"disabled", json::array()},
      {"steps",
       {step("seat", "seed", 0, json::object(), json::object()),
        step("back", "attachment", 1, {{"a3", 0.14}}, {{"a3", 0.0}}),
        // The handle is pulled at by one relation as well, but comes later by id; here it is the mirror that decides.
        step("handle", "keep_fixed", 4, {{"a4", 0.0875}}, {{"a4", 0.0875}}),
        step("leg_left", "attachment", 2, {{"a1", 0.105}}, {{"a1", 0.0}}),
        step("leg_right", "symmetry", 3, {{"r1", 0.105}, {"a2", 0.105}}, {{"r1", 0.0}, {"a2", 0.0}})}},
      {"notes", json::array()},
      {"stop", "every part is edited"}};
  Statement fixed = statement(Op::keep_fixed, "handle", Vec3::UnitX(), "0");
  fixed.why = Why{WhyKind::breaking, {"a4"}};
  statements.push_back(fixed);
  json genuine = trace;
  genuine["steps"][2]["left_broken"] = {"a4"};

  const CheckReport accepted = check_program(shape, program, genuine, 0);
  CHECK_MESSAGE(accepted.accepted(), first_finding(accepted));
  CHECK(accepted.claims > 50);

  const auto rejects = [&](const char* what, const auto& change) {
    json changed = genuine;
    change(changed);
    CAPTURE(what);
    CHECK_FALSE(check_program(shape, program, changed, 0).accepted());
  };
  rejects("another deviation", [](json& t) { t["steps"][1]["pulled_by"][0]["by"] = 0.13; });
  rejects("a result that is not so", [](json& t) { t["steps"][2]["result"][0]["by"] = 0.0; });
  rejects("broken relation concealed", [](json& t) { t["steps"][2]["left_broken"] = json::array(); });
  rejects("held relation called broken", [](json& t) { t["steps"][1]["left_broken"] = {"a3"}; });
  rejects("another order", [](json& t) { std::swap(t["steps"][1], t["steps"][4]); });
  rejects("a step left out", [](json& t) { t["steps"].erase(3); });
  rejects("another part's statement", [](json& t) { t["steps"][1]["statements"] = {2}; });
  rejects("another reason", [](json& t) { t["steps"][4]["kind"] = "attachment"; });
  rejects("a relation left out", [](json& t) { t["steps"][4]["pulled_by"].erase(1); });
  rejects("another parameter", [](json& t) { t["parameter"] = "x2"; });
  rejects("a dissolved group", [](json& t) { t["disabled"] = {"r1"}; });
  rejects("candidates out of nothing", [](json& t) { t["steps"][1]["candidates"]["own"] = 0; });
  rejects("a missing field", [](json& t) { t["steps"][1].erase("result"); });
  rejects("a mistyped field", [](json& t) { t["samples"] = "many"; });
}
