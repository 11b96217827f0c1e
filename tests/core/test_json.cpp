#include "core/base/json.h"

#include <doctest/doctest.h>

#include "core/infer/json_block.h"

using namespace parsel;
using nlohmann::json;

namespace {

std::string nested(std::size_t levels, char open = '[', char close = ']') {
  std::string text(levels, open);
  return text + std::string(levels, close);
}

Error refusal(std::string_view text, const JsonLimits& limits = {}) {
  const Result<json> read = json_from_text(text, "test", limits);
  REQUIRE_FALSE(read.ok());
  CHECK(read.error().stage == "test");
  CHECK_FALSE(read.error().fix.empty());
  return read.error();
}

}  // namespace

TEST_CASE("the gate lets JSON through as it is") {
  for (const char* text : {"{}", "[1, -2.5e3, \"a\", null, true]", " {\"a\": {\"b\": []}} ", "\"[[[[{{{{\"", "7"}) {
    const Result<json> read = json_from_text(text, "test");
    REQUIRE(read.ok());
    CHECK(*read == json::parse(text));
  }
}

TEST_CASE("deep nesting is refused before it is parsed, at its place") {
  const std::size_t depth = JsonLimits().depth;
  CHECK(json_from_text(nested(depth), "test").ok());
  for (const std::size_t levels : {depth + 1, std::size_t{200'000}, std::size_t{10'000'000}}) {
    CHECK(refusal(nested(levels)).cause == "it is nested deeper than 64 levels");
    CHECK(refusal(nested(levels)).place == "line 1, column 65");
  }
  CHECK(refusal("{\"seed\":\n" + nested(200'000)).place == "line 2, column 64");
  CHECK(refusal(std::string(200'000, '{')).cause == "it is nested deeper than 64 levels");
  // Brackets in a string nest nothing; those that are closed do not add up.
  CHECK(json_from_text("\"" + std::string(1'000, '[') + "\\\"" + std::string(1'000, '[') + "\"", "test").ok());
  std::string flat = "[";
  for (int i = 0; i < 1'000; ++i) flat += "[],";
  CHECK(json_from_text(flat + "[]]", "test").ok());
}

TEST_CASE("size is refused before it is parsed") {
  JsonLimits limits;
  limits.bytes = 10;
  CHECK(json_from_text("[1,2,3,45]", "test", limits).ok());
  CHECK(refusal("[1,2,3,456]", limits).cause == "it is longer than 10 bytes");
  limits = {};
  limits.values = 3;
  CHECK(json_from_text("[1,2,3]", "test", limits).ok());
  CHECK(refusal("[1,2,3,4]", limits).cause == "it has more than 3 values");
  CHECK(refusal("[1,2,\n3,4]", limits).place == "line 2, column 2");
}

TEST_CASE("what is no JSON is refused with line and column in characters") {
  CHECK(refusal("").place == "line 1, column 1");
  CHECK(refusal("{\"a\": 1,\n \"стол\": }").place == "line 2, column 10");
  CHECK(refusal("[1, 2").place == "line 1, column 6");
  CHECK(refusal("[1] x").place == "line 1, column 5");
  CHECK(refusal("[1e999]").cause == "it holds a number that is out of range");
  CHECK_FALSE(json_from_text("\"\xff\"", "test").ok());
  CHECK(refusal("{\"a\" 1}").cause.starts_with("it is not JSON"));
}

TEST_CASE("deep JSON in a reply is no block") {
  CHECK(json_blocks("```json\n" + nested(200'000) + "\n```").empty());
  CHECK(json_blocks("```json\n{\"edits\": " + nested(40) + "}\n```").empty());
  CHECK(json_blocks("```json\n{\"edits\": " + nested(15) + "}\n```").size() >= 1);
}
