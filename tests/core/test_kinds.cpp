#include "core/infer/kinds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/cad/scad_flatten.h"
#include "core/gallery/programs.h"
#include "core/infer/cad_task.h"
#include "core/infer/cad_words.h"
#include "core/infer/prompt.h"
#include "core/infer/variation_reply.h"
#include "tests/core/hostile_names.h"

using namespace parsel;
using nlohmann::json;

namespace {

const cad::Model& table() {
  static const cad::Model model = [] {
    const auto read = cad::read_scad(
        "// board\ncube([60, 40, 3]);\n// foot\ntranslate([0, 0, -20]) cylinder(h = 20, d1 = 30, d2 = 10);", "table");
    REQUIRE(read.ok());
    return *read;
  }();
  return model;
}

std::string fenced(const json& block) {
  return "Thoughts.\n\n```json\n" + block.dump() + "\n```\n";
}
std::string named(const json& kinds) {
  return fenced({{"kinds", kinds}});
}
std::string refusal(const json& parts) {
  const family::Layout layout = layout_of(table(), family::Vocabulary::extended);
  const auto read = read_variation_reply(table(), layout, fenced({{"parts", parts}}));
  return read.ok() ? "" : read.error().place + ": " + read.error().cause;
}
json bounds(double width) {
  return {{0, width}, {0, 3}, {0, 40}};
}
json cone(double top) {
  return {{0, 30}, {-20, 0}, {-30, 0}, top};
}

}  // namespace

TEST_CASE("prompts about a CAD program have the six sections, and say each part's bounds") {
  std::set<std::string> hashes;
  for (const GalleryProgram& program : gallery_programs()) {
    const auto model = cad::read_scad(program.scad, program.id);
    REQUIRE(model.ok());
    for (const CadTask* task : all_cad_tasks()) {
      CAPTURE(task->name);
      const auto prompt = make_prompt(*model, *task, {task->about_kind ? "big one" : "", 0});
      REQUIRE(prompt.ok());
      CHECK(prompt->hash == sha256_hex(prompt->text));
      hashes.insert(prompt->hash);
      CHECK(prompt->text.find("{{") == std::string::npos);
      CHECK(prompt->text.find(describe(*model)) != std::string::npos);
      CHECK((prompt->text.find("Kind: \"big one\"\n") != std::string::npos) == task->about_kind);
      std::size_t last = 0;
      for (const char* heading :
           {"# Task\n", "# Output format\n", "# Worked examples\n", "# The model and the request\n",
            "# Steps to think through\n", "# Guidelines and reminders\n"}) {
        const std::size_t at = prompt->text.find(heading);
        REQUIRE_MESSAGE(at != std::string::npos, heading);
        CHECK(at >= last);
        last = at;
      }
      const std::size_t from = prompt->text.find("# Worked examples"), to = prompt->text.find("# The model and");
      CHECK(prompt->text.substr(from, to - from).find("of a " + std::string(program.id) + ".") == std::string::npos);
    }
  }
  CHECK(hashes.size() == 2 * gallery_programs().size());
  const std::string words = describe(table());
  CHECK(words.find("- board: box, x 0 to 60, y 0 to 3, z -40 to 0\n") != std::string::npos);
  CHECK(words.find("- foot: cone along y, its top towards +y, x -15 to 15, y -20 to 0, z -15 to 15, top 10") !=
        std::string::npos);
}

TEST_CASE("prompts about a CAD program are refused with what to give instead") {
  const auto place = [](const CadTask& task, const CadWish& wish) {
    const auto prompt = make_prompt(table(), task, wish);
    if (prompt.ok()) return std::string();
    CHECK_FALSE(prompt.error().fix.empty());
    return prompt.error().place;
  };
  CHECK(place(kinds_task, {"bench", 0}) == "kind");
  CHECK(place(variation_task, {"", 0}) == "kind");
  CHECK(place(variation_task, {" \n", 0}) == "kind");
  CHECK(place(variation_task, {std::string(100, 'a'), 0}) == "kind");
  CHECK(place(variation_task, {"a\xff", 0}) == "kind");
  CHECK(place(variation_task, {"bench", 3}) == "count");
  CHECK(place(kinds_task, {"", 13}) == "count");
  CHECK(place(kinds_task, {"", -1}) == "count");
  CHECK(place(kinds_task, {"", 12}).empty());
}

TEST_CASE("names of strangers do not change the structure of a prompt about a program") {
  const auto tame = make_prompt(table(), variation_task, {"x", 0});
  REQUIRE(tame.ok());
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  const auto fences = [](const std::string& text) {
    std::size_t n = 0;
    for (std::size_t at = text.find("```"); at != text.npos; at = text.find("```", at + 3)) ++n;
    return n;
  };
  for (const std::string& name : hostile_names) {
    CAPTURE(name);
    cad::Model model = table();
    model.name = name;
    for (cad::Part& part : model.parts) part.name = name;
    const std::string kind = name.substr(0, 60);
    const auto prompt = make_prompt(model, variation_task, {kind, 0});
    if (!prompt.ok()) continue;  // a kind that cannot be shown
    CHECK(lines(prompt->text) == lines(tame->text));
    CHECK(fences(prompt->text) == fences(tame->text));
  }
}

TEST_CASE("kinds are counted by how many replies name them, whatever their spelling") {
  const auto read = [](const std::vector<std::string>& texts) {
    const auto found = read_kinds(table(), texts);
    REQUIRE(found.ok());
    return *found;
  };
  const json found = read({named({{{"name", "side table"}, {"absent", json::array()}, {"words", "small"}},
                                  {{"name", "desk"}, {"absent", {"foot"}}, {"words", "wide"}}}),
                           named({{{"name", "Desks"}, {"absent", json::array()}, {"words", "deep"}},
                                  {{"name", "bar table"}, {"absent", json::array()}, {"words", "high"}}}),
                           named({{{"name", "desk"}, {"absent", {"foot"}}, {"words", "flat"}},
                                  {{"name", "the Side-Table"}, {"absent", json::array()}, {"words", "low"}}})});
  REQUIRE(found["kinds"].size() == 3);
  CHECK(found["kinds"][0] == json{{"name", "desk"}, {"words", "wide"}, {"absent", {"foot"}}, {"votes", 3}});
  CHECK(found["kinds"][1]["name"] == "side table");
  CHECK(found["kinds"][1]["votes"] == 2);
  CHECK(found["kinds"][2]["name"] == "bar table");
  CHECK(found["refused"].empty());
}

TEST_CASE("a kind that cannot be drawn is dropped with its reason") {
  const auto one = [](const json& kind) {
    const auto read = read_kinds_reply(table(), named({kind, {{"name", "desk"}, {"absent", json::array()}}}));
    REQUIRE(read.ok());
    return read->dropped.empty() ? std::string() : read->dropped[0].reason;
  };
  CHECK(one({{"name", "stand"}}) == "");
  CHECK(one({{"name", " "}}) == "it has no name");
  CHECK(one({{"name", 4}}) == "it has no name");
  CHECK(one("stand") == "it is no object");
  CHECK(one({{"name", std::string(80, 'a')}}) == "its name is too long");
  CHECK(one({{"name", "stand"}, {"absent", {"wheel"}}}) == "it lacks a part that the program does not have");
  CHECK(one({{"name", "stand"}, {"absent", {"board", "foot"}}}) == "it has none of the parts");
  CHECK(one({{"name", "stand"}, {"absent", "foot"}}) == "what it lacks is no list");
  const auto twice = read_kinds_reply(table(), named({{{"name", "desk"}}, {{"name", "Desk"}}}));
  REQUIRE(twice.ok());
  CHECK(twice->dropped.at(0).reason == "it is named twice");
  json many = json::array();
  for (int i = 0; i < 14; ++i) many.push_back({{"name", "kind " + std::string(1, static_cast<char>('a' + i))}});
  CHECK(read_kinds_reply(table(), named(many))->kinds.size() == most_kinds);

  CHECK_FALSE(read_kinds_reply(table(), named(json::array())).ok());
  CHECK_FALSE(read_kinds_reply(table(), named({{{"name", ""}}})).ok());
  CHECK_FALSE(read_kinds_reply(table(), "No block at all.").ok());
  for (const std::string& name : hostile_names) {
    if (!is_utf8(name)) continue;
    const auto read = read_kinds_reply(table(), named({{{"name", name}, {"words", name}}}));
    if (!read.ok()) continue;
    CHECK(read->kinds[0].name.find('\n') == std::string::npos);
    CHECK(read->kinds[0].name.find('`') == std::string::npos);
  }
}

TEST_CASE("senseless bounds are refused by the part's name") {
  CHECK(refusal({{"board", bounds(70)}, {"foot", cone(12)}}).empty());
  CHECK(refusal({{"board", "absent"}, {"foot", cone(0)}}).empty());
  CHECK(refusal({{"board", bounds(70)}}) == "/parts/foot: the part is missing");
  CHECK(refusal({{"board", bounds(0)}, {"foot", cone(12)}}) ==
        "/parts/board: its bounds along x enclose nothing: the lower one is not below the upper one");
  CHECK(refusal({{"board", {{0, 1}, {0, 3}}}, {"foot", cone(12)}}) == "/parts/board: it has no three pairs of bounds");
  CHECK(refusal({{"board", {{0, 1}, {0, "3"}, {0, 1}}}, {"foot", cone(12)}}) ==
        "/parts/board: its bounds along y are no pair of numbers up to a million");
  CHECK(refusal({{"board", {{0, 1}, {0, 3}, {0, 1e9}}}, {"foot", cone(12)}}) ==
        "/parts/board: its bounds along z are no pair of numbers up to a million");
  CHECK(refusal({{"board", {{0, 1}, {0, 3}, {0, 1}, 4}}, {"foot", cone(12)}}) ==
        "/parts/board: it has more than its bounds");
  CHECK(refusal({{"board", bounds(70)}, {"foot", {{0, 30}, {-20, 0}, {-30, 0}}}}) ==
        "/parts/foot: the diameter of its top is missing");
  CHECK(refusal({{"board", bounds(70)}, {"foot", cone(-1)}}) == "/parts/foot: its top is no diameter");
  CHECK(refusal({{"board", bounds(70)}, {"foot", cone(12)}, {"wheel", bounds(3)}}) ==
        "/parts: the program has no part 'wheel'");
  CHECK(refusal({{"board", "absent"}, {"foot", "absent"}}) == "/parts: no part is left");
  CHECK(refusal(json::array()) == "/parts: it is no object of bounds by part");
}

TEST_CASE("replies about a kind become parsel/variations that a family reads") {
  const std::vector<std::string> texts = {fenced({{"parts", {{"board", bounds(70)}, {"foot", cone(12)}}}}),
                                          "I would rather not.",
                                          fenced({{"parts", {{"board", bounds(80)}, {"foot", cone(14)}}}}),
                                          fenced({{"parts", {{"board", bounds(90)}, {"foot", "absent"}}}})};
  const auto read = read_variation(table(), "desk", texts);
  REQUIRE(read.ok());
  REQUIRE((*read)["refused"].size() == 1);
  CHECK((*read)["refused"][0]["vote"] == 1);
  const family::Layout layout = layout_of(table(), family::Vocabulary::extended);
  const auto variations = family::variations_from_json((*read)["variation"], layout, table());
  REQUIRE(variations.ok());
  REQUIRE(variations->size() == 1);
  CHECK((*variations)[0].name == "desk");
  CHECK((*variations)[0].votes == 3);
  CHECK((*variations)[0].source == "model");
  CHECK((*variations)[0].values[static_cast<Eigen::Index>(layout.find("board.sx"))] == doctest::Approx(80));
  CHECK((*variations)[0].values[static_cast<Eigen::Index>(layout.find("foot.top"))] == doctest::Approx(13));
  CHECK_FALSE(read_variation(table(), "desk", {"Nothing."}).ok());
  CHECK_FALSE(read_variation(table(), "desk", {}).ok());
}
