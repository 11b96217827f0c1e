// What goes along with an edited part: everything below its node, pivots, levels of detail.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/export/apply_carry.h"
#include "tests/core/apply_fixture.h"

using namespace parsel;
using namespace parsel::apply_fixture;

namespace {

const Vec3 low(-1, -1, -1), high(1, 1, 1);

/// Node 0 is a part, node 1 an empty below it at (0.5, 1, 0), node 2 another part below it.
struct Lamp {
  Glb glb;
  Shape shape;
  std::vector<Vec3> points = grid(low, high, 1);

  Lamp() {
    const std::size_t mesh = glb.mesh({{"attributes", {{"POSITION", glb.vectors(points)}}}});
    glb.node({{"mesh", mesh}, {"children", {1, 2}}});
    glb.json["nodes"].push_back({{"name", "light"}, {"translation", {0.5, 1, 0}}});
    glb.json["nodes"].push_back({{"mesh", mesh}, {"translation", {0, 3, 0}}});
    add_part(shape, 0, box(low, high));
    add_part(shape, 2, box(low + Vec3(0, 3, 0), high + Vec3(0, 3, 0)));
  }
  /// The first part changed, the second at rest.
  template <class Function>
  Applied edited(const Function& function) const {
    State state = resting(shape);
    state.parts[PartIndex(0)] = mapped(state.parts[PartIndex(0)], function);
    auto out = apply_state(glb.bytes(), shape, state);
    REQUIRE_MESSAGE(out.ok(), (out.ok() ? "" : out.error().message()));
    return std::move(out).value();
  }
};

Eigen::Affine3d world(const std::string& glb, std::size_t node) {
  const gltf::File file = read(glb);
  return gltf::read_scene(file.original)->world[node];
}

std::vector<Vec3> moved(const std::vector<Vec3>& points, const Eigen::Affine3d& by) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) out.push_back(by * p);
  return out;
}

}  // namespace

TEST_CASE("apply: a rigid edit is the place of its node; what hangs below follows, other parts stay") {
  const Lamp model;
  Eigen::Affine3d by = Eigen::Affine3d::Identity();
  SUBCASE("translated") {
    by.translate(Vec3(0.25, 0.5, -1));
  }
  SUBCASE("turned") {
    by.translate(Vec3(0.25, 0, 0)).rotate(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  }
  const std::string out = model.edited([&](const Vec3& p) { return by * p; }).glb;
  const ordered_json json = json_of(out);
  CHECK(json["accessors"] == model.glb.json["accessors"]);
  CHECK(json["nodes"][1] == model.glb.json["nodes"][1]);
  CHECK(furthest(world_positions(out, 0), moved(model.points, by)) < 1e-6);
  CHECK((world(out, 1).translation() - by * Vec3(0.5, 1, 0)).norm() < 1e-9);
  CHECK((world(out, 2).matrix() - world(model.glb.bytes(), 2).matrix()).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(furthest(world_positions(out, 2), world_positions(model.glb.bytes(), 2)) < 1e-6);
}

TEST_CASE("apply: an empty below a part that changes its form goes with the place it is at") {
  const Lamp model;
  const Applied out = model.edited([](const Vec3& p) { return Vec3(p[0] * 2, p[1] * 1.5 + 1, p[2]); });
  CHECK((world(out.glb, 1).translation() - Vec3(1, 2.5, 0)).norm() < 1e-9);
  CHECK((world(out.glb, 1).linear() - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-9);
  CHECK(json_of(out.glb)["nodes"][2] == model.glb.json["nodes"][2]);
  CHECK(out.warnings.empty());
}

TEST_CASE("apply: a place that glTF cannot say is made up for by vertices, or named") {
  Lamp model;
  model.glb.json["nodes"][0]["scale"] = {1, 2, 1};
  model.shape.parts[PartIndex(0)].hexahedron.corners = box(Vec3(-1, -2, -1), Vec3(1, 2, 1));
  model.shape.parts[PartIndex(1)].hexahedron.corners = box(Vec3(-1, 4, -1), Vec3(1, 8, 1));
  Eigen::Affine3d by = Eigen::Affine3d::Identity();
  by.rotate(Eigen::AngleAxisd(0.6, Vec3::UnitZ()));
  const std::string before = model.glb.bytes();
  const std::string out = model.edited([&](const Vec3& p) { return by * p; }).glb;
  // Part 2 would have to be sheared back in the coordinates of the turned node that is scaled along one axis.
  CHECK(furthest(world_positions(out, 0), moved(world_positions(before, 0), by)) < 1e-5);
  CHECK(furthest(world_positions(out, 2), world_positions(before, 2)) < 1e-5);
}

TEST_CASE("apply: the pivot of a part with an animation goes along, and its keys do") {
  Lamp model;
  model.glb.json["nodes"][0].erase("children");
  model.glb.json["scenes"][0]["nodes"] = {0, 2};
  const std::size_t times = model.glb.json["accessors"].size();
  model.glb.json["accessors"].push_back({{"bufferView", model.glb.view(std::vector<float>{0, 1})},
                                         {"componentType", 5126},
                                         {"count", 2},
                                         {"type", "SCALAR"},
                                         {"min", {0}},
                                         {"max", {1}}});
  const auto keys = [&](const std::vector<float>& values, const char* type) {
    model.glb.json["accessors"].push_back(
        {{"bufferView", model.glb.view(values)}, {"componentType", 5126}, {"count", 2}, {"type", type}});
    return model.glb.json["accessors"].size() - 1;
  };
  const float h = static_cast<float>(std::sqrt(0.5));
  const std::size_t turns = keys({0, 0, 0, 1, 0, h, 0, h}, "VEC4"), moves = keys({0, 0, 0, 0, 2, 0}, "VEC3");
  const auto animate = [&](const char* path, std::size_t output) {
    model.glb.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
                                     {"samplers", {{{"input", times}, {"output", output}}}}}};
  };
  const auto output_keys = [](const std::string& glb) {
    const ordered_json animation = json_of(glb)["animations"][0];
    const std::size_t sampler = animation["channels"][0]["sampler"];
    return *gltf::read_accessor(read(glb).original, animation["samplers"][sampler]["output"]);
  };
  SUBCASE("moved: a rotation about the pivot stays, the pivot moves") {
    animate("rotation", turns);
    const Applied out = model.edited([](const Vec3& p) { return Vec3(p + Vec3(0.5, 0, 0)); });
    CHECK(out.warnings.empty());
    CHECK((world(out.glb, 0).translation() - Vec3(0.5, 0, 0)).norm() < 1e-12);
    CHECK(json_of(out.glb)["animations"] == model.glb.json["animations"]);
  }
  SUBCASE("turned: keys of the rotation are turned along") {
    animate("rotation", turns);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.5, Vec3::UnitX()));
    const Applied out = model.edited([&](const Vec3& p) { return Vec3(q * p); });
    const std::vector<double> k = output_keys(out.glb);
    const Eigen::Quaterniond open(h, 0, h, 0), after(k[7], k[4], k[5], k[6]);
    CHECK(after.angularDistance(q * open) < 1e-6);
    CHECK(out.warnings.empty());
  }
  SUBCASE("moved: keys of a translation are moved along") {
    animate("translation", moves);
    const Applied out = model.edited([](const Vec3& p) { return Vec3(p + Vec3(0.5, 0, 0)); });
    const std::vector<double> k = output_keys(out.glb);
    CHECK(k == std::vector<double>{0.5, 0, 0, 0.5, 2, 0});
  }
  SUBCASE("stretched: the pivot goes with the place it is at") {
    animate("rotation", turns);
    const Applied out = model.edited([](const Vec3& p) { return Vec3(p[0] * 2 + 1, p[1], p[2]); });
    CHECK((world(out.glb, 0).translation() - Vec3(1, 0, 0)).norm() < 1e-12);
    std::vector<Vec3> expected;
    for (const Vec3& p : model.points) expected.emplace_back(p[0] * 2 + 1, p[1], p[2]);
    CHECK(furthest(world_positions(out.glb, 0), expected) < 1e-6);
    CHECK(out.warnings.empty());
  }
}

TEST_CASE("apply: lower levels of detail follow, moved and stretched") {
  Lamp model;
  const std::size_t level = model.glb.json["nodes"].size();
  model.glb.json["nodes"].push_back(
      {{"mesh", model.glb.mesh({{"attributes", {{"POSITION", model.glb.vectors(model.points)}}}})}});
  model.glb.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = {level};
  SUBCASE("moved") {
    const std::string out = model.edited([](const Vec3& p) { return Vec3(p + Vec3(0, 1, 0)); }).glb;
    CHECK(json_of(out)["nodes"][level]["translation"] == json_of(out)["nodes"][0]["translation"]);
  }
  SUBCASE("stretched") {
    const std::string out = model.edited([](const Vec3& p) { return Vec3(p[0] * 2, p[1], p[2]); }).glb;
    CHECK(furthest(attribute(out, level, "POSITION"), attribute(out, 0, "POSITION")) < 1e-6);
  }
}

TEST_CASE("apply: a pivot above moves when all parts below it move as one") {
  Lamp model;
  const std::size_t pivot = model.glb.json["nodes"].size();
  model.glb.json["nodes"].push_back({{"name", "pivot"}, {"children", {0}}, {"translation", {0, 0, 0}}});
  model.glb.json["scenes"][0]["nodes"] = {pivot};
  State state = resting(model.shape);
  for (const PartIndex p : model.shape.parts.indices()) state.parts[p].col(0).array() += 0.75;
  const auto out = apply_state(model.glb.bytes(), model.shape, state);
  REQUIRE(out.ok());
  const ordered_json json = json_of(out->glb);
  CHECK(json["nodes"][pivot]["translation"] == ordered_json({0.75, 0.0, 0.0}));
  CHECK(json["nodes"][0] == model.glb.json["nodes"][0]);
  CHECK(json["nodes"][2] == model.glb.json["nodes"][2]);
}
