// Requests and part names in many scripts through the whole pipeline: model, prompt, reply, program, file.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/export/apply.h"
#include "core/infer/inference.h"
#include "core/infer/names.h"
#include "core/infer/prompt.h"
#include "core/infer/seed_edit.h"
#include "core/propagate/propagate.h"
#include "core/shape/words.h"
#include "tests/core/scripts.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using nlohmann::json;

namespace {

/// A stack of boxes, one a name.
fixture::Document model_of(const std::vector<std::string>& names) {
  std::vector<fixture::Named> parts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double size = 1 + 0.2 * static_cast<double>(i);  // no two alike
    parts.push_back({names[i], fixture::box({0, static_cast<double>(i), 0}, {size, 1, 0.8})});
  }
  return fixture::document(parts);
}

std::vector<std::string> node_names(const std::string& glb) {
  const auto size = static_cast<std::size_t>(static_cast<unsigned char>(glb[12])) |
                    static_cast<std::size_t>(static_cast<unsigned char>(glb[13])) << 8;
  const json document = json::parse(glb.substr(20, size));
  std::vector<std::string> names;
  for (const json& node : document["nodes"]) names.push_back(node["name"]);
  return names;
}

}  // namespace

TEST_CASE("requests of every script are asked as they are") {
  const Shape shape = fixture::shape(fixture::table());
  for (const Script& script : scripts) {
    CAPTURE(script.name);
    const auto prompt = make_prompt(shape, {script.request, {}}, seed_edit_task);
    REQUIRE_MESSAGE(prompt.ok(), (prompt.ok() ? "" : prompt.error().message()));
    const std::string line = "Request: ";
    const std::size_t start = prompt->text.rfind(line) + line.size();
    const std::string quoted = prompt->text.substr(start, prompt->text.find('\n', start) - start);
    CHECK(json::parse(quoted) == script.request);
  }
  for (const char* blank : {"\u202e\u202d", "\u3000", "\u0301"}) {
    CHECK_FALSE(make_prompt(shape, {blank, {}}, seed_edit_task).ok());
  }
}

TEST_CASE("part names of every script come through prompt, reply, program and file") {
  for (const Script& script : scripts) {
    CAPTURE(script.name);
    const std::string glb = model_of(script.parts).glb();
    const Shape shape = fixture::abstraction(glb).shape;
    REQUIRE(shape.parts.size() == script.parts.size());
    std::set<std::string> ids;
    const std::string words = describe(shape);
    for (std::size_t i = 0; i < script.parts.size(); ++i) {
      const Part& part = shape.parts[PartIndex(i)];
      CHECK(ids.insert(part.id).second);
      CHECK(part.label == script.parts[i]);
      CHECK(words.find(part.id) != words.npos);
      if (!part.name.empty() && part.id != part.name) CHECK(words.find("\"" + part.name + "\"") != words.npos);
      const auto named = part_named(shape, part.name);
      REQUIRE(named.ok());
      CHECK(*named == PartIndex(i));
    }

    // A reply that calls the part by its name.
    const std::string called = shape.parts[PartIndex(0)].name;
    const std::string reply =
        "…\n```json\n" + json{{"op", "scale_1d"}, {"part", called}, {"direction", "x"}}.dump() + "\n```";
    const std::vector<Replies> replies = {Replies{&seed_edit_task, {}, {reply}}};
    const Inference inference = infer(shape, replies);
    REQUIRE(inference.edit.has_value());
    CHECK(inference.seed.readings[0].words.find(called) != std::string::npos);

    PropagateOptions options;
    options.request = script.request;
    const auto found = propagate(shape, *inference.edit, options);
    REQUIRE_MESSAGE(found.ok(), (found.ok() ? "" : found.error().message()));
    const json written = to_json(found->program);
    CHECK(written["layers"][0]["request"] == script.request);
    const auto from_json = program_from_json(json::parse(written.dump()));
    REQUIRE(from_json.ok());
    CHECK(to_json(*from_json) == written);
    const auto from_text = program_from_text(to_text(found->program));
    REQUIRE(from_text.ok());
    CHECK(to_json(*from_text) == written);

    const auto applied = apply_program(glb, shape, found->program, {0.1});
    REQUIRE(applied.ok());
    CHECK(node_names(applied->glb) == script.parts);
    const Shape again = fixture::abstraction(applied->glb).shape;
    for (const PartIndex p : shape.parts.indices()) {
      CHECK(again.parts[p].id == shape.parts[p].id);
      CHECK(again.parts[p].name == shape.parts[p].name);
    }
  }
}

TEST_CASE("ids and names of every script in a program are kept, and shown whole when they are refused") {
  const Shape shape = fixture::shape(fixture::table());
  for (const Script& script : scripts) {
    CAPTURE(script.name);
    const json edit = {{"seed", {{{"op", "keep_fixed"}, {"part", script.parts[0]}}}}};
    const auto request = edit_request_from_json(edit);
    REQUIRE(request.ok());
    const auto refused = resolve(*request, shape);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().cause.find("'" + script.parts[0] + "'") != std::string::npos);
    const auto unknown = edit_request_from_json({{script.parts[0], 1}, {"seed", json::array()}});
    REQUIRE_FALSE(unknown.ok());
    CHECK(unknown.error().place == "/" + script.parts[0]);
  }
  const auto reversed = edit_request_from_json({{"seed", {{{"op", "keep_fixed"}, {"part", "\u202eseat"}}}}});
  REQUIRE(reversed.ok());
  CHECK(resolve(*reversed, shape).error().cause.find("'seat'") != std::string::npos);
}
