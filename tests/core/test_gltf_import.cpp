#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <string>

#include "core/base/uri.h"
#include "core/shape/abstraction.h"
#include "core/shape/gltf_import.h"
#include "tests/core/glb_fixture.h"
#include "tests/core/real_models.h"
#include "tests/core/tests_folder.h"

using namespace parsel;
using nlohmann::json;

namespace {

/// The refusal of a document after a change, "" when it is read.
std::string refusal(const std::function<void(fixture::Document&)>& change) {
  fixture::Document d = fixture::document(fixture::table());
  change(d);
  const Result<ImportedModel> model = import_gltf(d.glb());
  return model.ok() ? "" : model.error().message();
}

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

}  // namespace

TEST_CASE("a GLB becomes one part a primitive, in the normalised frame, with its labels") {
  const Result<ImportedModel> model = import_gltf(fixture::model(fixture::table(1.2, 0.8)));
  REQUIRE(model.ok());
  CHECK(model->meshes.size() == 5);
  CHECK(model->warnings.empty());
  CHECK(model->meshes[PartIndex(0)].label == "top");
  CHECK(model->meshes[PartIndex(0)].triangles.size() == 12);
  CHECK(model->frame.scale == doctest::Approx(Vec3(0.6, 0.37, 0.4).norm()));
  double furthest = 0;
  for (const PartMesh& mesh : model->meshes) {
    for (const Vec3& p : mesh.positions) furthest = std::max(furthest, p.norm());
  }
  CHECK(furthest == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("buffers may be data URIs or external files, with names that are percent-encoded") {
  fixture::Document d = fixture::document(fixture::table());
  const auto inside = import_gltf(d.glb());
  REQUIRE(inside.ok());
  d.json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64_encode(d.binary);
  const auto embedded = import_gltf(d.json.dump());
  REQUIRE(embedded.ok());
  CHECK(embedded->meshes[PartIndex(3)].positions == inside->meshes[PartIndex(3)].positions);

  d.json["buffers"][0]["uri"] = "my%20table.bin";
  const std::string text = d.json.dump();
  CHECK(external_buffer_uris(text) == std::vector<std::string>{"my table.bin"});
  const auto external = import_gltf(text, {{"my table.bin", d.binary}});
  REQUIRE(external.ok());
  CHECK(external->meshes[PartIndex(3)].positions == inside->meshes[PartIndex(3)].positions);
  const auto missing = import_gltf(text);
  REQUIRE_FALSE(missing.ok());
  CHECK(contains(missing.error().message(), "my%20table.bin"));
}

TEST_CASE("nodes place their meshes, share them, and lend their names before mesh and material") {
  fixture::Document d = fixture::document({{"a", fixture::box({0, 0, 0}, {1, 1, 1})}});
  d.json["nodes"] = {
      {{"name", "root"}, {"translation", {10, 0, 0}}, {"children", {1, 2, 3}}},
      {{"mesh", 0}, {"scale", {1, 2, 1}}, {"extras", {{"label", "pillar"}}}},
      {{"mesh", 0}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {"translation", {0, 5, 0}}},
      {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -5, 0, 1}}, {"name", "base.002"}}};
  d.json["scenes"][0]["nodes"] = {0};
  d.json["meshes"][0]["name"] = "block";
  const auto model = import_gltf(d.glb());
  REQUIRE(model.ok());
  REQUIRE(model->meshes.size() == 3);
  CHECK(model->meshes[PartIndex(0)].label == "pillar");
  CHECK(model->meshes[PartIndex(1)].label == "block");
  CHECK(model->meshes[PartIndex(2)].label == "base");
  const auto centre = [&](std::size_t i) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : model->meshes[PartIndex(i)].positions) sum += p / 8;
    return model->frame.to_model(sum);
  };
  CHECK((centre(0) - Vec3(10, 0, 0)).norm() < 1e-9);
  CHECK((centre(1) - Vec3(10, 5, 0)).norm() < 1e-9);
  CHECK((centre(2) - Vec3(10, -5, 0)).norm() < 1e-9);
  CHECK(model->meshes[PartIndex(2)].node == 3);
  CHECK((model->meshes[PartIndex(2)].world.topRightCorner<3, 1>() - Vec3(10, -5, 0)).norm() < 1e-12);
}

TEST_CASE("quantised, normalised, sparse and absent positions, strips, fans and missing indices are read") {
  fixture::Document d;
  // A quad of four normalised shorts, stride 8, as a strip and as a fan, then one with a sparse fourth corner.
  for (const auto& [x, y] : {std::pair{0, 0}, {32767, 0}, {0, 32767}, {32767, 32767}}) {
    d.binary += std::string{static_cast<char>(x & 255),
                            static_cast<char>(x >> 8),
                            static_cast<char>(y & 255),
                            static_cast<char>(y >> 8),
                            0,
                            0,
                            0,
                            0};
  }
  d.binary += std::string{3, 0, 0, 0};                // sparse index
  d.binary += std::string{0, 64, 0, 64, 0, 0, 0, 0};  // sparse value (0.5, 0.5, 0)
  const json accessor = {
      {"bufferView", 0}, {"componentType", 5122}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}};
  json sparse = accessor;
  sparse["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", 1}, {"componentType", 5121}}}, {"values", {{"bufferView", 2}}}};
  d.json = {{"asset", {{"version", "2.0"}}},
            {"extensionsRequired", {"KHR_mesh_quantization"}},
            {"nodes", {{{"mesh", 0}}}},
            {"meshes",
             {{{"primitives",
                {{{"attributes", {{"POSITION", 0}}}, {"mode", 5}},
                 {{"attributes", {{"POSITION", 0}}}, {"mode", 6}},
                 {{"attributes", {{"POSITION", 1}}}, {"mode", 5}},
                 {{"attributes", {{"POSITION", 2}}}, {"mode", 5}}}}}}},
            {"accessors", {accessor, sparse, {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
            {"bufferViews",
             {{{"buffer", 0}, {"byteLength", 32}, {"byteStride", 8}},
              {{"buffer", 0}, {"byteOffset", 32}, {"byteLength", 4}},
              {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 8}}}},
            {"buffers", {{{"byteLength", 44}}}}};
  const auto model = import_gltf(d.glb());
  REQUIRE_MESSAGE(model.ok(), (model.ok() ? "" : model.error().message()));
  CHECK(model->warnings.empty());
  REQUIRE(model->meshes.size() == 4);
  CHECK(model->meshes[PartIndex(0)].triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  CHECK(model->meshes[PartIndex(1)].triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK((model->frame.to_model(model->meshes[PartIndex(0)].positions[3]) - Vec3(1, 1, 0)).norm() < 1e-9);
  CHECK((model->frame.to_model(model->meshes[PartIndex(2)].positions[3]) - Vec3(0.5, 0.5, 0)).norm() < 1e-4);
  // An accessor without a bufferView is all zeros.
  for (const Vec3& p : model->meshes[PartIndex(3)].positions) CHECK(model->frame.to_model(p).norm() < 1e-12);
}

TEST_CASE("what is sound but not read is named in a warning") {
  fixture::Document d = fixture::document(fixture::table());
  auto& meshes = d.json["meshes"];
  meshes[1]["primitives"][0]["mode"] = 1;
  meshes[2]["primitives"][0]["extensions"] = {{"KHR_draco_mesh_compression", {{"bufferView", 0}}}};
  d.json["accessors"][4].erase("bufferView");
  d.json["bufferViews"][6]["extensions"] = {{"EXT_meshopt_compression", {{"buffer", 1}}}};
  d.json["bufferViews"][6]["buffer"] = 1;
  d.json["buffers"].push_back({{"byteLength", 1000}});
  d.json["nodes"][4]["skin"] = 0;
  meshes[4]["primitives"][0]["targets"] = json::array({{{"POSITION", 0}}});
  d.json["extensionsRequired"] = {"VENDOR_unheard_of", "KHR_materials_unlit"};
  const auto model = import_gltf(d.glb());
  REQUIRE_MESSAGE(model.ok(), (model.ok() ? "" : model.error().message()));
  CHECK(model->meshes.size() == 2);
  std::string all;
  for (const Warning& w : model->warnings) all += w.place + ": " + w.text + "\n";
  for (const char* name : {"lines", "KHR_draco_mesh_compression", "EXT_meshopt_compression", "skin", "morph targets",
                           "VENDOR_unheard_of"}) {
    CHECK_MESSAGE(contains(all, name), name);
  }
  CHECK_FALSE(contains(all, "unlit"));
}

TEST_CASE("hidden nodes, and all below them, are no parts and are named") {
  fixture::Document d = fixture::document(fixture::table());
  const std::size_t parts = import_gltf(d.glb())->meshes.size();
  d.json["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = false;
  d.json["nodes"][1]["children"] = {2};
  json& roots = d.json["scenes"][0]["nodes"];
  roots.erase(std::find(roots.begin(), roots.end(), json(2)));
  d.json["extensionsRequired"] = {"KHR_node_visibility"};
  const auto model = import_gltf(d.glb());
  REQUIRE(model.ok());
  CHECK(model->meshes.size() == parts - 2);
  REQUIRE(model->warnings.size() == 1);
  CHECK(model->warnings[0].place == "node 1");
  CHECK(contains(model->warnings[0].text, "it and what is below it are hidden"));
}

TEST_CASE("one part, and a place far from the origin, are warned of") {
  const auto one = import_gltf(fixture::model({{"a", fixture::box({0, 0, 0}, {1, 1, 1})}}));
  REQUIRE(one.ok());
  REQUIRE(one->warnings.size() == 1);
  CHECK(contains(one->warnings[0].text, "one part"));

  fixture::Document d = fixture::document(fixture::table());
  CHECK(import_gltf(d.glb())->warnings.empty());
  for (json& node : d.json["nodes"]) node["translation"] = {1e6, 0, 0};
  const auto far = import_gltf(d.glb());
  REQUIRE(far.ok());
  REQUIRE(far->warnings.size() == 1);
  CHECK(contains(far->warnings[0].text, "from its origin"));
}

TEST_CASE("damage is refused by name") {
  CHECK(refusal([](auto&) {}) == "");
  const auto views = [](auto& d) -> json& { return d.json["bufferViews"]; };
  const auto accessors = [](auto& d) -> json& { return d.json["accessors"]; };
  CHECK(contains(refusal([&](auto& d) { accessors(d)[0]["count"] = 9000; }), "accessor 0"));
  CHECK(contains(refusal([&](auto& d) { accessors(d)[0]["count"] = 2147483647; }), "vertices"));
  CHECK(contains(refusal([&](auto& d) { accessors(d)[0]["count"] = -1; }), "accessor 0: count"));
  CHECK(contains(refusal([&](auto& d) { accessors(d)[0]["byteOffset"] = 1 << 30; }), "beyond bufferView"));
  CHECK(contains(refusal([&](auto& d) { accessors(d)[0]["byteOffset"] = "4"; }), "byteOffset"));
  CHECK(contains(refusal([&](auto& d) { accessors(d)[0]["type"] = "VEC2"; }), "VEC3"));
  CHECK(contains(refusal([&](auto& d) { accessors(d)[1]["componentType"] = 5126; }), "indices"));
  CHECK(contains(refusal([&](auto& d) { accessors(d)[1]["bufferView"] = 77; }), ""));
  CHECK(contains(refusal([&](auto& d) { views(d)[0]["byteLength"] = 100000; }), "bufferView 0"));
  CHECK(contains(refusal([&](auto& d) { views(d)[0]["byteStride"] = 4; }), "byteStride"));
  CHECK(contains(refusal([&](auto& d) { views(d)[0]["buffer"] = 3; }), "buffer 3"));
  CHECK(contains(refusal([&](auto& d) { d.json["buffers"][0]["byteLength"] = 1 << 30; }), "buffer 0"));
  CHECK(contains(refusal([&](auto& d) { d.json["nodes"][0]["mesh"] = 5; }), "mesh 5"));
  CHECK(contains(refusal([&](auto& d) { d.json["nodes"][0]["children"] = {0}; }), "contains itself"));
  CHECK(contains(refusal([&](auto& d) { d.json["nodes"][0]["children"] = {99}; }), "node 99"));
  CHECK(contains(refusal([&](auto& d) { d.json["nodes"][0]["scale"] = {1, 2}; }), "scale"));
  CHECK(contains(refusal([&](auto& d) { d.json["nodes"][0]["rotation"] = {0, 0, 0, 0}; }), "rotation"));
  CHECK(contains(refusal([&](auto& d) { d.json["scene"] = 4; }), "scene 4"));
  CHECK(contains(refusal([&](auto& d) { d.json["asset"]["version"] = "1.0"; }), "2.x"));
  CHECK(contains(refusal([&](auto& d) { d.json.erase("asset"); }), "asset"));
  CHECK(contains(refusal([&](auto& d) { d.json["scenes"][0]["nodes"] = json::array(); }), "no triangle mesh"));
  CHECK(contains(refusal([&](auto& d) { d.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = -1; }),
                 "POSITION"));
  // An index beyond the vertices.
  CHECK(contains(refusal([&](auto& d) { accessors(d)[0]["count"] = 4; }), "out of range"));
  CHECK_FALSE(import_gltf("").ok());
  CHECK_FALSE(import_gltf("solid cube").ok());
  CHECK_FALSE(import_gltf("[]").ok());
  CHECK(contains(import_gltf(std::string(100000, '[')).error().message(), "nested"));
  CHECK(contains(import_gltf("{\"a\":\"" + std::string(1, '\xff') + "\"}").error().message(), "JSON"));
}

TEST_CASE("triangles with positions that are no numbers are left out with a warning") {
  auto parts = fixture::table();
  parts[0].mesh.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
  for (Vec3& p : parts[1].mesh.positions) p.x() = std::numeric_limits<double>::infinity();
  const auto model = import_gltf(fixture::model(parts));
  REQUIRE(model.ok());
  CHECK(model->meshes.size() == 4);
  CHECK(model->meshes[PartIndex(0)].triangles.size() < 12);
  CHECK(model->warnings.size() == 3);
  for (const PartMesh& mesh : model->meshes) {
    for (const Triangle& t : mesh.triangles) {
      for (const std::uint32_t v : t) CHECK(mesh.positions[v].allFinite());
    }
  }
}

TEST_CASE("every truncation and every lying length of a GLB ends in a named error") {
  const std::string whole = fixture::model({{"a", fixture::box({0, 0, 0}, {1, 1, 1})}});
  REQUIRE(import_gltf(whole).ok());
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const auto cut = import_gltf(whole.substr(0, length));
    REQUIRE_MESSAGE(!cut.ok(), length);
    REQUIRE(!cut.error().cause.empty());
    // The same with a header that admits the new length: then a chunk, the JSON or a buffer is short.
    if (length < 12) continue;
    std::string honest = whole.substr(0, length);
    for (std::size_t i = 0; i < 4; ++i) honest[8 + i] = static_cast<char>(length >> (8 * i) & 0xff);
    REQUIRE_FALSE(import_gltf(honest).ok());
  }
  for (const std::size_t at : {std::size_t{8}, std::size_t{12}}) {
    for (const int byte : {0x00, 0x01, 0x7f, 0xff}) {
      std::string lie = whole;
      for (std::size_t i = 0; i < 4; ++i) lie[at + i] = static_cast<char>(byte);
      CHECK_FALSE(import_gltf(lie).ok());
    }
  }
}

TEST_CASE("ten thousand nodes, side by side or in one chain, are read; too many parts are refused") {
  fixture::Document d = fixture::document({{"a", fixture::box({0, 0, 0}, {1, 1, 1})}});
  json nodes = json::array();
  for (int i = 0; i < 10000; ++i) nodes.push_back({{"name", "n"}, {"children", {i + 1}}});
  nodes.push_back({{"name", "leaf"}, {"mesh", 0}});
  d.json["nodes"] = nodes;
  d.json["scenes"][0]["nodes"] = {0};
  const auto chain = import_gltf(d.glb());
  REQUIRE(chain.ok());
  CHECK(chain->meshes.size() == 1);

  json flat = json::array(), roots = json::array();
  for (int i = 0; i < 10000; ++i) {
    flat.push_back({{"mesh", 0}, {"translation", {2 * i, 0, 0}}});
    roots.push_back(i);
  }
  d.json["nodes"] = flat;
  d.json["scenes"][0]["nodes"] = roots;
  const auto many = import_gltf(d.glb());
  REQUIRE_FALSE(many.ok());
  CHECK(contains(many.error().message(), "parts"));
}

TEST_CASE("the fuzzer's corpus is read or refused") {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::tests_folder() + "/fuzz/corpus/gltf_import")) {
    const Result<Abstraction> abstraction = abstract_shape(test::read_bytes(entry.path()), "corpus");
    if (abstraction.ok()) CHECK_MESSAGE(validate(abstraction->shape).ok(), entry.path().string());
    ++files;
  }
  CHECK(files > 0);
}

TEST_CASE("every file of the Khronos validator's tests is read or refused by name") {
  const auto paths = test::real_models("khronos-validator");
  if (paths.empty()) return;
  std::size_t read_files = 0, refused = 0;
  for (const auto& path : paths) {
    const std::string bytes = test::read_bytes(path);
    ExternalBuffers buffers;
    for (const std::string& uri : external_buffer_uris(bytes)) {
      const auto file = path.parent_path() / uri;
      std::error_code error;
      if (std::filesystem::is_regular_file(file, error)) buffers[uri] = test::read_bytes(file);
    }
    const Result<Abstraction> abstraction = abstract_shape(bytes, path.stem().string(), buffers);
    if (abstraction.ok()) {
      ++read_files;
      const Status sound = validate(abstraction->shape);
      CHECK_MESSAGE(sound.ok(), path.string());
    } else {
      ++refused;
      CHECK_MESSAGE(!abstraction.error().cause.empty(), path.string());
    }
  }
  MESSAGE("read " << read_files << ", refused " << refused);
  CHECK(read_files + refused > 300);
}
