#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "core/gltf/json_text.h"

using namespace parsel;
using gltf::JsonText;
using nlohmann::ordered_json;

namespace {

JsonText parsed(const std::string& text) {
  auto value = JsonText::parse(text);
  REQUIRE(value.ok());
  return std::move(value).value();
}

const std::string odd =
    " {\n\t\"b\" : [1.0e-3, 0.10, -0, 12345678901234567890 , {}, [ ] ],\n"
    "  \"a\\u0062\":\"\\u00e9 \\\" ] }\", \"x\":{\"y\":{\"z\":null}}, \"x\":true  }\n";

}  // namespace

TEST_CASE("JSON text: what is only looked at keeps every byte") {
  const JsonText json = parsed(odd);
  CHECK(json.text() == odd);
  CHECK(json.size() == 4);
  CHECK(json.get("b").size() == 6);
  CHECK(json.get("b").item(1).number() == 0.1);
  CHECK(json.get("b").item(4).is_object());
  CHECK(json.get("b").item(4).size() == 0);
  CHECK(json.get("ab").string() == "\xc3\xa9 \" ] }");
  CHECK(json.get("x").boolean() == true);  // of two members with one key the last counts
  CHECK(json.get("b").item(99).get("nothing").text() == "null");
  CHECK(json.text() == odd);
}

TEST_CASE("JSON text: an edit changes its own bytes only") {
  JsonText json = parsed(odd);
  json.find("b")->find_item(1)->find("nothing");
  json.find("b")->push_back(JsonText(ordered_json(7)));
  CHECK(json.text() == std::string(odd).replace(odd.find(", [ ] ]"), 7, ", [ ], 7 ]"));
  json = parsed(odd);
  json.find("b")->erase_at(0);
  CHECK(json.text() == std::string(odd).replace(odd.find("1.0e-3,"), 8, " "));
}

TEST_CASE("JSON text: new members follow the style of those before") {
  JsonText pretty = parsed("{\n  \"a\": 1,\n  \"b\": 2\n}");
  pretty.set("c", JsonText(ordered_json{{"d", 3}}));
  CHECK(pretty.text() == "{\n  \"a\": 1,\n  \"b\": 2,\n  \"c\": {\"d\":3}\n}");
  pretty.set("a", JsonText(ordered_json("x\"y")));
  CHECK(pretty.text() == "{\n  \"a\": \"x\\\"y\",\n  \"b\": 2,\n  \"c\": {\"d\":3}\n}");
  pretty.erase("c");
  pretty.erase("a");
  CHECK(pretty.text() == "{\n  \"b\": 2\n}");
  pretty.erase("b");
  CHECK(ordered_json::parse(pretty.text()).empty());
  JsonText empty = parsed("[]");
  empty.push_back(JsonText(ordered_json(1)));
  empty.push_back(JsonText(ordered_json(2)));
  CHECK(empty.text() == "[1,2]");
}

TEST_CASE("JSON text: numbers, indices and strings are what they say") {
  const JsonText json = parsed("[3, 3.0, -1, 2.5, \"3\", true, 1e300, {\"a\":1}]");
  CHECK(json.item(0).index() == 3);
  CHECK(json.item(1).index() == 3);
  for (const std::size_t i : {2, 3, 4, 5, 6, 7}) CHECK_FALSE(json.item(i).index());
  CHECK(json.item(3).number() == 2.5);
  CHECK_FALSE(json.item(4).number());
  CHECK(json.item(4).string() == "3");
  CHECK_FALSE(json.item(0).string());
  CHECK_FALSE(json.item(7).boolean());
}

TEST_CASE("JSON text: what is no JSON, or nested without end, is refused") {
  for (const char* bad : {"", "{", "[1,]", "{\"a\" 1}", "nul", "[1] 2", "\"\x80\"", "{a:1}"}) {
    CHECK_FALSE(JsonText::parse(bad).ok());
  }
  CHECK(JsonText::parse(std::string(128, '[') + std::string(128, ']')).ok());
  CHECK_FALSE(JsonText::parse(std::string(129, '[') + std::string(129, ']')).ok());
  CHECK_FALSE(JsonText::parse(std::string(1000000, '[')).ok());
  CHECK(JsonText::parse("\xEF\xBB\xBF{}").ok());
}
