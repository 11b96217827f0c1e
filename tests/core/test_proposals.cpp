#include "core/infer/proposals.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/infer/inference_json.h"
#include "core/infer/prompt.h"
#include "core/infer/task_list.h"
#include "core/shape/words.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using nlohmann::json;

namespace {

const Shape& chair() {
  static const Shape shape = fixture::shape(fixture::slat_chair(5));
  return shape;
}

json proposal(const std::string& request, const json& changes, const json& keeps = json::array()) {
  return {{"request", request}, {"changes", changes}, {"keeps", keeps}};
}

std::string reply(const json& requests) {
  return "Chairs differ.\n\n```json\n" + json{{"requests", requests}}.dump() + "\n```\n";
}

/// What infer() makes of the replies; the first refusal as text when none can be read.
json read(const Task& task, const std::vector<std::string>& texts) {
  const Inference inference = infer(chair(), {{&task, {}, texts}});
  if (inference.refused.size() == texts.size()) {
    return inference.refused[0].error.place + ": " + inference.refused[0].error.cause;
  }
  return to_json(chair(), inference)["proposals"];
}

/// The clause why the only proposal was dropped; the request where it was not.
std::string one(const json& item, const Task& task = procedural_requests_task) {
  const json found = read(task, {reply(json::array({item}))});
  if (found.is_string()) return found.get<std::string>();
  return found["dropped"].empty() ? found["requests"][0]["request"].get<std::string>()
                                  : found["dropped"][0]["reason"].get<std::string>();
}

}  // namespace

TEST_CASE("proposals, as the prompt asks for them") {
  const json asked = {proposal("Make the seat wider.", {"seat"}, {"top_rail"}),
                      proposal("Put more slats into the back.", {"slat_group"})};
  const json found = read(procedural_requests_task, {reply(asked)});
  CHECK(found["requests"] == asked);
  CHECK(found["dropped"].empty());
  CHECK(read(request_variations_task, {reply(asked)})["requests"] == asked);
  // Names as people write them are ids afterwards; a group's relation is its virtual part.
  const json words = read(procedural_requests_task,
                          {reply(json::array({proposal("More slats.", {"t1", "slat_group"}, {"Top Rail"})}))});
  REQUIRE(words["requests"].size() == 1);
  CHECK(words["requests"][0]["changes"] == json{"slat_group"});
  CHECK(words["requests"][0]["keeps"] == json{"top_rail"});
}

TEST_CASE("proposals that cannot be asked are dropped, and it is said why") {
  CHECK(one(proposal("Add wheels.", {"wheels"})) == "the shape has no part 'wheels'");
  CHECK(one(proposal("Make the seat wider.", {"seat"}, {"cushion"})) == "the shape has no part 'cushion'");
  CHECK(one(proposal("Make it nicer.", json::array())) == "it does not say which parts change");
  CHECK(one("Make the seat wider.") == "it does not say which parts change");
  CHECK(one(proposal(" \n ", {"seat"})) == "its request is empty");
  CHECK(one(proposal(std::string(301, 'a'), {"seat"})) == "it is longer than 300 characters");
  CHECK(one(proposal("Make the seat 20 cm wider.", {"seat"})).starts_with("it gives an amount"));
  CHECK(one(proposal("Make the seat 2x wider.", {"seat"})).starts_with("it gives an amount"));
  CHECK(one({{"request", "Make the seat wider."}, {"changes", 4}}) == "its parts are no list");
  // A person's own amount stays in a variation.
  CHECK(one(proposal("Make the seat 20 cm wider.", {"seat"}), request_variations_task) == "Make the seat 20 cm wider.");

  const json twice =
      read(procedural_requests_task,
           {reply(json::array({proposal("Make the seat wider.", {"seat"}), proposal("make seat WIDER", {"seat"})}))});
  CHECK(twice["requests"].size() == 1);
  CHECK(twice["dropped"] == json{{{"request", "make seat WIDER"}, {"reason", "it says the same as another one"}}});
}

TEST_CASE("other languages are read, markup is taken out") {
  CHECK(one(proposal("Die Sitzfläche soll breiter werden.", {"seat"})) == "Die Sitzfläche soll breiter werden.");
  CHECK(one(proposal("让座面更宽。", {"seat"})) == "让座面更宽。");
  CHECK(one(proposal("Make the <b>seat</b> **wider**, `please`.", {"<b>seat</b>"})) == "Make the seat wider, please.");
  CHECK(one(proposal("Let 1 < 2.", {"seat"})).starts_with("it gives"));
  CHECK(one(proposal("Wider\n```json\n{}\n```", {"`seat`"})).find('\n') == std::string::npos);
}

TEST_CASE("forty proposals, none, and replies that are none") {
  json many = json::array();
  for (int i = 0; i < 40; ++i)
    many.push_back(proposal("Make the seat " + std::string(static_cast<std::size_t>(i) + 1, 'w') + "ider.", {"seat"}));
  const json found = read(procedural_requests_task, {reply(many)});
  CHECK(found["requests"].size() == 12);
  REQUIRE(found["dropped"].size() == 28);
  CHECK(found["dropped"][27]["reason"] == "there are 12 already");
  CHECK(read(procedural_requests_task, {reply(json::array())}) == "/requests: it proposes nothing");
  CHECK(read(procedural_requests_task, {"I would rather not."}) == ": the reply holds no whole JSON block");
  CHECK(read(procedural_requests_task, {"```json\n{\"requests\": 6}\n```"}) == "/requests: it is no list");
  CHECK(read(procedural_requests_task, {"```json\n{\"requests\": [{\"request\": \"Wi"}).is_string());
  const json none = read(procedural_requests_task, {reply(json::array({proposal("Add wheels.", {"wheels"})}))});
  CHECK(none["requests"].empty());
  CHECK(none["dropped"].size() == 1);
}

TEST_CASE("the replies of several votes are put together") {
  const json found = read(request_variations_task,
                          {reply(json::array({proposal("Wider seat.", {"seat"})})), "no",
                           reply(json::array({proposal("Wider seat", {"seat"}), proposal("Lower.", {"seat"})}))});
  CHECK(found["requests"].size() == 2);
  CHECK(found["requests"][1]["request"] == "Lower.");
}

TEST_CASE("prompts for proposals say how many, and what the numbers in the picture are") {
  const auto text = [](const Task& task, const EditWish& wish) {
    const auto prompt = make_prompt(chair(), wish, task);
    return prompt.ok() ? prompt->text : prompt.error().place;
  };
  const auto has = [](const std::string& all, const std::string& piece) {
    return all.find(piece) != std::string::npos;
  };
  const std::string six = text(procedural_requests_task, {}),
                    four = text(request_variations_task, {"Wider.", {"seat"}});
  CHECK(has(six, "to propose: 6\n"));
  CHECK(has(six, describe(chair())));
  CHECK_FALSE(has(six, "The picture"));
  CHECK(has(four, "to write: 4\n"));
  CHECK(has(four, "Request: \"Wider.\"\n"));
  CHECK(has(four, "pointed at: seat\n"));
  const std::string seen = text(procedural_requests_task, {"", {}, 12, true});
  CHECK(has(seen, "to propose: 12\n"));
  const std::vector<PartIndex> numbered = numbered_parts(chair(), procedural_requests_task);
  for (std::size_t i = 0; i < numbered.size(); ++i) {
    CHECK(has(seen, " " + std::to_string(i + 1) + " " + chair().parts[numbered[i]].id +
                        (i + 1 < numbered.size() ? "," : ".")));
  }
  for (const std::string& prompt : {six, four, seen}) {
    CHECK_FALSE(has(prompt, "{{"));
    std::size_t last = 0;
    for (const char* heading : {"# Task\n", "# Output format\n", "# Worked examples\n", "# The model and the request\n",
                                "# Steps to think through\n", "# Guidelines and reminders\n"}) {
      const std::size_t at = prompt.find(heading);
      REQUIRE_MESSAGE(at != prompt.npos, heading);
      CHECK(at >= last);
      last = at;
    }
  }
  CHECK(text(procedural_requests_task, {"Wider.", {}}) == "request");
  CHECK(text(request_variations_task, {"", {}}) == "request");
  CHECK(text(procedural_requests_task, {"", {"nose"}}) == "mentioned");
  CHECK(text(procedural_requests_task, {"", {}, 13}) == "count");
  CHECK(text(procedural_requests_task, {"", {}, -1}) == "count");
  CHECK(text(*find_task("seed_edit"), {"Wider.", {}, 4}) == "count");
  CHECK(text(*find_task("seed_edit"), {"Wider.", {}, 0, true}) == "picture");
}
