// Morph targets in files: where they go, what they keep, which nodes share them.
#include "tests/core/morph_fixture.h"

using namespace parsel;
using namespace parsel::morph_fixture;

TEST_CASE("morph: displacements are in the coordinates of the mesh, and nodes stay where they are") {
  const Boxes model(1, true);
  const Program program = program_of(
      "layer \"move\": x1 = 0 in [0, 0.3]\n  translate(\"part_0\", amount=x1, direction=(0, 1, 0))\n", model.shape);
  const std::string file = model.glb.bytes();
  const SlidersApplied out = morphed(file, model.shape, program, {0});
  CHECK(out.sliders.at(0).targets == std::vector<std::string>{"move"});
  CHECK(json_of(out.applied.glb)["nodes"] == json_of(file)["nodes"]);
  CHECK(furthest(displayed(out.applied.glb, {}), displayed(file, {})) == 0);
  const std::vector<Vec3> at = displayed(out.applied.glb, {{"move", 1}}), rest = displayed(file, {});
  for (std::size_t i = 0; i < at.size(); ++i) CHECK((at[i] - rest[i] - Vec3(0, 0.3, 0)).norm() < 1e-6);
}

TEST_CASE("morph: nodes share a mesh as long as they move alike") {
  const Boxes model(3);
  const std::string to_the_side = ", amount=x1, direction=(0, 1, 0))\n";
  const std::string first = "layer \"one\": x1 = 0 in [0, 0.3]\n";
  SUBCASE("all alike") {
    const Program program = program_of(first + "  translate(\"part_0\"" + to_the_side + "  translate(\"part_1\"" +
                                           to_the_side + "  translate(\"part_2\"" + to_the_side,
                                       model.shape);
    const ordered_json json = json_of(morphed(model.glb.bytes(), model.shape, program, {0}).applied.glb);
    CHECK(json["meshes"].size() == 1);
    CHECK(json["meshes"][0]["weights"] == ordered_json::array({0}));
  }
  SUBCASE("one stays, one is turned") {
    const Program program = program_of(first + "  translate(\"part_0\"" + to_the_side +
                                           "  rotate(\"part_1\", amount=x1, origin=(1, 0, 0), axis=(0, 0, 1))\n",
                                       model.shape);
    const SlidersApplied out = morphed(model.glb.bytes(), model.shape, program, {0});
    const ordered_json json = json_of(out.applied.glb);
    CHECK(json["meshes"].size() == 3);
    CHECK(mesh_of(json, 2) == 0);
    CHECK(names_of(json["meshes"][0]).empty());
    CHECK(mesh_of(json, 0) != mesh_of(json, 1));
    CHECK(furthest(displayed(out.applied.glb, {{"one", 1}}),
                   displayed(applied(model.glb.bytes(), model.shape, program, {0.3}), {})) < 1e-6);
  }
  SUBCASE("the same motion under two sliders") {
    const Program program =
        program_of(first + "  translate(\"part_0\"" + to_the_side +
                       "layer \"two\": x2 = 0 in [0, 0.3]\n  translate(\"part_1\", amount=x2, direction=(0, 1, 0))\n",
                   model.shape);
    const SlidersApplied out = morphed(model.glb.bytes(), model.shape, program, {0, 0});
    const ordered_json json = json_of(out.applied.glb);
    CHECK(json["meshes"].size() == 3);
    CHECK(names_of(json["meshes"][mesh_of(json, 0)]) == std::vector<std::string>{"one"});
    CHECK(names_of(json["meshes"][mesh_of(json, 1)]) == std::vector<std::string>{"two"});
    CHECK(out.together == doctest::Approx(0));
  }
}

TEST_CASE("morph: a part that stands still in a mesh that moves has targets without displacement") {
  Boxes model(1);
  auto& primitives = model.glb.json["meshes"][0]["primitives"];
  const std::size_t other = model.glb.vectors(grid(Vec3(-0.1, 1, -0.1), Vec3(0.1, 2, 0.1)));
  primitives.push_back({{"attributes", {{"POSITION", other}}}});
  add_part(model.shape, 0, box(Vec3(-0.1, 1, -0.1), Vec3(0.1, 2, 0.1)), 1);
  const Program program = program_of(
      "layer \"move\": x1 = 0 in [0, 0.3]\n  translate(\"part_0\", amount=x1, direction=(0, 1, 0))\n", model.shape);
  const SlidersApplied out = morphed(model.glb.bytes(), model.shape, program, {0});
  const gltf::File file = read(out.applied.glb);
  const ordered_json still = json_of(out.applied.glb)["meshes"][0]["primitives"][1]["targets"];
  REQUIRE(still.size() == 1);
  for (const Vec3& v : vectors(file, still[0]["POSITION"])) CHECK(v == Vec3::Zero());
}

TEST_CASE("morph: targets, names, weights and animations of weights that the model has are kept") {
  Boxes model(2);
  const std::size_t delta = model.glb.vectors(std::vector<Vec3>(27, Vec3(0, 0, 0.25)));
  ordered_json& mesh = model.glb.json["meshes"][0];
  mesh["primitives"][0]["targets"] = {{{"POSITION", delta}}, {{"POSITION", delta}}};
  mesh["weights"] = {0.5, 0};
  mesh["extras"] = {{"targetNames", {"puff", "slide"}}, {"price", 12}};
  model.glb.json["nodes"][1]["weights"] = {0, 1};
  const auto scalars = [&](const std::vector<float>& values) {
    model.glb.json["accessors"].push_back({{"bufferView", model.glb.view(values)},
                                           {"componentType", 5126},
                                           {"count", values.size()},
                                           {"type", "SCALAR"},
                                           {"min", {0}},
                                           {"max", {1}}});
    return model.glb.json["accessors"].size() - 1;
  };
  const std::size_t times = scalars({0, 1});
  const std::size_t linear = scalars({1, 2, 3, 4}), cubic = scalars({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
  model.glb.json["animations"].push_back({{"samplers",
                                           {{{"input", times}, {"output", linear}},
                                            {{"input", times}, {"output", cubic}, {"interpolation", "CUBICSPLINE"}}}},
                                          {"channels",
                                           {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}},
                                            {{"sampler", 1}, {"target", {{"node", 1}, {"path", "weights"}}}}}}});
  // The slider has the name of a target that is there.
  const Program program = program_of(
      "layer \"slide\": x1 = 0 in [-0.1, 0.3]\n  translate(\"part_0\", amount=x1, direction=(0, 1, 0))\n"
      "  translate(\"part_1\", amount=x1, direction=(1, 0, 0))\n",
      model.shape);
  const auto sampled = [&](const ordered_json& json, const std::string& glb, std::size_t channel) {
    const auto& animation = json["animations"][0];
    const auto sampler = animation["channels"][channel]["sampler"].get<std::size_t>();
    const gltf::File file = read(glb);
    return *gltf::read_accessor(file.original, animation["samplers"][sampler]["output"]);
  };
  SUBCASE("extended") {
    const std::string file = model.glb.bytes();
    const SlidersApplied out = morphed(file, model.shape, program, {0});
    CHECK(out.sliders.at(0).targets == std::vector<std::string>{"slide 2", "slide 2 −"});
    const ordered_json json = json_of(out.applied.glb);
    REQUIRE(json["meshes"].size() == 2);
    for (std::size_t n = 0; n < 2; ++n) {
      const auto& shown = json["meshes"][mesh_of(json, n)];
      CHECK(names_of(shown) == std::vector<std::string>{"puff", "slide", "slide 2", "slide 2 −"});
      CHECK(shown["weights"] == ordered_json({0.5, 0, 0, 0}));
      CHECK(shown["extras"]["price"] == 12);
      CHECK(shown["primitives"][0]["targets"][0]["POSITION"] == delta);
    }
    CHECK_FALSE(json["nodes"][0].contains("weights"));
    CHECK(json["nodes"][1]["weights"] == ordered_json({0, 1, 0, 0}));
    CHECK(sampled(json, out.applied.glb, 0) == std::vector<double>{1, 2, 0, 0, 3, 4, 0, 0});
    const std::vector<double> curve = sampled(json, out.applied.glb, 1);
    CHECK(curve.size() == 24);
    CHECK(std::vector<double>(curve.end() - 4, curve.end()) == std::vector<double>{11, 12, 0, 0});
    const double off = furthest(displayed(out.applied.glb, {{"puff", 1}, {"slide 2", 1}}),
                                displayed(applied(file, model.shape, program, {0.3}), {{"puff", 1}}));
    CHECK(off < 1e-6);
  }
  SUBCASE("keys of another number of weights: that node gets none") {
    model.glb.json["accessors"][linear]["count"] = 3;
    const SlidersApplied out = morphed(model.glb.bytes(), model.shape, program, {0});
    REQUIRE(out.applied.warnings.size() == 1);
    CHECK(out.applied.warnings[0].place == "node 0");
    const ordered_json json = json_of(out.applied.glb);
    CHECK(names_of(json["meshes"][mesh_of(json, 0)]).size() == 2);
    CHECK(names_of(json["meshes"][mesh_of(json, 1)]).size() == 4);
  }
  SUBCASE("weights animated by pointer") {
    model.glb.json["animations"][0]["channels"][0]["target"] = {
        {"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", "/meshes/0/weights"}}}}}};
    const SlidersApplied out = morphed(model.glb.bytes(), model.shape, program, {0});
    CHECK(out.applied.warnings.size() == 2);
    CHECK(out.applied.glb == model.glb.bytes());
  }
}
