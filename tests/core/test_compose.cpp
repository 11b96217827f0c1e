#include "core/propagate/compose.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/check/check.h"
#include "core/prove/prove.h"
#include "core/prove/stack.h"
#include "hand_shapes.h"
#include "pairs_measure.h"

using namespace parsel;
using hand::statement;

namespace {

Statement derived(Statement statement) {
  statement.why = Why{WhyKind::attachment, {}};
  return statement;
}

/// Widens the seat about its middle, the legs at ±0.3 with it, as propagation would.
std::vector<Statement> widening(const std::string& x) {
  Statement seed = statement(Op::scale_1d, "seat", Vec3::UnitX(), x);
  seed.why = Why{WhyKind::seed, {}};
  return {seed, derived(statement(Op::translate, "leg_left", Vec3::UnitX(), "0.3*" + x)),
          derived(statement(Op::translate, "leg_right", Vec3::UnitX(), "-0.3*" + x))};
}

Program stack(const Shape& shape, std::vector<Statement> first, std::vector<Statement> second) {
  Program program = hand::program(shape, std::move(first), -0.5, 0.5);
  Layer layer = hand::program(shape, std::move(second), -0.5, 0.5).layers[0];
  layer.parameter.name = "x2";
  program.layers.push_back(std::move(layer));
  for (std::size_t l = 0; l < program.layers.size(); ++l) {
    if (!is_derived(program.layers[l].statements.back())) continue;
    Program by_itself = program;
    std::swap(by_itself.layers[0], by_itself.layers[l]);
    by_itself.layers.resize(1);
    program.layers[l].relations = prove_relations(shape, by_itself, 0, {});
  }
  return program;
}

}  // namespace

TEST_CASE("a layer follows what the layers before it leave, and is what it was alone where they are at 0") {
  const Shape shape = hand::chair();
  const Program before = stack(shape, widening("x1"), widening("x2"));
  const Program after = compose(shape, before);
  // Twice as wide by both: the legs are off by 0.3·x1·x2 side by side.
  const StackVerdict apart = judge_stack(shape, before), together = judge_stack(shape, after);
  CHECK(apart.lost.size() == 2);
  CHECK(together.lost.empty());
  CHECK(together.of == apart.of);
  CHECK(together.failed == 0);
  CHECK(Evaluator(after, shape)({0.5, 0.5}).parts[*shape.find_part("leg_left")].colwise().mean()[0] ==
        doctest::Approx(0.3 * 1.5 * 1.5));
  for (std::size_t i = 0; i < before.layers[1].statements.size(); ++i) {
    CHECK(alone(after.layers[1]).statements[i].amount.text() == before.layers[1].statements[i].amount.text());
    CHECK(after.layers[0].statements[i].amount.text() == before.layers[0].statements[i].amount.text());
  }
  CHECK(to_json(compose(shape, after)) == to_json(after));
  CHECK(to_json(stack_programs(shape, {hand::program(shape, widening("x1"), -0.5, 0.5), after}).value())["layers"]
            .size() == 3);
}

TEST_CASE("what a person wrote is not solved again") {
  const Shape shape = hand::chair();
  std::vector<Statement> written = widening("x2");
  for (Statement& s : written) s.why.reset();
  written[1].amount = *parse_amount("0.3*x2*(1+0.5*x1)");
  const Program before = stack(shape, widening("x1"), written);
  CHECK(to_json(compose(shape, before)) == to_json(before));
}

TEST_CASE("a slider stops where the stack breaks with the others where they are") {
  const Shape shape = hand::chair();
  Program program = stack(shape, widening("x1"), widening("x2"));
  program.layers[0].parameter.value = 0.4;
  const StackVerdict verdict = judge_stack(shape, program);
  // The legs may be off by delta_both_edited: 0.3·0.4·x2.
  CHECK(verdict.stops[1].max == doctest::Approx(delta_both_edited / 0.12).epsilon(0.01));
  CHECK(verdict.stops[1].max_reason.starts_with("no longer true: "));
  CHECK(verdict.stops[1].min == doctest::Approx(-delta_both_edited / 0.12).epsilon(0.01));
  CHECK(verdict.stops[0].max == 0.5);
  CHECK(verdict.stops[0].max_reason.empty());
  CHECK(to_json(verdict)["stops"].size() == 2);
}

TEST_CASE("pairs of gallery edits keep together what each keeps alone") {
  test::Kept plain, composed;
  for (const char* id : {"chair", "bookcase"}) {
    const test::GalleryLayers layers = test::gallery_layers(*find_gallery_model(id));
    for (std::size_t a = 0; a < layers.edits.size(); ++a) {
      for (std::size_t b = 0; b < layers.edits.size(); ++b) {
        CAPTURE(id);
        CAPTURE(layers.ids[a]);
        CAPTURE(layers.ids[b]);
        const Program before = test::side_by_side(layers.edits[a], layers.edits[b]);
        Program after = compose(layers.shape, before);
        plain += test::kept_together(layers.shape, before);
        composed += test::kept_together(layers.shape, after);
        prove_anew(layers.shape, after);
        for (const Finding& finding : check_program(layers.shape, after).findings)
          FAIL_CHECK(finding.place << ": " << finding.text);
      }
    }
  }
  CHECK(composed.together >= 0.98 * composed.of);
  CHECK(composed.together > plain.together);
  CHECK(composed.inverted <= plain.inverted);
}
