// Programs applied to files, read back by the importer: what the patcher writes is what the evaluator says.
#include <doctest/doctest.h>

#include "core/shape/abstraction.h"
#include "core/shape/gltf_import.h"
#include "tests/core/apply_fixture.h"
#include "tests/core/real_models.h"

using namespace parsel;
using namespace parsel::apply_fixture;

namespace {

/// Every part is scaled across, sheared and turned, each by an amount of its own.
Program busy_program(const Shape& shape) {
  std::string text = "parsel program 1\nshape \"test\" \"\"\n\nlayer \"everything\": x1 = 0 in [-0.3, 0.3]\n";
  int i = 0;
  for (const Part& part : shape.parts) {
    if (part.is_virtual()) continue;
    const std::string id = ordered_json(part.id).dump();
    const std::string amount = "amount=" + std::to_string(1 + i % 3) + "*x1";
    text += "  scale_1d(" + id + ", " + amount + ", origin=(0, 0, 0), direction=(1, 1, 0))\n";
    if (i % 2 == 0) text += "  translate(" + id + ", amount=x1, direction=(0, 1, 0), feature=(0, 1, 0))\n";
    if (i % 4 == 1) text += "  rotate(" + id + ", amount=x1, origin=(0, 0, 0), axis=(0, 0, 1))\n";
    ++i;
  }
  const auto program = program_from_text(text);
  REQUIRE_MESSAGE(program.ok(), (program.ok() ? "" : program.error().message()));
  const Status valid = validate(*program, shape);
  REQUIRE_MESSAGE(valid.ok(), (valid.ok() ? "" : valid.error().message()));
  return *program;
}

/// The largest distance, in the frame of the shape, between a part's vertices in the file and where the state has them.
double error_of(const std::string& glb, const Abstraction& model, const State& state) {
  const auto read = import_gltf(glb);
  REQUIRE_MESSAGE(read.ok(), (read.ok() ? "" : read.error().message()));
  REQUIRE(read->meshes.size() == model.meshes.size());
  const Frame& frame = model.shape.frame;
  double worst = 0;
  for (const PartIndex p : model.meshes.indices()) {
    const PartMesh& before = model.meshes[p];
    // The importer goes through the nodes in scene order, which an edit keeps.
    const PartMesh* after = nullptr;
    for (const PartMesh& mesh : read->meshes) {
      if (mesh.node == before.node && mesh.primitive == before.primitive) after = &mesh;
    }
    REQUIRE(after != nullptr);
    REQUIRE(after->positions.size() == before.positions.size());
    const Hexahedron& rest = model.shape.parts[p].hexahedron;
    for (const Triangle& triangle : before.triangles) {
      for (const std::uint32_t i : triangle) {
        const Vec3 expected = interpolate(trilinear_weights(rest.local(before.positions[i])), state.parts[p]);
        const Vec3 found = frame.to_normalised(read->frame.to_model(after->positions[i]));
        worst = std::max(worst, (found - expected).norm());
      }
    }
  }
  return worst;
}

/// A table of five parts, the four legs in one mesh.
std::string table() {
  Glb glb;
  const auto boxed = [&](const Vec3& low, const Vec3& high) {
    const std::size_t position = glb.vectors(grid(low, high, 1));
    return glb.mesh({{"attributes", {{"POSITION", position}}},
                     {"indices", glb.indices({0, 1, 2, 1, 3, 2, 4, 6, 5, 5, 6, 7, 0, 4, 1, 1, 4, 5,
                                              2, 3, 6, 3, 7, 6, 0, 2, 4, 2, 6, 4, 1, 5, 3, 3, 5, 7})}});
  };
  glb.node({{"name", "top"}, {"mesh", boxed(Vec3(-1, 0.7, -0.5), Vec3(1, 0.8, 0.5))}});
  const std::size_t leg = boxed(Vec3(-0.05, 0, -0.05), Vec3(0.05, 0.7, 0.05));
  for (const double x : {-0.9, 0.9}) {
    for (const double z : {-0.4, 0.4}) glb.node({{"name", "leg"}, {"mesh", leg}, {"translation", {x, 0, z}}});
  }
  return glb.bytes();
}

Abstraction abstracted(const std::string& file) {
  auto model = abstract_shape(file, "test");
  REQUIRE_MESSAGE(model.ok(), (model.ok() ? "" : model.error().message()));
  return std::move(model).value();
}

}  // namespace

TEST_CASE("apply: the importer reads back what the evaluator says") {
  const std::string file = table();
  const Abstraction model = abstracted(file);
  const Program program = busy_program(model.shape);
  for (const double x : {0.2, -0.3}) {
    const auto out = apply_program(file, model.shape, program, {x});
    REQUIRE(out.ok());
    CHECK(error_of(out->glb, model, Evaluator(program, model.shape)({x})) < 1e-6);
  }
  CHECK(apply_program(file, model.shape, program, {0})->glb == file);
}

TEST_CASE("apply: values and parameters that the program does not have are refused") {
  const std::string file = table();
  const Abstraction model = abstracted(file);
  const Program program = busy_program(model.shape);
  CHECK_FALSE(apply_program(file, model.shape, program, {}).ok());
  CHECK_FALSE(apply_program(file, model.shape, program, {0, 0}).ok());
  const auto unknown = apply_program(file, model.shape, program, {0}, Animate{"x2"});
  REQUIRE_FALSE(unknown.ok());
  CHECK(unknown.error().place == "x2");
  const auto animated = apply_program(file, model.shape, program, {0.1}, Animate{"x1", 1.5});
  REQUIRE(animated.ok());
  CHECK(json_of(animated->glb)["animations"][0]["name"] == "x1");
}

TEST_CASE("apply: furniture, edited and read back") {
  const std::set<std::string> wanted = {"table_lack_0825", "desk_fredrik_0430", "bookcase_expedit_0376",
                                        "bench_bjursta_0210"};
  for (const auto& path : test::real_models("furniture")) {
    if (wanted.count(path.stem().string()) == 0) continue;
    const std::string bytes = test::read_bytes(path);
    const Abstraction model = abstracted(bytes);
    const Program program = busy_program(model.shape);
    CHECK(apply_program(bytes, model.shape, program, {0})->glb == bytes);
    const auto out = apply_program(bytes, model.shape, program, {0.25});
    REQUIRE(out.ok());
    CHECK(error_of(out->glb, model, Evaluator(program, model.shape)({0.25})) < 1e-6);
  }
}
