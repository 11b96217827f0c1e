#include "core/prove/prove.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/tolerance.h"
#include "core/edit/evaluate.h"
#include "core/prove/deviation.h"
#include "core/prove/scope.h"
#include "core/prove/slack.h"
#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

namespace {

const RelationReport& find(const std::vector<RelationReport>& reports, const std::string& id) {
  for (const RelationReport& report : reports) {
    if (report.id == id) return report;
  }
  static const RelationReport missing{"missing", RelationStatus::disabled, -1, Proof::sampled, {}};
  return missing;
}

std::vector<std::string> ids(const std::vector<RelationReport>& reports) {
  std::vector<std::string> result;
  for (const RelationReport& report : reports) result.push_back(report.id);
  return result;
}

std::vector<RelationReport> prove(const Shape& shape, const Program& program,
                                  const std::set<std::string>& disabled = {}) {
  return prove_relations(shape, program, 0, disabled);
}

void check_proven(const RelationReport& report, RelationStatus status, double worst) {
  CAPTURE(report.id);
  CHECK(report.status == status);
  CHECK(report.proof == Proof::certified);
  CHECK(report.worst >= worst - 1e-12);
  CHECK(report.worst <= worst * 1.01 + 1.1e-6);
}

constexpr auto held = RelationStatus::held;
constexpr auto broken = RelationStatus::broken;

}  // namespace

TEST_CASE("the hand-built shapes are valid") {
  for (const Shape& shape : {hand::chair(), hand::slats(), hand::ring()}) {
    const Status valid = validate(shape);
    CHECK_MESSAGE(valid.ok(), (valid.ok() ? "" : valid.error().message()));
  }
}

TEST_CASE("widening a seat alone breaks what hangs on it, by as much as it moves") {
  const Shape shape = hand::chair();
  const auto reports = prove(shape, hand::program(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1")}));
  CHECK(ids(reports) == std::vector<std::string>{"a1", "a2", "a3"});
  check_proven(find(reports, "a1"), broken, 0.3 * 0.35);
  check_proven(find(reports, "a2"), broken, 0.3 * 0.35);
  check_proven(find(reports, "a3"), broken, 0.4 * 0.35);
}

TEST_CASE("edits that follow exactly are certified to hold, whatever the form of their amounts") {
  const Shape shape = hand::chair();
  for (const std::string amount : {"x1", "sin(x1)", "sqrt(1+x1)-1", "atan2(x1,1-x1)", "x1^3/(1+x1^2)",
                                   "0.1*floor(10*x1)", "abs(x1)", "min(x1,0.1)"}) {
    CAPTURE(amount);
    const auto reports = prove(
        shape, hand::program(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), amount),
                                     statement(Op::translate, "leg_left", Vec3::UnitX(), "0.3*(" + amount + ")"),
                                     statement(Op::translate, "leg_right", -Vec3::UnitX(), "0.3*(" + amount + ")"),
                                     statement(Op::scale_1d, "back", Vec3::UnitX(), amount)}));
    CHECK(reports.size() == 5);
    for (const std::string id : {"r1", "a1", "a2", "a3"}) check_proven(find(reports, id), held, 0);
  }
}

TEST_CASE("two parts that turn together hold; a straight push beside a turn misses by r(1 - cos x)") {
  const Shape shape = hand::chair();
  const Vec3 hinge(-0.4, 0, -0.35);
  const auto together =
      prove(shape, hand::program(shape, {statement(Op::rotate, "back", Vec3::UnitY(), "x1", hinge),
                                         statement(Op::rotate, "handle", Vec3::UnitY(), "x1", hinge)}));
  check_proven(find(together, "a4"), held, 0);

  // The line's far point (0.4, 0.05, -0.35) turns about its near one (-0.4, …): 0.8·sin x along z, 0.8·(1 - cos x)
  // along x.
  const auto alone = prove(shape, hand::program(shape, {statement(Op::rotate, "back", Vec3::UnitY(), "x1", hinge)}));
  check_proven(find(alone, "a3"), broken, 0.8 * std::sin(0.35));

  Shape lever = hand::chair();
  lever.relations = {};
  hand::attach(lever, "a1", *lever.find_part("seat"), *lever.find_part("leg_left"), {{0.3, -0.05, 0}});
  const auto pushed =
      prove(lever, hand::program(lever, {statement(Op::rotate, "seat", Vec3::UnitY(), "x1"),
                                         statement(Op::translate, "leg_left", -Vec3::UnitZ(), "0.3*sin(x1)")}));
  check_proven(find(pushed, "a1"), held, 0.3 * (1 - std::cos(0.35)));
}

TEST_CASE("the tolerance is the narrower one while one of the two parts is not edited") {
  const Shape shape = hand::chair();
  const auto one = prove(shape, hand::program(shape, {statement(Op::translate, "leg_left", Vec3::UnitX(), "0.1*x1")}));
  check_proven(find(one, "a1"), broken, 0.035);
  check_proven(find(one, "r1"), broken, 0.035);
  const auto both = prove(shape, hand::program(shape, {statement(Op::translate, "leg_left", Vec3::UnitX(), "0.1*x1"),
                                                       statement(Op::shear, "seat", Vec3::UnitZ(), "0.01*x1")}));
  CHECK(find(both, "a1").status == held);
  const auto kept = prove(shape, hand::program(shape, {statement(Op::translate, "leg_left", Vec3::UnitX(), "0.1*x1"),
                                                       statement(Op::keep_fixed, "seat", Vec3::UnitX(), "0")}));
  CHECK(find(kept, "a1").status == broken);
  CHECK(ids(kept) == std::vector<std::string>{"r1", "a1"});
}

TEST_CASE("jumps are bounded from both sides") {
  const Shape shape = hand::chair();
  // x - floor(10x)/10 comes as near to 0.1 as it likes, just below every tenth.
  const auto reports =
      prove(shape, hand::program(shape, {statement(Op::translate, "seat", Vec3::UnitX(), "x1"),
                                         statement(Op::translate, "leg_left", Vec3::UnitX(), "0.1*floor(10*x1)")}));
  check_proven(find(reports, "a1"), broken, 0.1 - 1e-8);
}

TEST_CASE("a form without a known bound is sampled, and says so") {
  const Shape shape = hand::chair();
  const auto reports = prove(shape, hand::program(shape, {statement(Op::translate, "seat", Vec3::UnitX(), "2^x1-1")}));
  const RelationReport& report = find(reports, "a1");
  CHECK(report.proof == Proof::sampled);
  CHECK(report.status == broken);
  CHECK(report.worst == doctest::Approx(std::pow(2.0, 0.35) - 1).epsilon(1e-12));
}

TEST_CASE("disabled relations are reported as such, by id or by kind") {
  const Shape shape = hand::chair();
  const Program program = hand::program(shape, {statement(Op::translate, "leg_left", Vec3::UnitX(), "x1")});
  const auto by_id = prove(shape, program, {"r1"});
  CHECK(find(by_id, "r1").status == RelationStatus::disabled);
  CHECK(find(by_id, "r1").worst == doctest::Approx(0.35));
  CHECK(find(by_id, "a1").status == broken);
  CHECK(find(prove(shape, program, {"kind:reflection"}), "r1").status == RelationStatus::disabled);
}

TEST_CASE("a row follows its parent: spacing, count and scale keep it a row") {
  const Shape shape = hand::slats();
  const auto widened = prove(shape, hand::program(shape, {statement(Op::scale_1d, "rail", Vec3::UnitX(), "0.48*x1"),
                                                          statement(Op::scale_1d, "slats", Vec3::UnitX(), "x1")}));
  CHECK(ids(widened) == std::vector<std::string>{"t1", "a1", "a2", "a3"});
  check_proven(find(widened, "t1"), held, 0);
  // The outer slats move by 0.2·x, the rail at their place by 0.2·0.48·x.
  check_proven(find(widened, "a2"), held, 0.2 * 0.52 * 0.35);
  // The parent's corners move by 0.24·x, the rail at their place by 0.24·0.48·x.
  check_proven(find(widened, "a1"), broken, 0.24 * 0.52 * 0.35);

  const auto spread =
      prove(shape, hand::program(shape, {hand::group_statement(Op::change_delta, "t1", "x1", Anchor::middle),
                                         statement(Op::scale_1d, "rail", Vec3::UnitX(), "x1/1.2")}));
  check_proven(find(spread, "t1"), held, 0);
  // The sides move with the outer instances: 0.2·x.
  check_proven(find(spread, "a1"), held, 0);

  for (const Anchor anchor : {Anchor::fit, Anchor::start, Anchor::middle, Anchor::end}) {
    const auto counted =
        prove(shape, hand::program(shape, {hand::group_statement(Op::change_count, "t1", "10*x1", anchor)}));
    check_proven(find(counted, "t1"), held, 0);
    // n' runs from 1 (clamped) to 6; the spacing is 0.2, so an end anchored on one side goes 3 steps too far.
    const double worst = anchor == Anchor::fit ? 0 : anchor == Anchor::middle ? 0.3 : 0.6;
    check_proven(find(counted, "a1"), worst == 0 ? held : broken, worst);
  }

  const Statement taper = [] {
    Statement s = statement(Op::scale_1d, "slats", Vec3::UnitY(), "x1");
    s.feature = {1, 0, 0};
    return s;
  }();
  const auto tapered = prove(shape, hand::program(shape, {taper}));
  // Heights grow along the row: the corners of the instances are no more copies of each other.
  CHECK(find(tapered, "t1").status == broken);
  CHECK(find(tapered, "t1").proof == Proof::certified);
}

TEST_CASE("editing one instance takes the group apart; its own attachments count then") {
  const Shape shape = hand::slats();
  const Program program = hand::program(shape, {statement(Op::translate, "slat_1", Vec3::UnitZ(), "x1")});
  CHECK(ids(prove(shape, program)) == std::vector<std::string>{"a2"});
  CHECK(ids(prove(shape, program, {"t1"})) == std::vector<std::string>{"t1", "a2"});
  // A disabled group dissolves even when nobody edits its instances, and is named.
  const Program rail = hand::program(shape, {statement(Op::translate, "rail", Vec3::UnitZ(), "x1")});
  CHECK(ids(prove(shape, rail)) == std::vector<std::string>{"a1", "a2", "a3"});
  CHECK(ids(prove(shape, rail, {"t1"})) == std::vector<std::string>{"t1", "a2", "a3"});
}

TEST_CASE("a ring stays one under radius, count and height, not under a stretch") {
  const Shape shape = hand::ring();
  const auto wider =
      prove(shape, hand::program(shape, {hand::group_statement(Op::change_delta, "o1", "x1", Anchor::fit),
                                         statement(Op::scale_2d, "plate", Vec3::UnitX(), "0.3*x1/0.34")}));
  check_proven(find(wider, "o1"), held, 0);
  check_proven(find(wider, "a1"), held, 0);
  const auto counted =
      prove(shape, hand::program(shape, {hand::group_statement(Op::change_count, "o1", "10*x1", Anchor::fit),
                                         statement(Op::scale_1d, "feet", Vec3::UnitY(), "x1")}));
  check_proven(find(counted, "o1"), held, 0);
  const auto stretched = prove(shape, hand::program(shape, {statement(Op::scale_1d, "feet", Vec3::UnitX(), "x1")}));
  CHECK(find(stretched, "o1").status == broken);
  CHECK(find(stretched, "o1").proof == Proof::certified);
}

TEST_CASE("the blades of a fan leave its motor, though their ring as a whole keeps all its joints") {
  const Shape shape = hand::fan();
  REQUIRE_MESSAGE(validate(shape).ok(), validate(shape).error().message());
  const auto wider =
      prove(shape, hand::program(shape, {hand::group_statement(Op::change_delta, "o1", "x1", Anchor::fit),
                                         statement(Op::scale_2d, "plate", Vec3::UnitX(), "0.3*x1/0.34")}));
  CHECK(ids(wider) == std::vector<std::string>{"o1", "a1", "a2", "a3", "a4", "a5", "a6"});
  for (const std::string id : {"o1", "a1", "a6"}) check_proven(find(wider, id), held, 0);
  // Every blade moves outwards by 0.3·x, the motor stays.
  for (const std::string id : {"a2", "a3", "a4", "a5"}) check_proven(find(wider, id), broken, 0.3 * 0.35);

  // What moves the ring and the motor alike keeps them.
  const auto raised = prove(shape, hand::program(shape, {statement(Op::translate, "feet", Vec3::UnitY(), "x1"),
                                                         statement(Op::translate, "motor", Vec3::UnitY(), "x1")}));
  for (const std::string id : {"a2", "a3", "a4", "a5"}) check_proven(find(raised, id), held, 0);
}

TEST_CASE("the joint of an instance is judged as long as the instance exists") {
  const Shape shape = hand::fan();
  // The number changes at x = 0.2 and at x = 0⁻; until then the blades leave the motor by 0.3·x.
  const Program program = hand::program(shape, {hand::group_statement(Op::change_delta, "o1", "x1", Anchor::fit),
                                                hand::group_statement(Op::change_count, "o1", "5*x1", Anchor::fit)});
  const std::vector<RelationReport> reports = prove(shape, program);
  const RelationReport& report = find(reports, "a2");
  CHECK(report.status == broken);
  CHECK(report.worst == doctest::Approx(0.3 * 0.2).epsilon(0.01));

  // An earlier layer has changed the number: there is nothing left to speak of.
  Program later = hand::program(shape, {hand::group_statement(Op::change_count, "o1", "10*x1", Anchor::fit)});
  later.layers[0].parameter.value = 0.25;
  later.layers.push_back(hand::program(shape, {statement(Op::translate, "feet", Vec3::UnitY(), "x2")}).layers[0]);
  later.layers[1].parameter.name = "x2";
  CHECK(ids(prove_relations(shape, later, 1, {})) == std::vector<std::string>{"o1", "a1", "a6"});
  later.layers[0].parameter.value = 0;
  CHECK(find(prove_relations(shape, later, 1, {}), "a2").status == broken);
}

TEST_CASE("mirror images of instances are judged where their rows do not say it already") {
  Shape shape = hand::slats();
  // Within the row: the row says it.
  const RelationIndex inside = hand::mirror(shape, "r1", *shape.find_part("slat_1"), *shape.find_part("slat_3"));
  const PartIndex left = hand::add_box(shape, "post_left", {-0.2, -0.5, 0}, {0.04, 0.1, 0.02});
  const PartIndex right = hand::add_box(shape, "post_right", {0.2, -0.5, 0}, {0.04, 0.1, 0.02});
  const RelationIndex posts = hand::mirror(shape, "r2", left, right);
  const RelationIndex across = hand::mirror(shape, "r3", *shape.find_part("slat_1"), right);
  CHECK_FALSE(is_judged(shape, inside, {}));
  CHECK(is_judged(shape, posts, {}));
  CHECK(is_judged(shape, across, {}));
  CHECK(is_judged(shape, inside, {*shape.find_relation("t1")}));
  hand::mirror(shape, "r4", *shape.find_part("slats"), right);
  CHECK_FALSE(is_judged(shape, across, {}));
}

TEST_CASE("one rule for broken: the wider tolerance needs two parts that move") {
  const Shape shape = hand::chair();
  const Relation& joint = shape.relations[*shape.find_relation("a1")];
  CHECK(slack_of(joint, 0, false, false) == Slack::tight);
  CHECK(slack_of(joint, 0.002, true, false) == Slack::tight);
  CHECK(slack_of(joint, 0.0072, true, false) == Slack::half);
  CHECK(slack_of(joint, 0.0144, true, false) == Slack::one);
  CHECK(slack_of(joint, 0.0145, true, false) == Slack::broken);
  CHECK(slack_of(joint, 0.0145, true, true) == Slack::two);
  CHECK(slack_of(joint, 0.0433, true, true) == Slack::two);
  CHECK(slack_of(joint, 0.0434, true, true) == Slack::broken);
  CHECK(slack_of(joint, std::nan(""), true, true) == Slack::broken);
  const Shape row = hand::slats();
  CHECK(slack_of(row.relations[*row.find_relation("t1")], 0.04, false, false) == Slack::two);
}

TEST_CASE("layers: earlier ones stand at their values, later ones are not looked at") {
  const Shape shape = hand::chair();
  Program program = hand::program(shape, {statement(Op::translate, "leg_left", Vec3::UnitX(), "x1")});
  program.layers.push_back(hand::program(shape, {statement(Op::translate, "leg_left", Vec3::UnitX(), "x2")}).layers[0]);
  program.layers[1].parameter.name = "x2";
  CHECK(find(prove_relations(shape, program, 0, {}), "a1").worst == doctest::Approx(0.35));
  CHECK(find(prove_relations(shape, program, 1, {}), "a1").worst == doctest::Approx(0.35));
  program.layers[0].parameter.value = 0.1;
  check_proven(find(prove_relations(shape, program, 1, {}), "a1"), broken, 0.45);
}

TEST_CASE("certified bounds hold for random programs on every shape") {
  Random random(7);
  int certified = 0;
  int reports = 0;
  for (const Shape& shape : {hand::chair(), hand::slats(), hand::ring(), hand::fan()}) {
    for (int i = 0; i < 25; ++i) {
      const Program program = hand::random_program(shape, random);
      const Evaluator evaluator(program, shape);
      std::vector<State> states;
      for (int k = 0; k <= 60; ++k) states.push_back(evaluator({-0.35 + 0.7 * k / 60}));
      for (const RelationReport& report : prove(shape, program)) {
        CAPTURE(report.id);
        const Constraint constraint = make_constraint(shape, *shape.find_relation(report.id));
        double worst = 0;
        for (const State& state : states) worst = std::max(worst, deviation(constraint, state));
        CHECK(worst <= report.worst * (1 + 1e-12) + (report.proof == Proof::certified ? 1e-13 : 1e-3));
        CHECK(report.worst <=
              worst * 1.02 + 1e-6 +
                  (report.status == held ? tolerance_of(*constraint.relation, scope_of(shape, program, 0, {})) : 0));
        certified += report.proof == Proof::certified;
        ++reports;
      }
    }
  }
  CHECK(reports > 100);
  MESSAGE("certified " << certified << " of " << reports);
  CHECK(certified > 0.8 * reports);
}
