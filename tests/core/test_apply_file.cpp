// Files that are damaged or not what they claim to be: refused or read, never a crash (run under sanitizers).
#include <doctest/doctest.h>

#include "core/base/random.h"
#include "tests/core/apply_fixture.h"
#include "tests/core/real_models.h"

using namespace parsel;
using namespace parsel::apply_fixture;

namespace {

/// Everything that the patcher looks at, in one small file.
struct Everything {
  Glb glb;
  Shape shape;
  State state;

  Everything() {
    const Vec3 low(-1, -1, -1), high(1, 1, 1);
    const std::vector<Vec3> points = grid(low, high, 1);
    const std::size_t position = glb.vectors(points), normal = glb.vectors(points, false);
    const std::size_t indices = glb.indices({0, 1, 2, 3, 4, 5, 6, 7, 0});
    const std::size_t sparse = glb.json["accessors"].size();
    const ordered_json where{{"bufferView", glb.view(std::vector<std::uint16_t>{1, 7})}, {"componentType", 5123}};
    const std::size_t with = glb.view(std::vector<float>{1, 2, 3, 4, 5, 6});
    glb.json["accessors"].push_back(
        {{"componentType", 5126}, {"count", 8}, {"type", "VEC3"}, {"min", {0, 0, 0}}, {"max", {4, 5, 6}}});
    glb.json["accessors"][sparse]["sparse"] = {{"count", 2}, {"indices", where}, {"values", {{"bufferView", with}}}};
    const ordered_json primitive{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                                 {"indices", indices},
                                 {"targets", {{{"POSITION", sparse}}}}};
    const std::size_t mesh = glb.mesh(primitive);
    glb.node({{"mesh", mesh}, {"rotation", {0, 0, 1, 0}}});
    glb.node({{"mesh", mesh}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 0, 0, 1}}, {"name", "slat_1"}});
    add_part(shape, 0, box(low, high));
    add_part(shape, 1, box(low + Vec3(4, 0, 0), high + Vec3(4, 0, 0)));
    Relation group{"t1",
                   RelationKind::translation,
                   {PartIndex(0), PartIndex(1)},
                   Translation{PartIndex(0), Vec3::Zero(), Vec3::Zero(), 0, 1}};
    shape.relations.push_back(group);
    state = resting(shape);
    GroupState& changed = state.groups[RelationIndex(0)];
    changed.count_changed = true;
    changed.instances[1].rowwise() += Vec3(0, 1, 0).transpose();
    changed.instances.push_back(box(low + Vec3(8, 1, 0), high + Vec3(8, 1.5, 0)));
  }
};

}  // namespace

TEST_CASE("apply: a file cut off anywhere is refused") {
  const Everything model;
  const std::string file = model.glb.bytes();
  REQUIRE(apply_state(file, model.shape, model.state).ok());
  for (std::size_t length = 0; length < file.size(); length += length < 40 ? 1 : 7) {
    CHECK_FALSE(apply_state(file.substr(0, length), model.shape, model.state).ok());
  }
}

TEST_CASE("apply: a damaged file is refused or read, never a crash") {
  const Everything model;
  const std::string json = model.glb.json.dump();
  const std::string fixed = json_chunk(model.glb.bytes());
  Random random(7);
  std::size_t refused = 0;
  for (int round = 0; round < 200; ++round) {
    std::string text = fixed;
    // Change a number, which keeps the JSON valid and puts indices, counts and offsets out of range.
    std::vector<std::size_t> digits;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] >= '0' && text[i] <= '9') digits.push_back(i);
    }
    const std::size_t at = digits[random.below(digits.size())];
    static const std::vector<std::string> replacements{"9", "0", "4294967295", "-1", "1e300", "2.5", "17", "65535"};
    text.replace(at, 1, replacements[random.below(replacements.size())]);
    const auto out = apply_state(glb_of(text, model.glb.binary), model.shape, model.state);
    if (!out.ok()) {
      ++refused;
      CHECK_FALSE(out.error().cause.empty());
    } else {
      CHECK(gltf::read_file(out->glb, {}).ok());
    }
  }
  CHECK(refused > 25);
}

TEST_CASE("apply: hierarchies that are none are refused") {
  const Everything model;
  Glb glb = model.glb;
  SUBCASE("a cycle") {
    glb.json["nodes"][0]["children"] = {1};
    glb.json["nodes"][1]["children"] = {0};
  }
  SUBCASE("its own child") {
    glb.json["nodes"][0]["children"] = {0};
  }
  SUBCASE("two parents") {
    glb.json["nodes"].push_back({{"children", {0}}});
    glb.json["nodes"].push_back({{"children", {0}}});
  }
  SUBCASE("a child that is not there") {
    glb.json["nodes"][0]["children"] = {77};
  }
  SUBCASE("a root that is not there") {
    glb.json["scenes"][0]["nodes"] = {77};
  }
  SUBCASE("a part of another file") {
    glb.json["nodes"].erase(1);
  }
  CHECK_FALSE(apply_state(glb.bytes(), model.shape, model.state).ok());
}

TEST_CASE("apply: states that are not of the shape are refused") {
  const Everything model;
  const std::string file = model.glb.bytes();
  State state = model.state;
  state.parts = PartData<Corners>(1, Corners::Zero());
  CHECK_FALSE(apply_state(file, model.shape, state).ok());
  state = model.state;
  state.parts[PartIndex(0)](2, 2) = std::nan("");
  CHECK_FALSE(apply_state(file, model.shape, state).ok());
  state = resting(model.shape);
  state.parts[PartIndex(0)] *= 1e39;
  CHECK_FALSE(apply_state(file, model.shape, state).ok());
}

TEST_CASE("apply: the odd files of the Khronos validator are refused or pass through unchanged") {
  const auto paths = test::real_models("khronos-validator");
  if (paths.empty()) return;
  std::size_t files = 0, passed = 0;
  for (const auto& path : paths) {
    const std::string bytes = test::read_bytes(path);
    ++files;
    // Nodes 0 and 1 of whatever it is, edited.
    const Everything model;
    static_cast<void>(apply_state(bytes, model.shape, model.state));
    const auto out = apply_state(bytes, Shape{}, State{});
    if (!out.ok()) continue;
    ++passed;
    CHECK(out->glb.substr(0, 4) == "glTF");
    if (path.extension() == ".glb") CHECK(out->glb == bytes);
  }
  CHECK(files > 300);
  CHECK(passed > 100);
}
