// Nodes that come and go: changed counts and the export of some parts only.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "core/base/tolerance.h"
#include "tests/core/apply_fixture.h"

using namespace parsel;
using namespace parsel::apply_fixture;

namespace {

const Vec3 low(-0.5, -1, -0.1), high(0.5, 1, 0.1);

/// Three slats side by side under a turned parent, and a rail that is no slat. Group t1 of the slats.
struct Slats {
  Glb glb;
  Shape shape;
  Eigen::Affine3d parent = Eigen::Affine3d::Identity();
  std::vector<Vec3> points = grid(low, high);

  explicit Slats(bool shared_mesh = true) {
    parent.translate(Vec3(1, 2, 3)).rotate(Eigen::AngleAxisd(pi / 2, Vec3::UnitY())).scale(2);
    const std::size_t mesh = glb.mesh({{"attributes", {{"POSITION", glb.vectors(points)}}}});
    const double h = std::sqrt(0.5);
    glb.node({{"name", "frame"},
              {"translation", {1, 2, 3}},
              {"rotation", {0, h, 0, h}},
              {"scale", {2, 2, 2}},
              {"children", {1, 2, 3, 4}}});
    for (int i = 0; i < 3; ++i) {
      const std::size_t own = shared_mesh ? mesh : glb.mesh(glb.json["meshes"][mesh]["primitives"][0]);
      glb.json["nodes"].push_back(
          {{"name", "slat"}, {"mesh", own}, {"translation", {0, 0, i}}, {"extras", {{"k", i}}}});
      add_part(shape, static_cast<std::size_t>(i) + 1, slat(i));
    }
    glb.json["nodes"].push_back(
        {{"name", "rail"}, {"mesh", glb.mesh({{"attributes", {{"POSITION", glb.vectors(points)}}}})}});
    add_part(shape, 4, slat(0));
    shape.relations.push_back({"t1",
                               RelationKind::translation,
                               {PartIndex(0), PartIndex(1), PartIndex(2)},
                               Translation{PartIndex(0), Vec3::Zero(), Vec3::Zero(), 0, 1}});
  }

  Corners slat(double at, double taller = 1) const {
    return mapped(box(low.cwiseProduct(Vec3(1, taller, 1)) + Vec3(0, 0, at),
                      high.cwiseProduct(Vec3(1, taller, 1)) + Vec3(0, 0, at)),
                  [&](const Vec3& p) { return parent * p; });
  }

  /// The state with that many slats at a distance of `step`.
  State with(std::size_t count, double step, double taller = 1) const {
    State state = resting(shape);
    GroupState& group = state.groups[RelationIndex(0)];
    group.count_changed = true;
    group.source = 0;
    group.instances.clear();
    for (std::size_t i = 0; i < count; ++i) group.instances.push_back(slat(static_cast<double>(i) * step, taller));
    for (std::size_t i = 0; i < 3; ++i) state.parts[PartIndex(i)] = group.instances[std::min(i, count - 1)];
    return state;
  }

  std::vector<Vec3> where(double at, double taller = 1) const {
    std::vector<Vec3> out;
    for (const Vec3& p : points) out.push_back(parent * Vec3(p[0], p[1] * taller, p[2] + at));
    return out;
  }
};

Applied applied(const Slats& model, const State& state, const ApplyOptions& options = {}) {
  auto out = apply_state(model.glb.bytes(), model.shape, state, options);
  REQUIRE_MESSAGE(out.ok(), (out.ok() ? "" : out.error().message()));
  return std::move(out).value();
}

}  // namespace

TEST_CASE("apply: new instances are nodes that share the mesh") {
  const Slats model;
  const std::string out = applied(model, model.with(5, 1)).glb;
  const ordered_json json = json_of(out);
  REQUIRE(json["nodes"].size() == 7);
  CHECK(json["nodes"][0]["children"] == ordered_json({1, 2, 3, 4, 5, 6}));
  CHECK(json["nodes"][5]["name"] == "slat_2");
  CHECK(json["nodes"][6]["name"] == "slat_3");
  CHECK(json["nodes"][5]["extras"]["k"] == 0);
  CHECK(json["nodes"][6]["mesh"] == json["nodes"][1]["mesh"]);
  CHECK_FALSE(json["nodes"][6].contains("rotation"));
  CHECK(json["meshes"] == model.glb.json["meshes"]);
  CHECK(json["accessors"] == model.glb.json["accessors"]);
  for (std::size_t i = 0; i < 5; ++i) {
    const std::size_t node = i < 3 ? i + 1 : i + 2;
    CHECK(furthest(world_positions(out, node), model.where(static_cast<double>(i))) < 1e-5);
  }
}

TEST_CASE("apply: new instances share the template's edited mesh") {
  const Slats model;
  const std::string out = applied(model, model.with(4, 0.7, 1.3)).glb;
  const ordered_json json = json_of(out);
  // All slats are taller; those that also moved have meshes of their own, the new one does with the first one's.
  CHECK(json["nodes"][5]["mesh"] == json["nodes"][1]["mesh"]);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t node = i < 3 ? i + 1 : i + 2;
    CHECK(furthest(world_positions(out, node), model.where(0.7 * static_cast<double>(i), 1.3)) < 1e-5);
  }
}

TEST_CASE("apply: an instance that is no moved copy gets a mesh of its own") {
  const Slats model(false);
  State state = model.with(4, 1);
  state.groups[RelationIndex(0)].instances[3] = model.slat(3, 1.5);
  const std::string out = applied(model, state).glb;
  CHECK(json_of(out)["meshes"].size() == model.glb.json["meshes"].size() + 1);
  CHECK(furthest(world_positions(out, 5), model.where(3, 1.5)) < 1e-5);
  CHECK(furthest(world_positions(out, 1), model.where(0)) < 1e-5);
}

TEST_CASE("apply: turned instances are turned nodes") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(low, high);
  const std::size_t mesh = glb.mesh({{"attributes", {{"POSITION", glb.vectors(points)}}}});
  const auto turned = [&](double angle) -> Eigen::Affine3d {
    return Eigen::AngleAxisd(angle, Vec3::UnitY()) * Eigen::Translation3d(3, 0, 0) * Eigen::Scaling(1.0);
  };
  for (int i = 0; i < 3; ++i) {
    const Eigen::Affine3d at = turned(2 * pi / 3 * i);
    const Eigen::Vector4d q = Eigen::Quaterniond(at.linear()).coeffs();
    const Vec3 t = at.translation();
    glb.node({{"name", "leg_" + std::to_string(i + 1)},
              {"mesh", mesh},
              {"translation", {t[0], t[1], t[2]}},
              {"rotation", {q[0], q[1], q[2], q[3]}}});
    add_part(shape, static_cast<std::size_t>(i), mapped(box(low, high), [&](const Vec3& p) { return at * p; }));
  }
  shape.relations.push_back({"o1",
                             RelationKind::rotation,
                             {PartIndex(0), PartIndex(1), PartIndex(2)},
                             Rotation{PartIndex(0), Vec3::Zero(), Vec3::UnitY(), 1, 1.0}});
  State state = resting(shape);
  GroupState& group = state.groups[RelationIndex(0)];
  group.count_changed = true;
  group.instances.clear();
  for (int i = 0; i < 5; ++i) {
    group.instances.push_back(mapped(box(low, high), [&](const Vec3& p) { return turned(2 * pi / 5 * i) * p; }));
  }
  const auto out = apply_state(glb.bytes(), shape, state);
  REQUIRE(out.ok());
  const ordered_json json = json_of(out->glb);
  CHECK(json["nodes"][3]["name"] == "leg_4");
  CHECK(json["nodes"][4]["name"] == "leg_5");
  CHECK(json["nodes"][4]["mesh"] == mesh);
  CHECK(json["scenes"][0]["nodes"] == ordered_json({0, 1, 2, 3, 4}));
  for (std::size_t i = 0; i < 5; ++i) {
    std::vector<Vec3> expected = points;
    for (Vec3& p : expected) p = turned(2 * pi / 5 * static_cast<double>(i)) * p;
    CHECK(furthest(world_positions(out->glb, i), expected) < 1e-6);
  }
}

TEST_CASE("apply: removed instances leave the scene, and no index shifts") {
  Slats model;
  std::size_t warnings = 0;
  SUBCASE("a leaf is detached") {}
  SUBCASE("one with a child stays for the child, without its mesh") {
    model.glb.json["nodes"][3]["children"] = {5};
    model.glb.json["nodes"].push_back({{"name", "knob"}, {"mesh", 1}});
    warnings = 1;
  }
  const Applied out = applied(model, model.with(2, 1));
  const ordered_json json = json_of(out.glb);
  CHECK(out.warnings.size() == warnings);
  CHECK(json["nodes"].size() == model.glb.json["nodes"].size());
  if (warnings == 0) {
    CHECK(json["nodes"][0]["children"] == ordered_json({1, 2, 4}));
    CHECK(json["nodes"][3] == model.glb.json["nodes"][3]);
  } else {
    CHECK(json["nodes"][0]["children"] == model.glb.json["nodes"][0]["children"]);
    CHECK_FALSE(json["nodes"][3].contains("mesh"));
  }
}

TEST_CASE("apply: only the parts asked for stay in the scene") {
  const Slats model;
  ApplyOptions options;
  options.only_parts = {PartIndex(1)};
  const ordered_json one = json_of(applied(model, resting(model.shape), options).glb);
  CHECK(one["nodes"][0]["children"] == ordered_json({2}));
  CHECK(one["meshes"] == model.glb.json["meshes"]);

  Shape with_parent = model.shape;
  Part parent;
  parent.id = "slats";
  parent.hexahedron.corners = model.slat(0);
  parent.members = {PartIndex(0), PartIndex(1), PartIndex(2)};
  options.only_parts = {with_parent.parts.push_back(parent)};
  const auto all = apply_state(model.glb.bytes(), with_parent, resting(with_parent), options);
  REQUIRE(all.ok());
  CHECK(json_of(all->glb)["nodes"][0]["children"] == ordered_json({1, 2, 3}));
}

TEST_CASE("apply: one primitive of a node is taken out without the others") {
  Glb glb;
  Shape shape;
  const std::vector<Vec3> points = grid(low, high);
  const std::size_t a = glb.vectors(points), b = glb.vectors(points);
  glb.json["meshes"].push_back(
      {{"primitives", {{{"attributes", {{"POSITION", a}}}}, {{"attributes", {{"POSITION", b}}}}}}});
  glb.node({{"mesh", 0}});
  glb.node({{"mesh", 0}});
  for (std::size_t node = 0; node < 2; ++node) {
    for (std::size_t primitive = 0; primitive < 2; ++primitive) add_part(shape, node, box(low, high), primitive);
  }
  ApplyOptions options;
  options.only_parts = {PartIndex(1), PartIndex(2), PartIndex(3)};
  State state = resting(shape);
  state.parts[PartIndex(1)].col(0).array() += 1;
  const auto out = apply_state(glb.bytes(), shape, state, options);
  REQUIRE(out.ok());
  const ordered_json json = json_of(out->glb);
  CHECK(json["nodes"][0]["mesh"] == 1);
  CHECK(json["meshes"][0] == glb.json["meshes"][0]);
  CHECK(json["meshes"][1]["primitives"].size() == 1);
  CHECK(attribute(out->glb, 0, "POSITION")[0][0] == 0.5);
  CHECK(attribute(out->glb, 1, "POSITION", 1)[0][0] == -0.5);
}

TEST_CASE("apply: what cannot show an edit is left as it was, with a warning") {
  Slats model;
  std::string expected;
  SUBCASE("a skinned mesh") {
    model.glb.json["nodes"][1]["skin"] = 0;
    model.glb.json["skins"] = {{{"joints", {0}}}};
    expected = "part part_0";
  }
  SUBCASE("GPU instances") {
    model.glb.json["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 0;
    expected = "part part_0";
  }
  SUBCASE("a flat node") {
    model.glb.json["nodes"][1]["scale"] = {1, 0, 1};
    expected = "part part_0";
  }
  SUBCASE("an animated node is edited all the same") {
    const std::size_t times = model.glb.json["accessors"].size();
    model.glb.json["accessors"].push_back({{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}});
    model.glb.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}},
         {"samplers", {{{"input", times}, {"output", times}}}}}};
    expected = "node 1";
  }
  State state = resting(model.shape);
  state.parts[PartIndex(0)].col(1).array() += 1;
  const Applied out = applied(model, state);
  REQUIRE(out.warnings.size() == 1);
  CHECK(out.warnings[0].place == expected);
  CHECK((out.glb == model.glb.bytes()) == (expected != "node 1"));
}
