// What opens can be exported: the importer and the exporter ask the same reader, so no file is accepted by one and
// refused by the other.
#include <doctest/doctest.h>

#include "core/base/random.h"
#include "core/base/uri.h"
#include "core/export/apply.h"
#include "core/gallery/gallery.h"
#include "core/shape/abstraction.h"
#include "tests/core/apply_fixture.h"
#include "tests/core/real_models.h"

using namespace parsel;

namespace {

/// Moves the first part, or stretches it.
Program small_program(const Shape& shape, bool stretch) {
  Statement statement;
  statement.op = stretch ? Op::scale_1d : Op::translate;
  statement.part = shape.parts[PartIndex(0)].id;
  statement.direction = Vec3(1, 0, 0);
  if (stretch) statement.origin = Vec3(0, 0, 0);
  statement.amount = *parse_amount("0.1*x");
  Program program;
  program.shape_name = shape.name;
  program.shape_sha256 = shape.sha256;
  program.layers.push_back({"", {"x", -1, 1, 0}, {statement}, {}});
  return program;
}

struct Tally {
  std::size_t opened = 0, refused = 0;
};

/// Opens the file and, when it opens, exports it moved and stretched, also as an animation.
void open_and_export(const std::string& bytes, const ExternalBuffers& buffers, const std::string& name, Tally& tally) {
  const auto model = abstract_shape(bytes, "model", buffers);
  if (!model.ok()) {
    ++tally.refused;
    const auto file = gltf::read_file(bytes, buffers);
    if (!file.ok()) CHECK_MESSAGE(file.error().message() == model.error().message(), name);
    return;
  }
  ++tally.opened;
  ApplyOptions options;
  options.external = buffers;
  for (const bool stretch : {false, true}) {
    const Program program = small_program(model->shape, stretch);
    REQUIRE_MESSAGE(validate(program, model->shape).ok(), name);
    for (const bool animated : {false, true}) {
      if (animated && tally.opened % 8 != 0) continue;
      const auto out = apply_program(bytes, model->shape, program, {1},
                                     animated ? std::optional(Animate{"x"}) : std::nullopt, options);
      CHECK_MESSAGE(out.ok(),
                    name << (stretch ? " stretched: " : " moved: ") << (out.ok() ? "" : out.error().message()));
      if (!out.ok()) continue;
      const auto again = gltf::read_document(out->glb, buffers);
      CHECK_MESSAGE(again.ok(), name << ": " << (again.ok() ? "" : again.error().message()));
    }
  }
}

ExternalBuffers buffers_beside(const std::filesystem::path& path, const std::string& bytes) {
  ExternalBuffers buffers;
  for (const std::string& uri : external_buffer_uris(bytes)) {
    const auto file = path.parent_path() / uri;
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error)) buffers[uri] = test::read_bytes(file);
  }
  return buffers;
}

using apply_fixture::Glb;
using apply_fixture::ordered_json;

/// Eight corners, with a normal each: POSITION and NORMAL of an accessor pair.
ordered_json corner_attributes(Glb& glb, const Vec3& low, const Vec3& high) {
  const std::vector<Vec3> points = apply_fixture::grid(low, high, 1);
  std::vector<Vec3> normals;
  for (const Vec3& p : points) normals.push_back((p - (low + high) / 2).normalized());
  const std::size_t position = glb.vectors(points);
  return {{"POSITION", position}, {"NORMAL", glb.vectors(normals, false)}};
}

const std::vector<std::uint16_t> corner_triangles{0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                                  2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};

/// A top on two legs that share a mesh, a light below the top.
Glb small_table() {
  Glb glb;
  const std::size_t triangles = glb.indices(corner_triangles);
  const std::size_t top =
      glb.mesh({{"attributes", corner_attributes(glb, {-1, 1, -1}, {1, 1.1, 1})}, {"indices", triangles}});
  const std::size_t leg =
      glb.mesh({{"attributes", corner_attributes(glb, {-0.1, 0, -0.1}, {0.1, 1, 0.1})}, {"indices", triangles}});
  glb.node({{"name", "top"}, {"mesh", top}, {"children", {3}}});
  glb.node({{"name", "leg_left"}, {"mesh", leg}, {"translation", {-0.8, 0, 0}}});
  glb.node({{"name", "leg_right"}, {"mesh", leg}, {"translation", {0.8, 0, 0}}, {"scale", {1, 1, 1}}});
  glb.json["nodes"].push_back({{"name", "lamp"}, {"translation", {0, 1.5, 0}}, {"rotation", {0, 0, 0, 1}}});
  return glb;
}

/// The same with the ways of a file to say things that are said otherwise in most: strides, sparse and missing data,
/// morph targets, levels of detail, an animation, a compressed copy.
std::string odd_table() {
  Glb glb = small_table();
  ordered_json& json = glb.json;
  std::vector<float> pairs;
  for (const Vec3& p : apply_fixture::grid(Vec3(-0.1, 0, -0.1), Vec3(0.1, 1, 0.1), 1)) {
    for (int copy = 0; copy < 2; ++copy) {
      for (int c = 0; c < 3; ++c) pairs.push_back(static_cast<float>(p[c]));
    }
  }
  ordered_json& position =
      json["accessors"][json["meshes"][1]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
  position["bufferView"] = glb.view(pairs);
  json["bufferViews"].back()["byteStride"] = 24;
  const std::size_t at = glb.view(std::vector<std::uint16_t>{1, 5});
  const std::size_t with = glb.view(std::vector<float>{0, 0.1F, 0, 0, 0.2F, 0});
  json["accessors"].push_back({{"componentType", 5126},
                               {"count", 8},
                               {"type", "VEC3"},
                               {"sparse",
                                {{"count", 2},
                                 {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                                 {"values", {{"bufferView", with}}}}}});
  const std::size_t sparse = json["accessors"].size() - 1;
  json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", sparse}, {"NORMAL", sparse}}};
  json["meshes"][1]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", at},
                                                                                    {"attributes", {{"POSITION", 0}}}};
  json["extensionsUsed"] = {"KHR_draco_mesh_compression", "MSFT_lod"};
  json["nodes"].push_back({{"name", "coarse"}, {"mesh", 1}, {"translation", {-0.8, 0, 0}}});
  json["nodes"][1]["extensions"]["MSFT_lod"]["ids"] = {json["nodes"].size() - 1};
  json["accessors"].push_back({{"bufferView", glb.view(std::vector<float>{0, 1})},
                               {"componentType", 5126},
                               {"count", 2},
                               {"type", "SCALAR"},
                               {"min", {0}},
                               {"max", {1}}});
  const std::size_t turns = glb.view(std::vector<float>{0, 0, 0, 1, 0, 1, 0, 0});
  json["accessors"].push_back({{"bufferView", turns}, {"componentType", 5126}, {"count", 2}, {"type", "VEC4"}});
  const std::size_t last = json["accessors"].size() - 1;
  json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}},
                         {"samplers", {{{"input", last - 1}, {"output", last}}}}}};
  return glb.bytes();
}

/// The same with its bytes in the JSON.
std::string table_of_text() {
  Glb glb = small_table();
  glb.json["buffers"][0] = {{"byteLength", glb.binary.size()},
                            {"uri", "data:application/octet-stream;base64," + base64_encode(glb.binary)}};
  return apply_fixture::glb_of(glb.json.dump(), "");
}

/// A number of the JSON changed, a member taken out, or a byte anywhere.
std::string mutated(const std::string& glb, Random& random) {
  const std::uint64_t kind = random.below(3);
  if (kind == 2) {
    std::string out = glb;
    for (std::uint64_t i = 0; i <= random.below(3); ++i) {
      out[20 + random.below(out.size() - 20)] = static_cast<char>(random.below(256));
    }
    return out;
  }
  std::string text = apply_fixture::json_chunk(glb);
  const std::string binary = glb.substr(28 + text.size());
  if (kind == 0) {
    std::vector<std::size_t> digits;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] >= '0' && text[i] <= '9') digits.push_back(i);
    }
    static const std::vector<std::string> replacements{"9",   "0",  "4294967295", "-1",  "1e30",
                                                       "2.5", "17", "65535",      "5121"};
    text.replace(digits[random.below(digits.size())], 1, replacements[random.below(replacements.size())]);
  } else {
    auto json = nlohmann::ordered_json::parse(text);
    auto* at = &json;
    while (at->is_structured() && !at->empty() && random.below(6) != 0) {
      auto next = at->begin();
      std::advance(next, static_cast<std::ptrdiff_t>(random.below(at->size())));
      if (!next->is_structured()) {
        at->erase(next);
        break;
      }
      at = &*next;
    }
    text = json.dump();
  }
  return apply_fixture::glb_of(text, binary);
}

}  // namespace

TEST_CASE("every gallery model can be exported") {
  Tally whole;
  for (const GalleryModel& model : gallery_models()) open_and_export(build(model)->glb, {}, model.id, whole);
  CHECK(whole.refused == 0);
}

TEST_CASE("2,000 damaged models can be exported as far as they open") {
  const std::vector<std::string> models{small_table().bytes(), odd_table(), table_of_text()};
  Tally whole, damaged;
  for (const std::string& model : models) open_and_export(model, {}, "undamaged", whole);
  CHECK(whole.opened == models.size());
  Random random(20240917);
  for (int round = 0; round < 2000; ++round) {
    const std::string& model = models[random.below(models.size())];
    open_and_export(mutated(model, random), {}, "mutation " + std::to_string(round), damaged);
  }
  CHECK(damaged.opened > 500);
  CHECK(damaged.refused > 200);
}

TEST_CASE("the fixtures of the Khronos validator are refused in the same words, or exported") {
  Tally tally;
  for (const auto& path : test::real_models("khronos-validator")) {
    const std::string bytes = test::read_bytes(path);
    open_and_export(bytes, buffers_beside(path, bytes), path.filename().string(), tally);
  }
}

TEST_CASE("models that once opened and could not be exported, or lost what hangs on their parts") {
  Tally tally;
  for (const auto& path : test::real_models("hunt")) {
    open_and_export(test::read_bytes(path), {}, path.filename().string(), tally);
  }
  CHECK(tally.refused == 0);
}

TEST_CASE("normals that cannot follow are named when the model is opened and when it is exported") {
  Glb glb;
  const Vec3 low(-1, -1, -1), high(1, 1, 1);
  const std::size_t position = glb.vectors(apply_fixture::grid(low, high, 1));
  const std::size_t normal = glb.vectors({Vec3::UnitX(), Vec3::UnitY()}, false);
  glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                               {"indices", glb.indices({0, 1, 2, 1, 2, 3, 4, 5, 6})}})}});
  const std::string bytes = glb.bytes();
  const auto model = abstract_shape(bytes, "box");
  REQUIRE(model.ok());
  const auto names_it = [](const Warning& w) {
    return w.text.starts_with("its NORMAL stays as it is when it is edited");
  };
  const auto opened = std::find_if(model->shape.warnings.begin(), model->shape.warnings.end(), names_it);
  REQUIRE(opened != model->shape.warnings.end());
  const auto out = apply_program(bytes, model->shape, small_program(model->shape, true), {1});
  REQUIRE(out.ok());
  REQUIRE(out->warnings.size() == 1);
  CHECK(out->warnings[0].text == opened->text);
  CHECK(apply_fixture::attribute(out->glb, 0, "NORMAL")[0] == Vec3(Vec3::UnitX()));
}

TEST_CASE("a part that cannot be edited is named alike when the model is opened and when it is exported") {
  Glb glb = small_table();
  SUBCASE("bound to a skeleton") {
    glb.json["nodes"][0]["skin"] = 0;
    glb.json["skins"] = {{{"joints", {3}}}};
  }
  SUBCASE("instanced") {
    glb.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 0;
  }
  SUBCASE("flat") {
    glb.json["nodes"][0]["scale"] = {1, 0, 1};
  }
  const auto model = abstract_shape(glb.bytes(), "table");
  REQUIRE(model.ok());
  REQUIRE(model->shape.parts[PartIndex(0)].node == 0);
  const auto out = apply_program(glb.bytes(), model->shape, small_program(model->shape, true), {1});
  REQUIRE(out.ok());
  REQUIRE(out->warnings.size() == 1);
  CHECK(std::any_of(model->shape.warnings.begin(), model->shape.warnings.end(),
                    [&](const Warning& w) { return w.place == "node 0" && w.text == out->warnings[0].text; }));
}

TEST_CASE("data URIs may be percent-encoded, a first buffer may be missing, chunks may come twice") {
  Glb glb;
  const std::size_t position = glb.vectors(apply_fixture::grid(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1));
  glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", position}}},
                               {"indices", glb.indices({0, 1, 2, 1, 2, 3, 4, 5, 6})}})}});
  const auto stretched = [](const std::string& bytes) {
    const auto model = abstract_shape(bytes, "box");
    REQUIRE_MESSAGE(model.ok(), (model.ok() ? "" : model.error().message()));
    const auto out = apply_program(bytes, model->shape, small_program(model->shape, true), {1});
    REQUIRE_MESSAGE(out.ok(), (out.ok() ? "" : out.error().message()));
    return out->glb;
  };
  auto json = glb.json;
  std::string encoded = "data:application/octet-stream,";
  for (const char c : glb.binary) {
    static const char digits[] = "0123456789abcdef";
    encoded += {'%', digits[static_cast<unsigned char>(c) >> 4], digits[static_cast<unsigned char>(c) & 15]};
  }
  json["buffers"] = {{{"byteLength", glb.binary.size()}, {"uri", encoded}}};
  const std::string plain = stretched(json.dump());
  CHECK(apply_fixture::attribute(plain, 0, "POSITION")[0][0] < -1);

  json["buffers"] = {{{"byteLength", 4}, {"uri", "elsewhere.bin"}}, json["buffers"][0]};
  for (auto& view : json["bufferViews"]) view["buffer"] = 1;
  const std::string without = stretched(json.dump());
  CHECK(apply_fixture::furthest(apply_fixture::attribute(without, 0, "POSITION"),
                                apply_fixture::attribute(plain, 0, "POSITION")) == 0);

  std::string twice = glb.bytes();
  apply_fixture::put_u32(twice, 4);
  twice += "JSON    ";
  std::string length;
  apply_fixture::put_u32(length, twice.size());
  twice.replace(8, 4, length);
  CHECK(stretched(twice).ends_with("JSON    "));
}

TEST_CASE("a primitive that Draco holds as well is edited, and the compressed copy goes") {
  Glb glb;
  const std::size_t position = glb.vectors(apply_fixture::grid(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1));
  ordered_json primitive{{"attributes", {{"POSITION", position}}},
                         {"indices", glb.indices({0, 1, 2, 1, 2, 3, 4, 5, 6})}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", glb.view(std::vector<float>{0})},
                                                           {"attributes", {{"POSITION", 0}}}};
  glb.node({{"mesh", glb.mesh(primitive)}});
  glb.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  const auto model = abstract_shape(glb.bytes(), "box");
  REQUIRE(model.ok());
  const auto out = apply_program(glb.bytes(), model->shape, small_program(model->shape, true), {1});
  REQUIRE(out.ok());
  const auto json = apply_fixture::json_of(out->glb);
  CHECK_FALSE(json["meshes"][0]["primitives"][0].contains("extensions"));
  CHECK_FALSE(json.contains("extensionsUsed"));

  glb.json["accessors"][position].erase("bufferView");
  const auto refused = abstract_shape(glb.bytes(), "box");
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().cause.find("KHR_draco_mesh_compression") != std::string::npos);
  CHECK(refused.error().fix.find("decompress") != std::string::npos);
}
