// Accessors that are shared, interleaved, sparse, quantised or outside of the binary chunk.
#include <doctest/doctest.h>

#include "core/base/uri.h"
#include "tests/core/apply_fixture.h"

using namespace parsel;
using namespace parsel::apply_fixture;

namespace {

const Vec3 low(-1, -1, -1), high(1, 1, 1);

State moved(const Shape& shape, std::size_t part, const Vec3& by) {
  State state = resting(shape);
  state.parts[PartIndex(part)].rowwise() += by.transpose();
  return state;
}

std::vector<Vec3> shifted(std::vector<Vec3> points, const Vec3& by) {
  for (Vec3& p : points) p += by;
  return points;
}

std::string applied(const std::string& file, const Shape& shape, const State& state) {
  const auto out = apply_state(file, shape, state);
  REQUIRE_MESSAGE(out.ok(), (out.ok() ? "" : out.error().message()));
  CHECK(bounds_hold(out->glb));
  return out->glb;
}

}  // namespace

TEST_CASE("apply: nodes that share a mesh part when their edits differ") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(low, high);
  const std::size_t mesh = glb.mesh({{"attributes", {{"POSITION", glb.vectors(points)}}}, {"material", 0}});
  glb.json["materials"] = {{{"name", "oak"}}};
  for (int i = 0; i < 4; ++i) {
    const Vec3 at(3 * i, 0, 0);
    glb.node({{"name", "leg"}, {"mesh", mesh}, {"translation", {at[0], at[1], at[2]}}});
    add_part(shape, static_cast<std::size_t>(i), box(low + at, high + at));
  }
  const std::string file = glb.bytes();

  SUBCASE("one is edited: it gets a mesh of its own") {
    const std::string out = applied(file, shape, moved(shape, 2, Vec3(0, 0.5, 0)));
    const ordered_json json = json_of(out);
    CHECK(json["meshes"].size() == 2);
    CHECK(json["nodes"][2]["mesh"] == 1);
    CHECK(json["meshes"][1]["primitives"][0]["material"] == 0);
    CHECK(attribute(out, 0, "POSITION") == points);
    CHECK(furthest(attribute(out, 2, "POSITION"), shifted(points, Vec3(0, 0.5, 0))) < 1e-6);
  }
  SUBCASE("all are edited alike: they go on sharing, in place") {
    State state = resting(shape);
    for (Corners& corners : state.parts) corners.col(1) *= 1.5;
    const std::string out = applied(file, shape, state);
    CHECK(out.size() < file.size() + 8);
    CHECK(json_of(out)["nodes"] == glb.json["nodes"]);
    CHECK(json_of(out)["meshes"] == glb.json["meshes"]);
    CHECK(attribute(out, 3, "POSITION")[0][1] == -1.5);
  }
  SUBCASE("two and two: the first pair keeps the mesh") {
    State state = resting(shape);
    for (std::size_t i = 0; i < 4; ++i) state.parts[PartIndex(i)].col(1) *= i % 2 == 0 ? 1.5 : 0.5;
    const std::string out = applied(file, shape, state);
    const ordered_json json = json_of(out);
    CHECK(json["meshes"].size() == 2);
    CHECK(json["nodes"][0]["mesh"] == 0);
    CHECK(json["nodes"][1]["mesh"] == 1);
    CHECK(json["nodes"][2]["mesh"] == 0);
    CHECK(json["nodes"][3]["mesh"] == 1);
    CHECK(attribute(out, 2, "POSITION")[0][1] == -1.5);
    CHECK(attribute(out, 3, "POSITION")[0][1] == -0.5);
  }
  SUBCASE("a node outside of the scene keeps the mesh that it had") {
    glb.json["nodes"].push_back({{"mesh", mesh}});
    State state = resting(shape);
    for (Corners& corners : state.parts) corners.col(1) *= 1.5;
    const std::string out = applied(glb.bytes(), shape, state);
    CHECK(attribute(out, 4, "POSITION") == points);
    CHECK(json_of(out)["meshes"].size() == 2);
  }
}

TEST_CASE("apply: primitives that share a vertex buffer without sharing vertices are patched in place") {
  Glb glb;
  Shape shape;
  std::vector<Vec3> points = grid(low, high), second = shifted(points, Vec3(5, 0, 0));
  points.insert(points.end(), second.begin(), second.end());
  const std::size_t position = glb.vectors(points);
  std::vector<std::uint16_t> a, b;
  for (std::uint16_t i = 0; i < 27; ++i) {
    a.push_back(i);
    b.push_back(static_cast<std::uint16_t>(27 + i));
  }
  ordered_json primitives;
  bool disjoint = true;
  SUBCASE("disjoint") {}
  SUBCASE("with a vertex in common") {
    disjoint = false;
    b.push_back(26);
  }
  primitives.push_back({{"attributes", {{"POSITION", position}}}, {"indices", glb.indices(a)}});
  primitives.push_back({{"attributes", {{"POSITION", position}}}, {"indices", glb.indices(b)}});
  glb.json["meshes"].push_back({{"primitives", primitives}});
  glb.node({{"mesh", 0}});
  add_part(shape, 0, box(low, high), 0);
  add_part(shape, 0, box(low + Vec3(5, 0, 0), high + Vec3(5, 0, 0)), 1);
  State state = moved(shape, 1, Vec3(0, 2, 0));
  state.parts[PartIndex(0)].rowwise() += Vec3(0, -1, 0).transpose();
  const std::string out = applied(glb.bytes(), shape, state);
  CHECK((json_of(out)["accessors"].size() == 3) == disjoint);
  const std::vector<Vec3> first = attribute(out, 0, "POSITION", 0), other = attribute(out, 0, "POSITION", 1);
  CHECK((first == other) == disjoint);
  for (const std::uint16_t i : a) CHECK((first[i] - points[i] - Vec3(0, -1, 0)).norm() < 1e-6);
  for (const std::uint16_t i : b) CHECK((other[i] - points[i] - Vec3(0, 2, 0)).norm() < 1e-6);
}

TEST_CASE("apply: one accessor in two roles is split") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(low, high, 1);
  const std::size_t position = glb.vectors(points);
  glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", position}, {"_REST", position}}}})}});
  add_part(shape, 0, box(low, high));
  const std::string out = applied(glb.bytes(), shape, moved(shape, 0, Vec3(1, 0, 0)));
  CHECK(attribute(out, 0, "_REST") == points);
  CHECK(attribute(out, 0, "POSITION") == shifted(points, Vec3(1, 0, 0)));
}

TEST_CASE("apply: interleaved data is patched in place and its neighbours are left alone") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(low, high, 1);
  std::vector<float> data;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int c = 0; c < 3; ++c) data.push_back(static_cast<float>(points[i][c]));
    for (int c = 0; c < 3; ++c) data.push_back(static_cast<float>(100 * i));  // an attribute of somebody's own
  }
  const std::size_t view = glb.view(data);
  glb.json["bufferViews"][view]["byteStride"] = 24;
  glb.json["accessors"] = {
      {{"bufferView", view},
       {"componentType", 5126},
       {"count", 8},
       {"type", "VEC3"},
       {"min", {-1, -1, -1}},
       {"max", {1, 1, 1}}},
      {{"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 8}, {"type", "VEC3"}}};
  glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", 0}, {"_OWN", 1}}}})}});
  add_part(shape, 0, box(low, high));
  const std::string file = glb.bytes();
  std::string out = applied(file, shape, moved(shape, 0, Vec3(0.25, 0, 0)));
  CHECK(json_of(out)["bufferViews"] == glb.json["bufferViews"]);
  CHECK(attribute(out, 0, "_OWN") == attribute(file, 0, "_OWN"));
  CHECK(attribute(out, 0, "POSITION") == shifted(points, Vec3(0.25, 0, 0)));

  // When the neighbour reads the same bytes, the position moves out instead.
  glb.json["accessors"][1]["byteOffset"] = 8;
  const std::string aliased = glb.bytes();
  out = applied(aliased, shape, moved(shape, 0, Vec3(0.25, 0, 0)));
  CHECK(json_of(out)["bufferViews"].size() == 2);
  CHECK(attribute(out, 0, "_OWN") == attribute(aliased, 0, "_OWN"));
  CHECK(attribute(out, 0, "POSITION") == shifted(points, Vec3(0.25, 0, 0)));
}

TEST_CASE("apply: sparse and implicit data becomes plain") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(low, high, 1);
  std::vector<float> values;
  for (std::size_t i = 4; i < 8; ++i) {
    for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(points[i][c]));
  }
  std::vector<Vec3> rest = points;
  ordered_json accessor{{"componentType", 5126}, {"count", 8},       {"type", "VEC3"},
                        {"min", {-1, -1, -1}},   {"max", {1, 1, 1}}, {"name", "kept"}};
  accessor["sparse"] = {
      {"count", 4},
      {"indices", {{"bufferView", glb.view(std::vector<std::uint16_t>{4, 5, 6, 7})}, {"componentType", 5123}}},
      {"values", {{"bufferView", glb.view(values)}}}};
  for (std::size_t i = 0; i < 4; ++i) rest[i] = Vec3::Zero();
  glb.json["accessors"].push_back(accessor);
  glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", 0}}}})}});
  add_part(shape, 0, box(low, high));
  const std::string out = applied(glb.bytes(), shape, moved(shape, 0, Vec3(0, 0, 3)));
  CHECK(attribute(out, 0, "POSITION") == shifted(rest, Vec3(0, 0, 3)));
  const ordered_json after = json_of(out)["accessors"][0];
  CHECK_FALSE(after.contains("sparse"));
  CHECK(after["name"] == "kept");
  CHECK(after["bufferView"] == 2);
}

TEST_CASE("apply: quantised positions become floats in the same accessor") {
  Glb glb;
  Shape shape;
  std::vector<std::int16_t> shorts;
  for (const Vec3& p : grid(low, high, 1)) {
    for (int c = 0; c < 3; ++c) shorts.push_back(static_cast<std::int16_t>(32767 * p[c]));
    shorts.push_back(0);
  }
  const std::size_t view = glb.view(shorts);
  glb.json["bufferViews"][view]["byteStride"] = 8;
  glb.json["accessors"].push_back({{"bufferView", view},
                                   {"componentType", 5122},
                                   {"normalized", true},
                                   {"count", 8},
                                   {"type", "VEC3"},
                                   {"min", {-32767, -32767, -32767}},
                                   {"max", {32767, 32767, 32767}}});
  glb.json["extensionsUsed"] = glb.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", 0}}}})}, {"scale", {2, 2, 2}}});
  add_part(shape, 0, box(2 * low, 2 * high));
  const std::string out = applied(glb.bytes(), shape, moved(shape, 0, Vec3(1, 0, 0)));
  CHECK(furthest(attribute(out, 0, "POSITION"), shifted(grid(low, high, 1), Vec3(0.5, 0, 0))) < 1e-7);
  const ordered_json json = json_of(out);
  CHECK(json["accessors"][0]["componentType"] == 5126);
  CHECK(json["bufferViews"].size() == 1);  // the old view was nobody else's
  CHECK_FALSE(json["bufferViews"][0].contains("byteStride"));
}

TEST_CASE("apply: deltas of morph targets follow the cage") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(low, high), bumps(points.size(), Vec3(0, 0.1, 0));
  std::vector<Vec3> normals(points.size(), Vec3::UnitY()), turns(points.size(), Vec3(1, -1, 0));
  const std::size_t p = glb.vectors(points), n = glb.vectors(normals, false);
  const std::size_t dp = glb.vectors(bumps), dn = glb.vectors(turns, false);
  glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}},
                               {"targets", {{{"POSITION", dp}, {"NORMAL", dn}}}}})}});
  add_part(shape, 0, box(low, high));
  State state = resting(shape);
  state.parts[PartIndex(0)].col(1) *= 2;
  const std::string out = applied(glb.bytes(), shape, state);
  const gltf::File file = read(out);
  for (const Vec3& v : vectors(file, dp)) CHECK((v - Vec3(0, 0.2, 0)).norm() < 1e-6);
  // The target's normal (1,0,0) stays so under a scale along y, and so does the base normal.
  for (const Vec3& v : vectors(file, dn)) CHECK((v - Vec3(1, -1, 0)).norm() < 1e-6);
}

TEST_CASE("apply: a glTF with a data URI or a file beside it becomes a GLB") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(low, high, 1);
  glb.node({{"mesh", glb.mesh({{"attributes", {{"POSITION", glb.vectors(points)}}}})}});
  add_part(shape, 0, box(low, high));
  ordered_json json = glb.json;
  json["buffers"][0]["byteLength"] = glb.binary.size();
  json["images"] = {{{"uri", "wood%20grain.png"}}, {{"uri", "missing.png"}}};
  const State state = moved(shape, 0, Vec3(0, 1, 0));
  ApplyOptions options;
  options.external["wood grain.png"] = "\x89PNG and more";

  json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64_encode(glb.binary);
  auto out = apply_state(json.dump(1), shape, state, options);
  REQUIRE(out.ok());
  CHECK(attribute(out->glb, 0, "POSITION") == shifted(points, Vec3(0, 1, 0)));
  CHECK_FALSE(json_of(out->glb)["buffers"][0].contains("uri"));
  CHECK(json_of(out->glb)["images"][0]["mimeType"] == "image/png");
  CHECK(json_of(out->glb)["images"][1]["uri"] == "missing.png");
  REQUIRE(out->warnings.size() == 1);
  CHECK(out->warnings[0].place == "image 1");

  json["buffers"][0]["uri"] = "mesh.bin";
  out = apply_state(json.dump(), shape, state, options);
  REQUIRE_FALSE(out.ok());
  CHECK(out.error().cause == "the file 'mesh.bin' is not there");
  options.external["mesh.bin"] = glb.binary;
  out = apply_state(json.dump(), shape, state, options);
  REQUIRE(out.ok());
  CHECK(attribute(out->glb, 0, "POSITION") == shifted(points, Vec3(0, 1, 0)));
}
