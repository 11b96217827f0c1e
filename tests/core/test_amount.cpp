#include "core/amount/amount.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "core/base/random.h"
#include "tests/core/golden.h"

using namespace parsel;

namespace {

Amount parsed(const std::string& text) {
  const Result<Amount> result = parse_amount(text);
  REQUIRE_MESSAGE(result.ok(), text << ": " << (result.ok() ? "" : result.error().message()));
  return *result;
}

/// The amount at values in the order of its sorted parameters.
double value(const Amount& amount, const std::vector<double>& values) {
  return amount.compile(amount.parameters())(values.data());
}

/// A random expression as text, with its value computed beside it by the C library.
struct Sample {
  std::string text;
  double value;
};

/// No pi: sin(pi) is exact for GiNaC and 1e-16 for the C library.
Sample random_expression(Random& random, const std::vector<double>& x, int depth) {
  if (depth == 0 || random.below(6) == 0) {
    switch (random.below(4)) {
      case 0: {
        const auto i = random.below(x.size());
        return {"x" + std::to_string(i + 1), x[i]};
      }
      case 1: {
        const auto n = random.below(9) + 1;
        return {std::to_string(n), static_cast<double>(n)};
      }
      case 2: {
        const auto n = random.below(1000);
        return {std::to_string(n) + "e-2", static_cast<double>(n) / 100};
      }
      default: {
        const double v = random.uniform(-3, 3);
        char text[40];
        std::snprintf(text, sizeof text, "(%.17g)", v);
        return {text, v};
      }
    }
  }
  const Sample a = random_expression(random, x, depth - 1);
  const Sample b = random_expression(random, x, depth - 1);
  switch (random.below(14)) {
    case 0:
      return {"(" + a.text + " + " + b.text + ")", a.value + b.value};
    case 1:
      return {"(" + a.text + "-" + b.text + ")", a.value - b.value};
    case 2:
      return {a.text + "*" + b.text, a.value * b.value};
    case 3:
      return {"(" + a.text + "/(" + b.text + "))", b.value == 0 ? NAN : a.value / b.value};
    case 4:
      return {"(-" + a.text + ")", -a.value};
    case 5:
      return {"sqrt(" + a.text + ")", std::sqrt(a.value)};
    case 6:
      return {"abs(" + a.text + ")", std::abs(a.value)};
    case 7:
      return {"sin(" + a.text + ")", std::sin(a.value)};
    case 8:
      return {"cos(" + a.text + ")", std::cos(a.value)};
    case 9:
      return {"atan2(" + a.text + "," + b.text + ")", std::atan2(a.value, b.value)};
    case 10:
      return {"min(" + a.text + "," + b.text + ")", std::isnan(a.value) || a.value < b.value ? a.value : b.value};
    case 11:
      return {"max(" + a.text + "," + b.text + ")", std::isnan(a.value) || a.value > b.value ? a.value : b.value};
    case 12:
      return {"(" + a.text + ")^2", a.value * a.value};
    default:
      return {"abs(" + a.text + ")^0.5", std::sqrt(std::abs(a.value))};
  }
}

bool near(double a, double b, double tolerance) {
  return std::abs(a - b) <= tolerance * std::max({1.0, std::abs(a), std::abs(b)});
}

}  // namespace

TEST_CASE("expression vectors: values") {
  const auto& vectors = golden("expression_vectors.json");
  CHECK(vectors["cases"].size() >= 120);
  for (const auto& vector : vectors["cases"]) {
    const std::string text = vector["text"];
    CAPTURE(text.substr(0, 100));
    std::vector<std::string> names;
    std::vector<double> values;
    for (const auto& [name, number] : vector["values"].items()) {
      names.push_back(name);
      values.push_back(number);
    }
    const Result<Amount> amount = parse_amount(text);
    if (vector["value"].is_null()) {
      if (amount.ok()) CHECK(std::isnan(amount->compile(names)(values.data())));
      continue;
    }
    REQUIRE_MESSAGE(amount.ok(), amount.error().message());
    CHECK(near(amount->compile(names)(values.data()), vector["value"], 1e-12));
  }
}

TEST_CASE("expression vectors: refusals name the column") {
  const auto& vectors = golden("expression_vectors.json");
  CHECK(vectors["errors"].size() >= 40);
  for (const auto& vector : vectors["errors"]) {
    const std::string text = vector["text"];
    CAPTURE(text.substr(0, 100));
    const Result<Amount> amount = parse_amount(text);
    REQUIRE_FALSE(amount.ok());
    CHECK(amount.error().place == "column " + std::to_string(vector["column"].get<int>()));
    CHECK(amount.error().stage == "edit/amount");
    CHECK_FALSE(amount.error().fix.empty());
  }
}

TEST_CASE("printed amounts are short and exact") {
  const auto print = [](const std::string& text) { return parsed(text).text(); };
  CHECK(print("x1/2") == "0.5*x1");
  CHECK(print("1*x1/3") == "x1/3");
  CHECK(print("-2*x1/3") == "-2*x1/3");
  CHECK(print("0.98*x1") == "0.98*x1");
  CHECK(print("0.1+0.2") == "0.3");
  CHECK(print("b-a") == "-a + b");
  CHECK(print("1 + x1") == "x1 + 1");
  CHECK(print("x1^-1") == "1/x1");
  CHECK(print("x1^(-1/2)*y") == "y/sqrt(x1)");
  CHECK(print("x1^-2/3") == "1/3/x1^2");
  CHECK(print("x1*sqrt(3)/2") == "0.5*sqrt(3)*x1");
  CHECK(print("-x1^2") == "-x1^2");
  CHECK(print("(-x1)^3") == "-x1^3");
  CHECK(print("2^(x1^y)") == "2^(x1^y)");
  CHECK(print("(2^x1)^y") == "2^(x1*y)");
  CHECK(print("(y^x1)^2") == "(y^x1)^2");
  CHECK(print("1/y^x1") == "1/y^x1");
  CHECK(print("atan2(x1,1)") == "atan2(x1, 1)");
  CHECK(print("min(y,x1)+max(x1,2)") == "max(2, x1) + min(x1, y)");
  CHECK(print("floor(6.1*sqrt(abs(0.1*x1-0.4)))") == "floor(6.1*sqrt(abs(0.1*x1 - 0.4)))");
  CHECK(print("1e-9") == "0.000000001");
  CHECK(print("1e-30*x1") == "1e-30*x1");
  CHECK(print("1/7") == "1/7");
  CHECK(print("0.30000000000000004*x1") == "0.30000000000000004*x1");
}

TEST_CASE("the order of a printed sum does not depend on when its parameters were first named") {
  const std::string first = parsed("zeta_q + alpha_q + mid_q*zeta_q").text();
  CHECK(first == "alpha_q + mid_q*zeta_q + zeta_q");
  CHECK(parsed("mid_q*zeta_q + alpha_q + zeta_q").text() == first);
}

TEST_CASE("random expressions: text reads back equal, code agrees with the C library and with GiNaC") {
  Random random(4);
  int defined = 0;
  for (int round = 0; round < 600; ++round) {
    const std::vector<double> x = {random.uniform(-2, 2), random.uniform(0, 3)};
    const Sample sample = random_expression(random, x, 4);
    CAPTURE(sample.text);
    const Result<Amount> amount = parse_amount(sample.text);
    if (!amount.ok()) {  // what the parser can compute, like 1/(2-2), it refuses
      CHECK_FALSE(std::isfinite(sample.value));
      continue;
    }
    const std::string text = amount->text();
    CAPTURE(text);
    CHECK(parsed(text).expression().is_equal(amount->expression()));
    CHECK(parsed(text).text() == text);
    const double compiled = amount->compile({"x1", "x2"})(x.data());
    if (!std::isfinite(sample.value) || std::abs(sample.value) > 1e6) continue;
    ++defined;
    CHECK(near(compiled, sample.value, 1e-8));
    GiNaC::exmap at;
    at[parameter_symbol("x1")] = x[0];
    at[parameter_symbol("x2")] = x[1];
    const GiNaC::ex numeric = amount->expression().subs(at).evalf();
    if (GiNaC::is_a<GiNaC::numeric>(numeric) && GiNaC::ex_to<GiNaC::numeric>(numeric).is_real()) {
      CHECK(near(compiled, GiNaC::ex_to<GiNaC::numeric>(numeric).to_double(), 1e-7));
    }
  }
  CHECK(defined > 300);
}

TEST_CASE("compiled code agrees with GiNaC to 1e-12 where nothing cancels") {
  const std::vector<std::string> texts = {"x1/3 + x2*sqrt(2)",
                                          "atan2(x1 + 2, x2)",
                                          "sin(x1)*cos(x2) + tan(x1/4)",
                                          "(x1 + 2)^1.5*x2^-2",
                                          "floor(10*x1) + min(x1, x2)*max(x1, 0.1, x2)",
                                          "2*atan2(x1, 1 + sqrt(4 - x1^2))",
                                          "abs(x1 - x2)^3/(1 + x1^2)",
                                          "pi*x1/180 + x2^x1"};
  Random random(7);
  for (const std::string& text : texts) {
    CAPTURE(text);
    const Amount amount = parsed(text);
    const CompiledAmount code = amount.compile({"x1", "x2"});
    for (int i = 0; i < 10; ++i) {
      const std::array<double, 2> x = {random.uniform(-1.5, 1.5), random.uniform(0.5, 2)};
      GiNaC::exmap at;
      at[parameter_symbol("x1")] = x[0];
      at[parameter_symbol("x2")] = x[1];
      const GiNaC::ex exact = amount.expression().subs(at).evalf();
      REQUIRE(GiNaC::is_a<GiNaC::numeric>(exact));
      CHECK(near(code(x.data()), GiNaC::ex_to<GiNaC::numeric>(exact).to_double(), 1e-12));
    }
  }
}

TEST_CASE("constants are exact when they are short") {
  CHECK(Amount::constant(0.1).text() == "0.1");
  CHECK(Amount::constant(1.0 / 3).text() == "1/3");
  CHECK(Amount::constant(-2.0 / 7).text() == "-2/7");
  CHECK(Amount::constant(0).is_zero());
  CHECK(Amount::constant(1e-30).text() == "1e-30");
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double v = random.uniform(-1, 1) * std::pow(10, random.uniform(-12, 12));
    CHECK(value(Amount::constant(v), {}) == v);
    CHECK(parsed(Amount::constant(v).text()).expression().is_equal(Amount::constant(v).expression()));
  }
}

TEST_CASE("derivatives stay in the grammar and agree with differences") {
  Random random(3);
  const std::vector<std::string> texts = {"x1^3 - x1/x2",
                                          "sqrt(x1*x2 + 4)",
                                          "abs(x1 - x2)",
                                          "min(x1, x2)*x2",
                                          "max(x1^2, x2)",
                                          "atan2(x1, x2)",
                                          "tan(x1/3)",
                                          "sin(x1)*cos(x2)",
                                          "atan2(x1, 1)",
                                          "abs(sin(x1))",
                                          "floor(x1) + x1",
                                          "x1^1.5",
                                          "min(abs(x1), sqrt(x2), 3)"};
  for (const std::string& text : texts) {
    CAPTURE(text);
    const Amount amount = parsed(text);
    const auto derivative = amount.derivative("x1");
    REQUIRE(derivative);
    CHECK(parsed(derivative->text()).expression().is_equal(derivative->expression()));
    const auto f = amount.compile({"x1", "x2"});
    const auto g = derivative->compile({"x1", "x2"});
    for (int i = 0; i < 8; ++i) {
      const std::array<double, 2> x = {random.uniform(0.55, 0.9), random.uniform(1.1, 2)};
      const double h = 1e-6;
      const std::array<double, 2> before = {x[0] - h, x[1]};
      const std::array<double, 2> after = {x[0] + h, x[1]};
      CHECK(g(x.data()) == doctest::Approx((f(after.data()) - f(before.data())) / (2 * h)).epsilon(1e-6));
    }
  }
  CHECK_FALSE(parsed("2^x1").derivative("x1"));
  CHECK(parsed("2^x1").derivative("x2")->is_zero());
}

TEST_CASE("simplified amounts lose their noise and keep their value") {
  const auto simplify = [](const std::string& text, double tolerance, bool is_angle = false) {
    return parsed(text).simplified(tolerance, is_angle).text();
  };
  CHECK(simplify("0.4999871*x1 + 0.00000012", 1e-3) == "0.5*x1");
  CHECK(simplify("0.66666668*x1", 1e-6) == "2*x1/3");
  CHECK(simplify("-1.0000001*x1 + 1.5707963*x2", 1e-6, true) == "0.5*pi*x2 - x1");
  CHECK(simplify("0.39269908*x1", 1e-6, true) == "0.125*pi*x1");
  CHECK(simplify("0.39269908*x1", 1e-6).find("pi") == std::string::npos);  // a height
  CHECK(simplify("1.7320508*x1", 1e-6) == "sqrt(3)*x1");
  CHECK(simplify("0.98*x1", 1e-6) == "0.98*x1");
  CHECK(simplify("0.31234567*x1", 1e-3) == "0.3123*x1");
  CHECK(simplify("pi/180*x1", 1e-3) == "pi*x1/180");
  CHECK(simplify("floor(6.0999999999*sqrt(abs(0.1000000001*x1 - 0.4)))", 1e-6) == "floor(6.1*sqrt(abs(0.1*x1 - 0.4)))");
  CHECK(simplify("1/(0.0000001 + 0.0000002*x1)", 1e-6) == parsed("1/(0.0000001 + 0.0000002*x1)").text());
  CHECK(simplify("x1^2 + 0.1*x1^3", 1e-6) == parsed("x1^2 + 0.1*x1^3").text());
  Random random(11);
  for (int i = 0; i < 300; ++i) {
    const double tolerance = std::pow(10, random.uniform(-9, -2));
    const double c = random.uniform(-2, 2);
    const Amount amount = Amount(Amount::constant(c).expression() * parameter_symbol("x1"));
    const std::array<double, 1> one = {1};
    CHECK(std::abs(amount.simplified(tolerance, i % 2 == 0).compile({"x1"})(one.data()) - c) <= tolerance);
  }
}

TEST_CASE("hostile amounts are refused quickly") {
  for (const std::string text :
       {"9^9^9^9", "(3*x1)^1000000000", "((2^64)^64)^64", "2^(1e15/3)", "1e308*1e308", "tan(pi/2)", "0^0", "1/(x1-x1)",
        "(2^60000)*(2^60000)*x1", "(-8)^(1/3)", "sqrt(-2)", "(x1+x1)^1e9"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_amount(text).ok());
  }
  std::string towers;
  for (int i = 0; i < 800; ++i) towers += "9^99+";
  CHECK(parse_amount(towers + "x1").ok() == false);
  CHECK(parse_amount(std::string("x1\0+1", 5)).error().place == "column 3");
  CHECK(parse_amount("x1+\xff\xfe").error().place == "column 4");
}

TEST_CASE("code that needs a deep stack runs") {
  using Op = CompiledAmount::Op;
  std::vector<CompiledAmount::Instruction> code;
  for (int i = 0; i < 1000; ++i) code.push_back({Op::parameter, 0, 0});
  for (int i = 0; i < 999; ++i) code.push_back({Op::add, 0, 0});
  const CompiledAmount deep(code);
  CHECK(deep.depth() == 1000);
  const std::array<double, 1> x = {0.5};
  CHECK(deep(x.data()) == 500);
}

TEST_CASE("undefined_operation names what fails first") {
  const std::array<double, 1> x = {-1};
  const auto first = [&](const std::string& text) {
    return parsed(text).compile({"x1"}).undefined_operation(x.data());
  };
  CHECK(first("sqrt(x1) + 1/(x1+1)").has_value());
  CHECK(first("1 + sqrt(x1)") == CompiledAmount::Op::sqrt);
  CHECK(first("1/(x1+1)") == CompiledAmount::Op::divide);
  CHECK(first("x1^1.5") == CompiledAmount::Op::power);
  CHECK_FALSE(first("x1^2").has_value());
}
