#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/infer/json_block.h"
#include "core/infer/reading.h"
#include "core/infer/relation_validity.h"
#include "core/infer/seed_edit.h"
#include "core/infer/type_hints.h"
#include "tests/core/hostile_names.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using nlohmann::json;

namespace {

const Shape& chair() {
  static const Shape shape = fixture::shape(fixture::slat_chair(5));
  return shape;
}

/// The statements that a reply is read as, as JSON; the error's place and cause otherwise.
json seed(const std::string& reply) {
  const auto read = read_seed_reply(chair(), reply);
  if (!read.ok()) return read.error().place + ": " + read.error().cause;
  if (read->statements.empty()) return {{"unclear", read->unclear}};
  return to_json(EditRequest{read->statements, {}, {}})["seed"];
}

json one(const std::string& edit) {
  const json all = seed("```json\n{\"edits\": [" + edit + "]}\n```");
  return all.is_array() && all.size() == 1 ? all[0] : all;
}

const std::string wide = R"({"op": "scale_1d", "part": "seat", "direction": [1, 0, 0],
  "origin": {"part": "seat", "at": [0, 0, 0]}, "amount": "x"})";
const std::string good = "I think about {braces} and \"quotes\".\n\n```json\n{\"edits\": [" + wide + ",\n" +
                         R"({"op": "change_count", "relation": "t1", "anchor": "fit", "amount": "-8*x"}]})" + "\n```\n";

}  // namespace

TEST_CASE("a reply as the prompt asks for it") {
  const json read = seed(good);
  REQUIRE(read.size() == 2);
  CHECK(read[0]["op"] == "scale_1d");
  CHECK(read[0]["origin"] == json{{"part", "seat"}, {"at", {0, 0, 0}}});
  CHECK(read[1]["relation"] == "t1");
  CHECK(read[1]["amount"] == "-8*x");
  CHECK(seed("```json\n{\"unclear\": \"There is no door.\"}\n```") == json{{"unclear", "There is no door."}});
}

TEST_CASE("slips of form are forgiven") {
  const json expected = one(wide);
  REQUIRE(expected.is_object());
  const auto same = [&](const std::string& reply) {
    CAPTURE(reply);
    CHECK(seed(reply) == json::array({expected}));
  };
  same("{\"edits\": [" + wide + "]}");                      // no fence
  same("Thinking.\n```json\n{\"edits\": [" + wide + "]}");  // fence not closed
  same("```\n{\"edits\": [" + wide + "]}\n```");            // no language
  same("~~~json\n{\"edits\": [" + wide + "]}\n~~~");
  same("  ```json\n  {\"edits\": [" + wide + "]}\n  ```  ");
  same("```json {\"edits\": [" + wide + "]} ```");  // on one line
  same("```json\n{\"edits\": [" + wide + "]}```");
  same("```json\r\n{\"edits\": [" + wide + "]}\r\n```\r\nDone.");
  same("```json\n" + wide + "\n```");    // a statement alone
  same("```json\n[" + wide + "]\n```");  // a list
  same("```json\n{\"edits\": " + wide + "}\n```");
  same("```json\n{\"edits\": [" + wide + ",],}\n```");  // trailing commas
  same("```json\n{\"edits\": [ // the seat\n" + wide + " /* only */ ] # end\n}\n```");
  same("```json\n{\"edits\": [" + wide + "], \"unclear\": None}\n```");  // Python
  same("```json\n{\"unclear\": \"first thought\"}\n```\nNo:\n```json\n{\"edits\": [" + wide + "]}\n```");
  same("```json\n{\"edits\": [" + wide + "]}\n```\n```json\n{\"note\": 1}\n```");  // the last one that means something
  same("So `{\"edits\": [" + wide + "]}` it is.");
}

TEST_CASE("parts, directions, features and points may be said in words") {
  const json expected = one(wide);
  const auto same = [&](const std::string& edit) {
    CAPTURE(edit);
    CHECK(one(edit) == expected);
  };
  same(R"({"op": "Scale-1D", "part": "SEAT", "direction": "x"})");
  same(R"({"op": "scale 1d", "part": " the Seat ", "axis": "+X", "origin": "center"})");
  same(R"({"op": "scale_1d", "part": "node:0", "direction": "left and right", "origin": [0, 0, 0], "amount": 1})");
  same(R"({"op": "scale_1d", "part": "seat", "direction": "width", "origin": {"at": "centre"}, "amount": "X"})");
  same(R"({"op": "scale_1d", "part": "seat", "normal": "left", "feature": null, "why": {"kind": "?"}, "sign": 1})");

  CHECK(one(R"({"op": "translate", "part": "Top Rail", "direction": "up"})")["part"] == "top_rail");
  CHECK(one(R"({"op": "translate", "part": "front left leg", "direction": "up"})")["part"] == "leg_front_left");
  CHECK(one(R"({"op": "translate", "part": "t1", "direction": "up"})")["part"] == "slat_group");
  CHECK(one(R"({"op": "rotate", "part": "seat", "axis": "up"})")["axis"] == json{0, 1, 0});
  CHECK(one(R"({"op": "rotate", "part": "seat", "axis": 1})")["axis"] == json{{"part", "seat"}, {"axis", 1}});
  CHECK(one(R"({"op": "rotate", "part": "seat", "direction": "-z"})")["axis"] == json{0, 0, -1});
  CHECK(one(R"({"op": "rotate", "part": "seat", "axis": {"part": "leg_front_left", "axis": "y"}})")["axis"] ==
        json{{"part", "leg_front_left"}, {"axis", 1}});
  const json taper =
      one(R"({"op": "scale_2d", "part": "leg_front_left", "feature": "bottom", "axis": "y", "sign": -1})");
  CHECK(taper["feature"] == json{0, -1, 0});
  CHECK(taper["origin"]["at"] == json{0, -1, 0});
  CHECK(taper["normal"] == json{0, 1, 0});
  CHECK(taper["amount"] == "-x");
  CHECK(one(R"({"op": "rotate", "part": "seat", "axis": "x", "origin": "bottom back edge"})")["origin"]["at"] ==
        json{0, -1, -1});
  const json more = one(R"({"op": "change_count", "part": "slat_group"})");
  CHECK(more["relation"] == "t1");
  CHECK(more["anchor"] == "fit");
  CHECK(more["amount"] == "8*x");
  CHECK(one(R"({"op": "change_delta", "relation": "T1", "anchor": "Center", "amount": "-x"})")["anchor"] == "middle");
  CHECK(one(R"({"op": "change_delta", "part": "slat_left"})")["relation"] == "t1");
}

TEST_CASE("meaning is not guessed") {
  const auto refused = [&](const std::string& edit, const std::string& place) {
    CAPTURE(edit);
    const json read = one(edit);
    REQUIRE(read.is_string());
    CHECK_MESSAGE(read.get<std::string>().starts_with(place + ": "), read.get<std::string>());
  };
  refused(R"({"op": "explode", "part": "seat"})", "/edits/0/op");
  refused(R"({"op": 7, "part": "seat"})", "/edits/0/op");
  refused(R"({"op": "translate", "part": "armrest", "direction": [0, 1, 0]})", "/edits/0/part");
  refused(R"({"op": "translate", "part": "leg", "direction": [0, 1, 0]})", "/edits/0/part");
  refused(R"({"op": "translate", "part": "", "direction": [0, 1, 0]})", "/edits/0/part");
  refused(R"({"op": "translate", "part": "__proto__", "direction": [0, 1, 0]})", "/edits/0/part");
  refused(R"({"op": "translate", "part": "seat"})", "/edits/0/direction");
  refused(R"({"op": "translate", "part": "seat", "direction": [0, 0, 0]})", "/edits/0/direction");
  refused(R"({"op": "translate", "part": "seat", "direction": [0, 1]})", "/edits/0/direction");
  refused(R"({"op": "translate", "part": "seat", "direction": [0, 1, "a"]})", "/edits/0/direction/2");
  refused(R"({"op": "translate", "part": "seat", "direction": "diagonal"})", "/edits/0/direction");
  refused(R"({"op": "translate", "part": "seat", "direction": "up and left"})", "/edits/0/direction");
  refused(R"({"op": "translate", "part": "seat", "direction": "up", "feature": [0, 2, 0]})", "/edits/0/feature");
  refused(R"({"op": "translate", "part": "seat", "direction": "up", "feature": "top bottom"})", "/edits/0/feature");
  refused(R"({"op": "translate", "part": "seat", "direction": "up", "feature": [0, 0.5, 0]})", "/edits/0/feature");
  refused(R"({"op": "rotate", "part": "seat", "axis": 3})", "/edits/0/axis/axis");
  refused(R"({"op": "rotate", "part": "seat", "axis": "y", "origin": [0, 0.4, 0]})", "/edits/0/origin");
  refused(R"({"op": "rotate", "part": "seat", "axis": "y", "origin": {"part": "nose"}})", "/edits/0/origin/part");
  refused(R"({"op": "shear", "part": "seat", "direction": "up"})", "/edits/0/normal");
  refused(R"({"op": "scale_3d", "part": "seat", "amount": "y"})", "/edits/0/amount");
  refused(R"({"op": "scale_3d", "part": "seat", "amount": "0.2"})", "/edits/0/amount");
  refused(R"({"op": "scale_3d", "part": "seat", "amount": "1 + x"})", "/edits/0/amount");
  refused(R"({"op": "scale_3d", "part": "seat", "amount": "1/x"})", "/edits/0/amount");
  refused(R"({"op": "scale_3d", "part": "seat", "amount": "system (x) "})", "/edits/0/amount");
  refused(R"({"op": "scale_3d", "part": "seat", "amount": 0})", "/edits/0/amount");
  refused(R"({"op": "scale_3d", "part": "seat", "amount": ")" + std::string(300, 'x') + R"("})", "/edits/0/amount");
  refused(R"({"op": "change_count", "relation": "r1"})", "/edits/0/relation");
  refused(R"({"op": "change_count", "relation": "seat"})", "/edits/0/relation");
  refused(R"({"op": "change_count", "relation": "t9"})", "/edits/0/relation");
  refused(R"({"op": "change_count", "relation": "t1", "anchor": "moon"})", "/edits/0/anchor");
  refused(R"({"op": "keep_fixed", "part": "seat"})", "/edits");
  refused(R"("seat")", "/edits/0");
  refused(R"({"op": "scale_3d", "part": "slat_group"}, {"op": "scale_3d", "part": "slat_left"})", "/edits");
  CHECK(seed("```json\n{\"edits\": [" + wide + "], \"unclear\": \"hm\"}\n```").is_string());
  CHECK(seed("```json\n{\"edits\": []}\n```").is_string());
  CHECK(seed("No JSON at all.").is_string());
  CHECK(seed("").is_string());
}

TEST_CASE("every prefix of a good reply means the same or nothing") {
  const json whole = seed(good);
  bool last = false;
  for (std::size_t n = 0; n <= good.size(); ++n) {
    const json read = seed(good.substr(0, n));
    last = read == whole;
    if (!last) CHECK_MESSAGE(read.is_string(), n << " bytes: " << read.dump());
  }
  CHECK(last);
  const std::string bare = "I say {\"edits\": [" + wide + ", " + wide + "]}";
  for (std::size_t n = 0; n < bare.size(); ++n) CHECK(seed(bare.substr(0, n)).is_string());
}

TEST_CASE("no text makes a reader throw or hang") {
  std::vector<std::string> texts = hostile_names;
  for (const char* piece : {"{", "[", "[{", "{\"", "{\"a\":", "```json\n", "```json\n{", "\"", "\\", "/*", "//", "{}",
                            "[{}]", "{\"edits\":[", "```json\n{}\n```\n", "{\"keep\":true}", "~~~", ",", "\n"}) {
    std::string text;
    while (text.size() < 300'000) text += piece;
    texts.push_back(std::move(text));
  }
  texts.push_back(std::string(ReplyLimits::text_bytes + 1, ' '));
  texts.push_back("```json\n{\"edits\": " + std::string(10'000, '[') + std::string(10'000, ']') + "}\n```");
  texts.push_back("```json\n{\"edits\": [" + wide + "], \"x\": 1e999}\n```");
  texts.push_back("```json\n{\"keep\": \xff}\n```");
  for (const std::string& text : texts) {
    CAPTURE(text.substr(0, 40));
    const auto seed = read_seed_reply(chair(), text);
    CHECK((!seed.ok() || seed->statements.empty()));
    (void)read_hints_reply(chair(), text).ok();
    (void)read_validity_reply(chair(), *chair().find_relation("r1"), text).ok();
  }
}

TEST_CASE("bytes of a good reply that were changed at random give a value or an error") {
  Random random(7);
  int read = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string text = good;
    const int changes = 1 + static_cast<int>(random.below(4));
    for (int i = 0; i < changes; ++i) {
      const auto at = static_cast<std::size_t>(random.below(text.size()));
      if (random.unit() < 0.5) {
        text[at] = static_cast<char>(random.below(256));
      } else {
        text.erase(at, 1 + static_cast<std::size_t>(random.below(8)));
      }
    }
    const auto reply = read_seed_reply(chair(), text);
    if (!reply.ok()) continue;
    ++read;
    CHECK(resolve(EditRequest{reply->statements, {}, {}}, chair()).ok());
    CHECK_FALSE(reading_words(chair(), reply->statements).empty());
  }
  CHECK(read > 100);
}

TEST_CASE("type hints") {
  const auto hints = [](const std::string& block) -> json {
    const auto read = read_hints_reply(chair(), "```json\n" + block + "\n```");
    if (!read.ok()) return read.error().place;
    json out = json::object();
    for (const auto& [part, hint] : *read) out[part] = to_string(hint);
    return out;
  };
  CHECK(hints(R"({"hints": {}})") == json::object());
  CHECK(hints(R"({"hints": {"seat": "translate", "slat_group": "change_delta"}})") ==
        json{{"seat", "translate"}, {"slat_group", "change_delta"}});
  CHECK(hints(R"({"hints": {"Top rail": "Scale_1d", "seat": null}})") == json{{"top_rail", "scale"}});
  CHECK(hints(R"({"seat": "rotate"})") == json{{"seat", "rotate"}});
  CHECK(hints(R"({"hints": {"seat": "rotate", "Seat": "scale"}})") == "/hints/seat");
  CHECK(hints(R"({"hints": {"nose": "rotate"}})") == "/hints/nose");
  CHECK(hints(R"({"hints": {"seat": "dance"}})") == "/hints/seat");
  CHECK(hints(R"({"hints": {"seat": "change_count"}})") == "/hints/seat");
  CHECK(hints(R"({"hints": ["seat"]})") == "/hints");
  CHECK(hints("true") == "");
}

TEST_CASE("relation validity") {
  const RelationIndex r1 = *chair().find_relation("r1");
  const auto keep = [&](const std::string& block) -> json {
    const auto read = read_validity_reply(chair(), r1, "Well.\n```json\n" + block + "\n```");
    return read.ok() ? json(*read) : json(read.error().place);
  };
  CHECK(keep(R"({"keep": true})") == true);
  CHECK(keep(R"({"keep": False})") == false);
  CHECK(keep(R"({"keep": "no"})") == false);
  CHECK(keep("true") == true);
  CHECK(keep(R"({"relation": "r1", "keep": false})") == false);
  CHECK(keep(R"({"relation": "r2", "keep": false})") == "/relation");
  CHECK(keep(R"({"keep": 1})") == "/keep");
  CHECK(keep(R"({"keep": null})") == "/keep");
  CHECK(keep(R"({})") == "/keep");
}
