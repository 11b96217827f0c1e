#include <doctest/doctest.h>

#include <chrono>
#include <cmath>

#include "core/amount/amount_range.h"
#include "core/base/random.h"
#include "core/edit/program.h"
#include "tests/core/golden.h"

using namespace parsel;

namespace {

Shape golden_shape(const std::string& name) {
  Result<Shape> shape = shape_from_json(golden("program_vectors.json")["shapes"][name]);
  REQUIRE_MESSAGE(shape.ok(), shape.error().message());
  return *shape;
}

Program program_of(const std::string& layers) {
  Result<Program> program = program_from_text("parsel program 1\nshape \"\" \"\"\n" + layers);
  REQUIRE_MESSAGE(program.ok(), program.error().message());
  return *program;
}

/// The place of the fault in a program of one layer over [-0.5, 1], empty when there is none.
std::string fault(const Shape& shape, const std::string& lines) {
  const Status status = validate(program_of("layer \"\": x1 = 0 in [-0.5, 1]\n" + lines + "\n"), shape);
  return status.ok() ? "" : status.error().place;
}

std::string amount_fault(const std::string& amount) {
  static const Shape shape = golden_shape("pair");
  const Status status = validate(
      program_of("layer \"\": x1 = 0 in [-0.5, 1]\nlayer \"\": x2 = 0 in [-2, 2]\ntranslate(\"leg\", amount=" + amount +
                 ", direction=(1, 0, 0))\n"),
      shape);
  if (status.ok()) return "";
  CHECK(status.error().place == "/layers/1/statements/0/amount");
  return status.error().cause;
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("parts, relations and references must be known") {
  const Shape shape = golden_shape("slats");
  const std::string s = "/layers/0/statements/0";
  CHECK(fault(shape, "translate(\"rail_top\", amount=x1, direction=(1, 0, 0))").empty());
  CHECK(fault(shape, "translate(\"node:0\", amount=x1, direction=(1, 0, 0))").empty());
  CHECK(fault(shape, "translate(\"seat\", amount=x1, direction=(1, 0, 0))") == s + "/part");
  CHECK(fault(shape, "translate(\"node:99\", amount=x1, direction=(1, 0, 0))") == s + "/part");
  CHECK(fault(shape, "translate(\"rail_top\", amount=x1, direction=axis(\"seat\", 0))") == s + "/direction/part");
  CHECK(fault(shape, "rotate(\"rail_top\", amount=x1, origin=(0, 0, 0), axis=axis(\"seat\", 0))") == s + "/axis/part");
  CHECK(fault(shape, "scale_3d(\"rail_top\", amount=x1, origin=point(\"seat\", 0, 0, 0))") == s + "/origin/part");
  CHECK(fault(shape, "scale_2d(\"rail_top\", amount=x1, origin=(0, 0, 0), normal=axis(\"seat\", 1))") ==
        s + "/normal/part");
  CHECK(fault(shape, "change_count(\"t1\", amount=x1)").empty());
  CHECK(fault(shape, "change_count(\"t2\", amount=x1)") == s + "/relation");
  CHECK(fault(shape, "change_count(\"a1\", amount=x1)") == s + "/relation");  // an attachment is no group
  CHECK(fault(shape, "keep_fixed(\"rail_top\") because seed \"r7\"") == s + "/why/relations/0");
  CHECK(fault(shape, "relation \"r7\": held, worst 0, sampled") == "/layers/0/relations/0/id");
}

TEST_CASE("instances are not edited after the count of their group may have changed") {
  const Shape shape = golden_shape("slats");
  const std::string count = "change_count(\"t1\", amount=x1)\n";
  const std::string member = "translate(\"slat_2\", amount=x1, direction=(1, 0, 0))\n";
  CHECK(fault(shape, member + count).empty());
  CHECK(fault(shape, count + member) == "/layers/0/statements/1/part");
  CHECK(fault(shape, count + "layer \"\": x2 = 0 in [0, 1]\n" + member) == "/layers/1/statements/0/part");
  CHECK(fault(shape, count + "keep_fixed(\"slat_2\")").empty());
  CHECK(fault(shape, count + "translate(\"slats\", amount=x1, direction=(1, 0, 0))").empty());
  CHECK(fault(shape, count + "translate(\"rail_top\", amount=x1, direction=axis(\"slat_2\", 0))").empty());
  CHECK(fault(shape, "change_delta(\"t1\", amount=x1)\n" + member).empty());
}

TEST_CASE("parameters: names once, 0 and the value in the range") {
  const Shape shape = golden_shape("pair");
  const auto place = [&](const std::string& lines) {
    const Status status = validate(program_of(lines), shape);
    return status.ok() ? "" : status.error().place;
  };
  CHECK(place("layer \"\": x1 = 0 in [0, 0]\nlayer \"\": x2 = -1 in [-1, 0]\n").empty());
  CHECK(place("layer \"\": x1 = 0 in [0, 1]\nlayer \"\": x1 = 0 in [0, 1]\n") == "/layers/1/parameter/name");
  CHECK(place("layer \"\": x1 = 0.5 in [0.1, 1]\n") == "/layers/0/parameter");
  CHECK(place("layer \"\": x1 = -0.5 in [-1, -0.1]\n") == "/layers/0/parameter");
  CHECK(place("layer \"\": x1 = 0 in [1, -1]\n") == "/layers/0/parameter");
  CHECK(place("layer \"\": x1 = 2 in [-1, 1]\n") == "/layers/0/parameter/value");
}

TEST_CASE("a program made in code is held to the operators' fields") {
  const Shape shape = golden_shape("pair");
  const auto place = [&](auto change) {
    Program program = program_of(
        "layer \"\": x1 = 0 in [0, 1]\nscale_1d(\"seat\", amount=x1, origin=(0, 0, 0), direction=(1, 0, 0))\n");
    change(program.layers[0].statements[0]);
    const Status status = validate(program, shape);
    return status.ok() ? "" : status.error().place;
  };
  const std::string s = "/layers/0/statements/0";
  CHECK(place([](Statement&) {}).empty());
  CHECK(place([](Statement& x) { x.origin.reset(); }) == s);
  CHECK(place([](Statement& x) { x.normal = Vec3(1, 0, 0); }) == s + "/normal");
  CHECK(place([](Statement& x) { x.relation = "a1"; }) == s + "/relation");
  CHECK(place([](Statement& x) { x.feature = {2, 0, 0}; }) == s + "/feature");
  CHECK(place([](Statement& x) { x.direction = Vec3(0, 0, 0); }) == s + "/direction");
  CHECK(place([](Statement& x) { x.direction = Vec3(NAN, 0, 0); }) == s + "/direction");
  CHECK(place([](Statement& x) { x.origin = Vec3(INFINITY, 0, 0); }) == s + "/origin");
  CHECK(place([](Statement& x) { x.direction = PartAxis{"seat", 3}; }) == s + "/direction/axis");
  CHECK(place([](Statement& x) {
          x = Statement{};
          x.part = "seat";
          x.amount = Amount::constant(1);
        }) == s + "/amount");
}

TEST_CASE("amounts are defined and bounded over the whole range") {
  for (const std::string good :
       {"x1", "x1^2", "sqrt(x1 + 0.5)", "sqrt((x1 - 0.3)^2)", "sqrt(x1^2 - 2*x1 + 1)", "1/(x1 + 0.6)", "tan(x1)",
        "x2/(1 + x1^2)", "floor(6.1*sqrt(abs(0.1*x1 - 0.4)))", "(x1 + 1)^x2", "atan2(x1, x2)", "x1*abs(x1)",
        "1/max(x1, 0.01)", "2*atan2(x1, 1 + sqrt(1 - x1^2))", "sin(x1)/(2 + cos(3*x2))", "1e-9/((x1 - 1/3)^2 + 1e-12)",
        "1/(x1*x1 + 1e-6)"}) {
    CAPTURE(good);
    CHECK(amount_fault(good) == "");
  }
  CHECK(has(amount_fault("x3"), "no layer has the parameter 'x3'"));
  CHECK(has(amount_fault("sqrt(x1)"), "square root of a negative number at x1 = "));
  CHECK(has(amount_fault("sqrt(0.99 - x1)"), "square root of a negative number at x1 = "));
  CHECK(has(amount_fault("sqrt((x1 - 0.3)^2 - 0.0001)"), "square root"));
  CHECK(has(amount_fault("1/x1"), "at x1 = "));
  CHECK(has(amount_fault("1/(x1 - 0.3)"), "grows without bound at x1 = "));
  CHECK(has(amount_fault("1/(x1 - 0.3)^2"), "grows without bound at x1 = "));
  CHECK(has(amount_fault("1/(x1 - x2)"), "at x1 = "));
  CHECK(has(amount_fault("tan(2*x1)"), "grows without bound"));
  CHECK(has(amount_fault("tan(x2)"), "grows without bound"));
  CHECK(has(amount_fault("x1^1.5"), "a power that has no value"));
  CHECK(has(amount_fault("x1^-2"), "at x1 = "));
  CHECK(has(amount_fault("x1^x2"), "a power that has no value"));
  CHECK(has(amount_fault("10000000*x1"), "grows without bound"));
  CHECK(has(amount_fault("10^(10*x2)"), "grows without bound"));
  CHECK(has(amount_fault("1/floor(x1 + 1)"), "division by zero"));
  // However little of a pole a slider sees; and as it is written, since the page does not simplify.
  CHECK(has(amount_fault("1e-9/(x1 - 1/3)"), "division by zero at x1 = 0.33"));
  CHECK(has(amount_fault("1e-12*tan(pi*x1/1.3)"), "no finite value"));
  CHECK(has(amount_fault("x1/x1"), "division by zero"));
  CHECK(has(amount_fault("x2^3 - x1^-2*0"), "division by zero"));
  CHECK(has(amount_fault("min(x1, 5)^0.5*0"), "a power that has no value"));
  CHECK(has(amount_fault("x3 - x3"), "no layer has the parameter 'x3'"));
  CHECK(has(amount_fault("1e-9*sin(1e7*x1)"), "no finite value"));
}

TEST_CASE("enclosures hold what the amount takes") {
  const std::vector<std::string> texts = {"x1*x2 - x1/2",
                                          "sin(3*x1)*cos(x2)",
                                          "abs(x1) + floor(2*x2)",
                                          "atan2(x1, x2)",
                                          "atan2(x2, x1 + 2)",
                                          "min(x1, x2) - max(x1, 0)",
                                          "x1^2 + x1^3 - x2^4",
                                          "sqrt(x1 + 3)/(x2 + 4)",
                                          "(x1 + 3)^x2",
                                          "tan(x1/2)",
                                          "(x1 + 3)^-2",
                                          "(x1 + 3)^1.5",
                                          "-x1",
                                          "x1^-3*0 + x2"};
  Random random(6);
  for (const std::string& text : texts) {
    CAPTURE(text);
    const CompiledAmount code = parse_amount(text)->compile({"x1", "x2"});
    for (int round = 0; round < 60; ++round) {
      std::vector<Interval> box;
      for (int i = 0; i < 2; ++i) {
        const double a = random.uniform(-2, 2);
        box.push_back({a, a + random.unit()});
      }
      const auto range = enclose(code, box);
      if (!range) continue;
      for (int i = 0; i < 20; ++i) {
        const std::array<double, 2> x = {random.uniform(box[0].low, box[0].high),
                                         random.uniform(box[1].low, box[1].high)};
        const double value = code(x.data());
        CHECK(value >= range->low - 1e-12);
        CHECK(value <= range->high + 1e-12);
      }
    }
  }
}

TEST_CASE("a hostile program is judged within its budget") {
  // Each amount is defined everywhere, yet intervals cannot see it: bisection would go on for ever.
  std::string text = "layer \"\": x1 = 0 in [-1, 1]\nlayer \"\": x2 = 0 in [-1, 1]\nlayer \"\": x3 = 0 in [-1, 1]\n";
  for (int i = 0; i < 400; ++i) {
    text +=
        "translate(\"leg\", amount=1/(1 + abs(x1 - x2) - abs(x2 - x1) + abs(x3)*(x1 - x1^3/x1^2)), direction=(1, 0, "
        "0))\n";
  }
  const auto start = std::chrono::steady_clock::now();
  const Status status = validate(program_of(text), golden_shape("pair"));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  CHECK(took.count() < 20);  // under sanitizers, on a slow machine
  static_cast<void>(status);
}
