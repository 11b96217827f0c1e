#include "core/infer/inference_json.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/infer/edit_assembly.h"
#include "core/infer/reading.h"
#include "core/infer/relation_validity.h"
#include "core/infer/seed_edit.h"
#include "core/infer/type_hints.h"
#include "core/propagate/propagate.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using nlohmann::json;

namespace {

const Shape& chair() {
  static const Shape shape = fixture::shape(fixture::slat_chair(5));
  return shape;
}

SeedReply reply(const std::string& edits) {
  const auto read = read_seed_reply(chair(), "```json\n" + edits + "\n```");
  REQUIRE_MESSAGE(read.ok(), (read.ok() ? "" : read.error().message()));
  return *read;
}

std::string words(const std::string& edit) {
  return reading_words(chair(), reply(edit).statements);
}

const std::string widen = R"({"op": "scale_1d", "part": "seat", "direction": "x"})";
const std::string widen_from_right = R"({"op": "scale_1d", "part": "seat", "direction": "x", "origin": "right"})";
const std::string narrow = R"({"op": "scale_1d", "part": "seat", "direction": "x", "amount": "-x"})";
const std::string deepen = R"({"op": "scale_1d", "part": "seat", "direction": "z"})";
const std::string raised = R"({"op": "translate", "part": "seat", "direction": "up"})";
const std::string raise_too = R"({"op": "translate", "part": "seat", "direction": [0, -1, 0], "amount": "-2*x"})";
const std::string unclear = R"({"unclear": "The chair has no wheels."})";

SeedVote voted(const std::vector<std::string>& texts) {
  std::vector<SeedReply> replies;
  for (const std::string& text : texts) replies.push_back(reply(text));
  return vote(chair(), replies);
}

}  // namespace

TEST_CASE("readings are sentences") {
  CHECK(words(widen) == "widen seat about its centre, left and right");
  CHECK(words(narrow) == "narrow seat about its centre, left and right");
  CHECK(words(deepen) == "make seat deeper about its centre, front and back");
  CHECK(words(raised) == "move seat up");
  CHECK(words(raise_too) == "move seat up");
  CHECK(words(R"({"op": "scale_1d", "part": "leg_front_left", "direction": "y", "origin": "bottom"})") ==
        "make front left leg taller about its bottom, up and down");
  CHECK(words(R"({"op": "rotate", "part": "top_rail", "axis": [-1, 0, 0], "origin": "bottom"})") ==
        "tilt top rail backwards about its bottom");
  CHECK(words(R"({"op": "rotate", "part": "seat", "axis": "y", "origin": {"part": "top_rail", "at": [1, 0, 1]}})") ==
        "turn seat to the left about the front left of top rail");
  CHECK(words(R"({"op": "translate", "part": "seat", "feature": "left", "direction": "left"})") ==
        "move the left face of seat to the left");
  CHECK(words(R"({"op": "scale_2d", "part": "leg_front_left", "feature": "bottom", "normal": "y", "amount": "-x"})") ==
        "shrink the bottom face of front left leg about its bottom, left and right and front and back");
  CHECK(words(R"({"op": "scale_3d", "part": "seat"})") == "enlarge seat about its centre, in all directions");
  CHECK(words(R"({"op": "shear", "part": "seat", "normal": "y", "direction": "front"})") ==
        "slant seat about its centre: its top goes forwards");
  const std::string name = chair().parts[*chair().find_part("slat_group")].name;
  CHECK(words(R"({"op": "change_count", "relation": "t1", "amount": "-8*x"})") ==
        "fewer of " + name + " (t1), in the same space");
  CHECK(words(R"({"op": "change_delta", "relation": "t1"})") ==
        "space " + name + " (t1) further apart, from the middle");
  CHECK(words("[" + widen + ", " + raised + "]") == words(widen) + "; " + words(raised));
}

TEST_CASE("seeds are counted by operator, operand and way") {
  const SeedVote five = voted({widen_from_right, widen, deepen, widen, widen});
  CHECK(five.outcome == SeedVote::Outcome::decided);
  REQUIRE(five.readings.size() == 2);
  CHECK(five.readings[0].votes == 4);
  CHECK(five.readings[0].words == words(widen));  // the usual form, though another came first
  CHECK(five.readings[1].words == words(deepen));
  CHECK(five.of == 5);
  CHECK_FALSE(five.reason.has_value());

  CHECK(voted({widen, narrow}).readings.size() == 2);
  CHECK(voted({raised, raise_too}).readings.size() == 1);
  CHECK(voted({"[" + widen + ", " + raised + "]", "[" + raised + ", " + widen + "]"}).readings.size() == 1);
  const SeedVote tie = voted({deepen, widen});
  CHECK(tie.outcome == SeedVote::Outcome::split);
  CHECK(tie.readings[0].words == words(deepen));
}

TEST_CASE("outcomes") {
  CHECK(voted({}).outcome == SeedVote::Outcome::none);
  CHECK(voted({widen}).outcome == SeedVote::Outcome::decided);
  CHECK(voted({unclear, unclear, widen}).outcome == SeedVote::Outcome::unclear);
  CHECK(voted({unclear, unclear, widen}).reason == "The chair has no wheels.");
  CHECK(voted({unclear, widen}).outcome == SeedVote::Outcome::split);
  CHECK(voted({unclear, widen, widen}).outcome == SeedVote::Outcome::decided);
  CHECK(voted({widen, widen, deepen, deepen, raised}).outcome == SeedVote::Outcome::split);
}

TEST_CASE("hints are kept at 60 %") {
  using Hints = std::map<std::string, Hint>;
  const Hints move = {{"seat", Hint::translate}}, grow = {{"seat", Hint::scale}};
  CHECK(vote(std::vector<Hints>{move, move, move, grow, {}}).size() == 1);
  CHECK(vote(std::vector<Hints>{move, move, move, grow, {}})[0].votes == 3);
  CHECK(vote(std::vector<Hints>{move, move, grow, grow, {}}).empty());
  CHECK(vote(std::vector<Hints>{move, move, {}}).size() == 1);
  CHECK(vote(std::vector<Hints>{}).empty());
}

TEST_CASE("relations go by the majority, and are kept in a tie") {
  const RelationIndex r1 = *chair().find_relation("r1");
  const auto result = [&](std::vector<bool> keeps) { return vote(r1, keeps); };
  CHECK(result({true, false, false}).keep == false);
  CHECK(result({true, false, false}).votes == 2);
  CHECK(result({true, false}).keep == true);
  CHECK(result({}).keep == true);
  CHECK(result({}).of == 0);
}

TEST_CASE("an edit is put together that propagation takes") {
  const auto group = *chair().find_relation("t1"), r1 = *chair().find_relation("r1");
  const auto assembled = [&](const std::string& seed, const std::vector<HintVote>& hints,
                             const std::vector<RelationVote>& relations) {
    const EditRequest edit = assemble(chair(), reply(seed).statements, hints, relations);
    const auto resolved = resolve(edit, chair());
    REQUIRE_MESSAGE(resolved.ok(), (resolved.ok() ? "" : resolved.error().message()));
    return to_json(edit);
  };
  const RelationVote no_r1{r1, false, 3, 5}, no_t1{group, false, 3, 5};
  json edit = assembled(widen, {{"top_rail", Hint::scale, 5, 5}, {"seat", Hint::translate, 5, 5}}, {no_r1, no_r1});
  CHECK(edit["disabled"] == json::array({"r1"}));
  CHECK(edit["hints"] == json{{"top_rail", "scale"}});  // the seat has its seed
  // A group that is edited as one stays; a hint on its instance is one on the group, the one with more votes wins.
  edit = assembled(R"({"op": "change_count", "relation": "t1"})", {}, {no_t1});
  CHECK(edit["disabled"].empty());
  edit = assembled(widen, {{"slat_group", Hint::scale, 3, 5}, {"slat_left", Hint::translate, 4, 5}}, {});
  CHECK(edit["hints"] == json{{"slat_group", "translate"}});
  // A group that is taken apart has no spacing, and its instances have hints of their own.
  edit = assembled(widen, {{"slat_group", Hint::change_delta, 5, 5}, {"slat_left", Hint::translate, 4, 5}}, {no_t1});
  CHECK(edit["disabled"] == json::array({"t1"}));
  CHECK(edit["hints"] == json{{"slat_left", "translate"}});
  edit = assembled(R"({"op": "translate", "part": "slat_left", "direction": "up"})",
                   {{"slat_group", Hint::translate, 5, 5}, {"slat_right", Hint::keep_fixed, 5, 5}}, {});
  CHECK(edit["hints"] == json{{"slat_right", "keep_fixed"}});
}

TEST_CASE("all replies to a request") {
  const std::string fence = "```json\n", end = "\n```";
  const json input = {
      {{"task", "seed_edit"},
       {"relation", nullptr},
       {"texts", {fence + widen + end, "no answer", fence + widen + end}}},
      {{"task", "type_hints"},
       {"relation", nullptr},
       {"texts", {fence + R"({"hints": {"slat_group": "change_delta"}})" + end}}},
      {{"task", "relation_validity_reflection"}, {"relation", "r1"}, {"texts", {fence + R"({"keep": false})" + end}}},
      {{"task", "relation_validity_group"}, {"relation", "t1"}, {"texts", json::array()}}};
  const auto replies = replies_from_json(chair(), input);
  REQUIRE(replies.ok());
  const json result = to_json(chair(), infer(chair(), *replies));
  CHECK(result["seed"]["outcome"] == "decided");
  CHECK(result["seed"]["of"] == 2);
  CHECK(result["seed"]["readings"][0]["words"] == words(widen));
  CHECK(result["seed"]["reason"].is_null());
  CHECK(result["hints"] == json::array({{{"part", "slat_group"}, {"hint", "change_delta"}, {"votes", 1}, {"of", 1}}}));
  CHECK(result["relations"][0]["keep"] == false);
  CHECK(result["relations"][1]["of"] == 0);
  CHECK(result["refused"].size() == 1);
  CHECK(result["refused"][0]["vote"] == 1);
  CHECK(result["edit"]["format"] == "parsel/edit");
  const auto edit = edit_request_from_json(result["edit"]);
  REQUIRE(edit.ok());
  CHECK(propagate(chair(), *edit).ok());

  const json none = to_json(chair(), infer(chair(), {}));
  CHECK(none["edit"].is_null());
  CHECK(none["seed"]["outcome"] == "none");
}

TEST_CASE("replies of no kind are refused") {
  const auto place = [](const json& input) {
    const auto read = replies_from_json(chair(), input);
    return read.ok() ? std::string("accepted") : read.error().place;
  };
  CHECK(place(json::array()) == "accepted");
  CHECK(place(7) == "");
  CHECK(place({7}) == "/0");
  CHECK(place({{{"task", "paint"}, {"texts", json::array()}}}) == "/0/task");
  CHECK(place({{{"task", "seed_edit"}, {"relation", "r1"}, {"texts", json::array()}}}) == "/0/relation");
  CHECK(place({{{"task", "relation_validity_group"}, {"relation", "r1"}, {"texts", json::array()}}}) == "/0/relation");
  CHECK(place({{{"task", "relation_validity_group"}, {"texts", json::array()}}}) == "/0/relation");
  CHECK(place({{{"task", "seed_edit"}, {"texts", "text"}}}) == "/0/texts");
  CHECK(place({{{"task", "seed_edit"}, {"texts", {7}}}}) == "/0/texts");
}
