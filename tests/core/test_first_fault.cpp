#include "core/prove/first_fault.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace parsel;

namespace {

FaultAt beyond(double limit) {
  return [limit](double x) { return x > limit ? "beyond " + std::to_string(limit) : std::string(); };
}

}  // namespace

TEST_CASE("the first fault is found to the width that halvings leave") {
  const RangeEnd end = first_fault(0, 2, 10, 8, beyond(0.73));
  CHECK(end.x <= 0.73);
  CHECK(end.x > 0.73 - 0.2 / 256);
  CHECK(end.reason == "beyond " + std::to_string(0.73));
}

TEST_CASE("towards negative values as well") {
  const RangeEnd end = first_fault(-0.1, -2, 19, 8, [](double x) { return x < -1.01 ? "low" : ""; });
  CHECK(end.x >= -1.01);
  CHECK(end.x < -1.01 + 0.1 / 256);
}

TEST_CASE("where no step is bad the end is the one that was asked for, to the bit") {
  for (const double to : {0.1, 1.0 / 3, 7.7, -0.3}) {
    const RangeEnd end = first_fault(0.05, to, 96, 8, beyond(8));
    CHECK(end.x == to);
    CHECK(end.reason.empty());
  }
  const RangeEnd nowhere = first_fault(1, 1, 4, 4, beyond(0));
  CHECK(nowhere.x == 1);
  CHECK(nowhere.reason.empty());
}

TEST_CASE("only the first of two faults is looked at, and the reason is the one nearest to the end") {
  std::vector<double> asked;
  const RangeEnd end = first_fault(0, 4, 4, 10, [&](double x) -> std::string {
    asked.push_back(x);
    if (x > 1.2 && x <= 1.5) return "near";
    return x > 1.5 ? "far" : "";
  });
  CHECK(end.reason == "near");
  CHECK(end.x == doctest::Approx(1.2).epsilon(1e-3));
  for (const double x : asked) CHECK(x <= 2);
}

TEST_CASE("halvings that bring a width below a precision") {
  CHECK(halvings_to(1, 2) == 0);
  CHECK(halvings_to(1, 0.5) == 1);
  CHECK(halvings_to(1, 0.3) == 2);
  const double width = std::ldexp(1.0, -halvings_to(1, 1e-6));
  CHECK(width <= 1e-6);
  CHECK(width * 2 > 1e-6);
}

TEST_CASE("ends are shortened towards 0") {
  CHECK(shortened(0.12349) == 0.1234);
  CHECK(shortened(-0.12349) == -0.1234);
}
