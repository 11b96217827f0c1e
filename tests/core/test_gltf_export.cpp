// What opens can be exported: the importer and the exporter ask the same reader, so no file is accepted by one and
// refused by the other.
#include <doctest/doctest.h>

#include "core/base/random.h"
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

TEST_CASE("every gallery model can be exported, and 2,000 damaged copies can as far as they open") {
  std::vector<std::string> models;
  Tally whole, damaged;
  for (const GalleryModel& model : gallery_models()) {
    models.push_back(build(model)->glb);
    open_and_export(models.back(), {}, model.id, whole);
  }
  CHECK(whole.refused == 0);
  Random random(20240917);
  for (int round = 0; round < 2000; ++round) {
    const std::size_t model = random.below(models.size());
    open_and_export(mutated(models[model], random), {}, "mutation " + std::to_string(round), damaged);
  }
  MESSAGE("opened " << damaged.opened << ", refused " << damaged.refused);
  CHECK(damaged.opened > 500);
  CHECK(damaged.refused > 200);
}

TEST_CASE("every fixture of the Khronos validator that opens can be exported") {
  Tally tally;
  for (const auto& path : test::real_models("khronos-validator")) {
    const std::string bytes = test::read_bytes(path);
    open_and_export(bytes, buffers_beside(path, bytes), path.filename().string(), tally);
  }
  if (tally.opened + tally.refused > 0) CHECK(tally.opened > 20);
}

TEST_CASE("damaged models that once opened and could not be exported") {
  Tally tally;
  for (const auto& path : test::real_models("hunt/mutated")) {
    open_and_export(test::read_bytes(path), {}, path.filename().string(), tally);
  }
}

TEST_CASE("normals that cannot follow are named when the model is opened and when it is exported") {
  apply_fixture::Glb glb;
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

TEST_CASE("data URIs may be percent-encoded, a first buffer may be missing, chunks may come twice") {
  apply_fixture::Glb glb;
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
  apply_fixture::Glb glb;
  const std::size_t position = glb.vectors(apply_fixture::grid(Vec3(-1, -1, -1), Vec3(1, 1, 1), 1));
  apply_fixture::ordered_json primitive{{"attributes", {{"POSITION", position}}},
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
