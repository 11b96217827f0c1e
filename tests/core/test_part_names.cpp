#include "core/infer/part_names.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/base/random.h"
#include "core/base/text.h"
#include "core/gallery/gallery.h"
#include "core/infer/inference_json.h"
#include "core/infer/prompt.h"
#include "tests/core/hostile_names.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using nlohmann::json;

namespace {

const Shape& chair() {
  static const Shape shape = fixture::shape(fixture::slat_chair(5));
  return shape;
}

json names(const std::string& name = "post") {
  json parts = json::object();
  for (std::size_t i = 0; i < named_parts(chair()).size(); ++i) parts["part_" + std::to_string(i + 1)] = name;
  return parts;
}
std::string reply(const json& parts, const json& category = "chair", const json& front = "+z") {
  return "A chair.\n\n```json\n" + json{{"category", category}, {"front", front}, {"parts", parts}}.dump() + "\n```\n";
}
std::string refusal(const std::string& text) {
  const auto read = read_names_reply(chair(), text);
  return read.ok() ? "" : read.error().place + ": " + read.error().cause;
}
json counted(const std::vector<std::string>& texts) {
  const Inference inference = infer(chair(), {{&part_names_task, {}, texts}});
  return to_json(chair(), inference)["names"];
}

}  // namespace

TEST_CASE("parts are described for naming without any name of the file") {
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    const auto asset = build(model);
    REQUIRE(asset.ok());
    const auto made = abstract_shape(asset->glb, model.id);
    REQUIRE(made.ok());
    const std::string text = describe_nameless(made->shape);
    Shape renamed = made->shape;
    renamed.name = "something else";
    for (const PartIndex part : renamed.parts.indices()) {
      renamed.parts[part].id = renamed.parts[part].label = "other_" + std::to_string(part.value());
      renamed.parts[part].name = "another name";
    }
    CHECK(describe_nameless(renamed) == text);
    std::size_t listed = 0;
    for (std::size_t at = text.find("\n- part_"); at != text.npos; at = text.find("\n- part_", at + 1)) {
      listed += text.find(':', at) < text.find(' ', at + 3);
    }
    CHECK(listed == named_parts(made->shape).size());
  }
}

TEST_CASE("a row of many is named once, a short one part by part") {
  const Shape few = fixture::shape(fixture::slat_chair(5)), many = fixture::shape(fixture::slat_chair(12));
  const auto is_virtual = [](const Shape& shape) {
    std::size_t count = 0;
    for (const PartIndex part : named_parts(shape)) count += shape.parts[part].is_virtual();
    return count;
  };
  CHECK(is_virtual(few) == 0);
  CHECK(is_virtual(many) == 1);
  CHECK(describe_nameless(many).find("12 parts at equal distances") != std::string::npos);
}

TEST_CASE("a model of too many different parts is refused") {
  Random random(18);
  std::vector<fixture::Named> parts;
  for (int i = 0; i < 210; ++i) {
    const Vec3 size(random.uniform(0.2, 3), random.uniform(0.2, 3), random.uniform(0.2, 3));
    parts.push_back({"thing", fixture::box({random.uniform(0, 200), size[1] / 2, random.uniform(0, 200)}, size)});
  }
  const Shape many = fixture::shape(parts);
  REQUIRE(named_parts(many).size() > most_numbered);
  const auto prompt = make_prompt(many, {}, part_names_task);
  REQUIRE_FALSE(prompt.ok());
  CHECK(prompt.error().cause == "the model has more than 200 parts to be listed");
}

TEST_CASE("the prompt for names is about the model alone, and is no part of a request's prompts") {
  const auto prompt = make_prompt(chair(), {}, part_names_task);
  REQUIRE(prompt.ok());
  CHECK(prompt->text.find(" m wide, ") != std::string::npos);
  CHECK(prompt->text.find("The picture") == std::string::npos);
  EditWish seen;
  seen.picture = true;
  const auto with = make_prompt(chair(), seen, part_names_task);
  REQUIRE(with.ok());
  CHECK(with->text.find("with numbers on its parts: 1 on part_1, and so on.\n") != std::string::npos);
  CHECK(numbered_parts(chair(), part_names_task) == named_parts(chair()));
  CHECK_FALSE(make_prompt(chair(), {"widen it", {}}, part_names_task).ok());
  EditWish counting;
  counting.count = 3;
  CHECK_FALSE(make_prompt(chair(), counting, part_names_task).ok());
  const auto prompts = make_prompts(chair(), {"Let the seat be shallower.", {}});
  REQUIRE(prompts.ok());
  for (const Prompt& one : *prompts) CHECK(one.task != &part_names_task);
}

TEST_CASE("names, counted: most replies win, whatever their capitals and directions") {
  json first = names("slat"), second = names("slat"), third = names("bar");
  first["part_1"] = "Seat";
  second["part_1"] = "left seat";
  third["part_1"] = "shelf";
  third.erase("part_2");
  const json found = counted({reply(first), reply(second, "Chair"), reply(third, "bench", "-z")});
  CHECK(found["category"] == "chair");
  CHECK(found["category_votes"] == 2);
  CHECK(found["front"] == "+z");
  CHECK(found["of"] == 3);
  REQUIRE(found["parts"].size() == named_parts(chair()).size());
  CHECK(found["parts"][0]["votes"] == 2);
  CHECK(found["parts"][1] ==
        json{{"part", chair().parts[named_parts(chair())[1]].id}, {"label", "slat"}, {"votes", 2}});
  // Even: the reply that agrees with the others most decides.
  json even = names("slat"), other = names("slat"), odd = names("rail");
  even["part_1"] = "seat";
  other["part_1"] = "board";
  odd["part_1"] = "plank";
  const std::string label = counted({reply(odd), reply(even), reply(other)})["parts"][0]["label"];
  CHECK((label == "seat" || label == "board"));
}

TEST_CASE("names that say nothing are left out, senseless replies refused") {
  CHECK(refusal(reply(names())).empty());
  json nothing = names();
  nothing["part_1"] = "Mesh.003";
  const auto read = read_names_reply(chair(), reply(nothing));
  REQUIRE(read.ok());
  CHECK(read->labels[0].empty());
  CHECK(read->labels[1] == "post");
  CHECK(refusal(reply(names("object"))) == "/parts: no part has a name");
  json unknown = names();
  unknown["part_99"] = "leg";
  CHECK(refusal(reply(unknown)) == "/parts: the list has no part 'part_99'");
  json blank = names();
  blank["part_1"] = " ";
  CHECK(refusal(reply(blank)) == "/parts/part_1: it is no name");
  blank["part_1"] = std::string(61, 'a');
  CHECK(refusal(reply(blank)) == "/parts/part_1: it is longer than 60 characters");
  CHECK(refusal(reply(names(), "")) == "/category: it is no name");
  CHECK(refusal(reply(names(), "chair", "+y")) == "/front: it is none of +z, -z, +x and -x");
  CHECK(refusal(reply(json::array())) == "/parts: it is no object of names by part");
  CHECK_FALSE(refusal("It is a chair.").empty());
  for (const std::string& name : hostile_names) {
    if (!is_utf8(name)) continue;
    json hostile = names();
    hostile["part_1"] = name;
    const auto made = read_names_reply(chair(), reply(hostile));
    if (!made.ok()) continue;
    CHECK(made->labels[0].find('\n') == std::string::npos);
    CHECK(made->labels[0].find('`') == std::string::npos);
  }
}
