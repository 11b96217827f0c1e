// Models with morph targets, shown as a viewer shows them: for the tests of sliders in other tools.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/export/sliders.h"
#include "tests/core/apply_fixture.h"

namespace parsel::morph_fixture {

using namespace apply_fixture;

using WeightsByName = std::map<std::string, double>;

inline std::vector<std::string> names_of(const ordered_json& mesh) {
  return mesh.contains("extras") && mesh["extras"].contains("targetNames")
             ? mesh["extras"]["targetNames"].get<std::vector<std::string>>()
             : std::vector<std::string>{};
}

/// What a viewer shows of all meshes in the scene with these weights, others 0: world positions in the order of nodes;
/// with `normals`, unit normals in the coordinates of the nodes instead.
inline std::vector<Vec3> displayed(const std::string& glb, const WeightsByName& weights, bool normals = false) {
  const gltf::File file = read(glb);
  const ordered_json json = json_of(glb);
  const auto scene = gltf::read_scene(file.original);
  REQUIRE(scene.ok());
  std::vector<Vec3> out;
  for (std::size_t n = 0; n < json["nodes"].size(); ++n) {
    if (!scene->shown[n] || !json["nodes"][n].contains("mesh")) continue;
    const auto& mesh = json["meshes"][json["nodes"][n]["mesh"].get<std::size_t>()];
    const std::vector<std::string> names = names_of(mesh);
    for (const auto& primitive : mesh["primitives"]) {
      std::vector<Vec3> values = vectors(file, primitive["attributes"][normals ? "NORMAL" : "POSITION"]);
      const std::size_t targets = primitive.contains("targets") ? primitive["targets"].size() : 0;
      CHECK(targets == names.size());
      for (std::size_t t = 0; t < targets; ++t) {
        const auto weight = weights.find(names[t]);
        const char* name = normals ? "NORMAL" : "POSITION";
        if (weight == weights.end() || !primitive["targets"][t].contains(name)) continue;
        const std::vector<Vec3> deltas = vectors(file, primitive["targets"][t][name]);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] += weight->second * deltas[i];
      }
      for (const Vec3& v : values) out.push_back(normals ? v.normalized() : scene->world[n] * v);
    }
  }
  return out;
}

inline SlidersApplied morphed(const std::string& file, const Shape& shape, const Program& program,
                              const std::vector<double>& values) {
  auto out = apply_sliders(file, shape, program, values);
  REQUIRE_MESSAGE(out.ok(), (out.ok() ? "" : out.error().message()));
  const ordered_json json = json_of(out->applied.glb);
  for (const auto& mesh : json["meshes"]) {  // as the specification wants it
    const std::size_t targets = mesh["primitives"][0].contains("targets") ? mesh["primitives"][0]["targets"].size() : 0;
    CHECK((mesh.contains("weights") ? mesh["weights"].size() : 0) == targets);
  }
  CHECK(bounds_hold(out->applied.glb));
  return std::move(out).value();
}

inline std::string applied(const std::string& file, const Shape& shape, const Program& program,
                           const std::vector<double>& values) {
  const auto out = apply_program(file, shape, program, values);
  REQUIRE_MESSAGE(out.ok(), (out.ok() ? "" : out.error().message()));
  return out->glb;
}

inline Program program_of(const std::string& text, const Shape& shape) {
  const auto program = program_from_text("parsel program 1\nshape \"test\" \"\"\n\n" + text);
  REQUIRE_MESSAGE(program.ok(), (program.ok() ? "" : program.error().message()));
  const Status valid = validate(*program, shape);
  REQUIRE_MESSAGE(valid.ok(), (valid.ok() ? "" : valid.error().message()));
  return *program;
}

/// Boxes of their own in nodes of their own, sharing mesh 0, side by side.
struct Boxes {
  Glb glb;
  Shape shape;
  const Vec3 low{-0.3, -0.2, -0.1}, high{0.3, 0.2, 0.1};

  explicit Boxes(std::size_t count, bool turned = false) {
    const std::vector<Vec3> points = grid(low, high);
    const std::size_t position = glb.vectors(points);
    const std::size_t normal = glb.vectors(std::vector<Vec3>(points.size(), Vec3(0, 0.6, 0.8)), false);
    const std::size_t mesh = glb.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Affine3d world = Eigen::Affine3d::Identity();
      world.translate(Vec3(static_cast<double>(i), 0, 0));
      ordered_json node{{"mesh", mesh}, {"translation", {i, 0, 0}}};
      if (turned) {
        node["rotation"] = {0, 0, std::sin(0.25), std::cos(0.25)};
        node["scale"] = {2, 1, 0.5};
        world.rotate(Eigen::AngleAxisd(0.5, Vec3::UnitZ())).scale(Vec3(2, 1, 0.5));
      }
      glb.node(node);
      add_part(shape, i, mapped(box(low, high), [&](const Vec3& p) { return world * p; }));
    }
  }
};

inline std::size_t mesh_of(const ordered_json& json, std::size_t node) {
  return json["nodes"][node]["mesh"].get<std::size_t>();
}

}  // namespace parsel::morph_fixture
