#include "core/propagate/edit_request.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/core/shape_fixture.h"

using namespace parsel;

namespace {

/// The cause for which an edit of the chair is refused; empty when it is not.
std::string cause(const nlohmann::json& statement) {
  static const Shape chair = fixture::shape(fixture::slat_chair(5));
  const auto request = edit_request_from_json({{"seed", {statement}}});
  REQUIRE_MESSAGE(request.ok(), (request.ok() ? "" : request.error().message()));
  const auto resolved = resolve(*request, chair);
  if (resolved.ok()) return "";
  CHECK(resolved.error().place == "/seed/0/amount");
  return resolved.error().cause;
}

std::string moving(const std::string& amount) {
  return cause({{"op", "translate"}, {"part", "seat"}, {"direction", {1, 0, 0}}, {"amount", amount}});
}
std::string counting(const std::string& amount) {
  return cause({{"op", "change_count"}, {"relation", "t1"}, {"amount", amount}});
}

}  // namespace

TEST_CASE("a seed edit moves nothing at x = 0") {
  for (const char* amount : {"x", "-2*x", "sin(x + pi)", "x*x", "abs(x)", "1 - cos(x)", "sqrt(x + 1) - 1"}) {
    CAPTURE(amount);
    CHECK(moving(amount) == "");
  }
  for (const char* amount : {"x + 0.1", "cos(x)", "x - 0.00001"}) {
    CAPTURE(amount);
    CHECK(moving(amount).starts_with("is not 0 at x = 0"));
  }
  for (const char* amount : {"1/x", "x/abs(x)", "sqrt(x - 1)"}) {
    CAPTURE(amount);
    CHECK(moving(amount) == "is undefined at x = 0");
  }
  // Counts change by whole instances.
  for (const char* amount : {"8*x", "8*x + 0.5", "floor(x/0.05)"}) CHECK(counting(amount) == "");
  for (const char* amount : {"8*x + 1", "8*x - 0.5"}) CHECK(counting(amount).starts_with("is not 0 at x = 0"));
}

TEST_CASE("a count keeps the room of its row unless an anchor says otherwise") {
  const auto anchor = [](const nlohmann::json& statement) {
    return edit_request_from_json({{"seed", {statement}}})->seed[0].anchor;
  };
  CHECK(anchor({{"op", "change_count"}, {"relation", "t1"}, {"amount", "-8*x"}}) == Anchor::fit);
  CHECK(anchor({{"op", "change_count"}, {"relation", "t1"}, {"amount", "-8*x"}, {"anchor", "end"}}) == Anchor::end);
  CHECK(anchor({{"op", "change_delta"}, {"relation", "t1"}, {"amount", "x"}}) == Anchor::middle);
}
