#include <doctest/doctest.h>

#include "core/propagate/solve.h"

using namespace parsel;
using GiNaC::ex;
using GiNaC::realsymbol;

namespace {

const realsymbol x("x");
const realsymbol y("y");

double value(const ex& expression, double at) {
  return GiNaC::ex_to<GiNaC::numeric>(expression.subs(x == GiNaC::numeric(at)).evalf()).to_double();
}

/// Every root, put into the equation, must leave nothing.
void check_roots(const ex& equation, std::size_t count) {
  const Solutions solutions = solve_for(equation, y);
  CHECK(solutions.roots.size() == count);
  CHECK(solutions.unsolved.empty());
  for (const ex& root : solutions.roots) {
    for (const double at : {-0.3, -0.1, 0.05, 0.2, 0.35}) {
      CHECK(value(equation.subs(y == root), at) == doctest::Approx(0).epsilon(1e-9));
    }
  }
}

}  // namespace

TEST_CASE("a linear equation has its one exact root") {
  const Solutions solutions = solve_for(4 * y - 2 * x, y);
  REQUIRE(solutions.roots.size() == 1);
  CHECK((solutions.roots[0] - x / 2).is_zero());
  check_roots(3 * y * (1 + x) - x * x + 1, 1);
}

TEST_CASE("a quadratic equation has both roots, a square one") {
  check_roots(y * y + 3 * y - x, 2);
  const Solutions square = solve_for(y * y - 2 * x * y + x * x, y);
  REQUIRE(square.roots.size() == 1);
  CHECK((square.roots[0] - x).is_zero());
}

TEST_CASE("a cosine and a sine of the unknown give both angles") {
  check_roots(cos(y) - (ex(1) / 2 + x), 2);
  check_roots(sin(y) - x, 2);
  check_roots(3 * cos(y) + 4 * sin(y) - 2 - x, 2);
  check_roots(-2 * cos(y) + sin(y) - x / 3, 2);
  check_roots(cos(y) * (1 + x) - sin(y), 2);
}

TEST_CASE("the angle of a rotation by x is x itself near zero") {
  // The point (1, 0) turned by y must be where the turn by x brings it.
  const Solutions solutions = solve_for(sin(y) - sin(x), y);
  bool found = false;
  for (const ex& root : solutions.roots) found = found || std::abs(value(root, 0.2) - 0.2) < 1e-9;
  CHECK(found);
}

TEST_CASE("what has no closed form says why") {
  CHECK(solve_for(x - 1, y).unsolved == "the equation does not depend on the amount");
  CHECK(solve_for(pow(y, 3) - x, y).unsolved == "the amount occurs with a power above two");
  CHECK(solve_for(y + sin(y) - x, y).roots.empty());
  CHECK(solve_for(sin(y) * cos(y) - x, y).unsolved == "the amount's sine and cosine occur multiplied");
  CHECK(solve_for(GiNaC::abs(y) - x, y).roots.empty());
}
