#include "core/edit/evaluate.h"

#include <doctest/doctest.h>

#include "core/base/random.h"
#include "core/base/tolerance.h"
#include "core/edit/cage.h"
#include "tests/core/golden.h"

using namespace parsel;

namespace {

double difference(const Corners& corners, const nlohmann::json& expected) {
  double worst = 0;
  for (int k = 0; k < 8; ++k) {
    for (int i = 0; i < 3; ++i) {
      const double wanted = expected[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
      worst = std::max(worst, std::abs(corners(k, i) - wanted));
    }
  }
  return worst;
}

double difference(const Vec3& v, const nlohmann::json& expected) {
  double worst = 0;
  for (int i = 0; i < 3; ++i)
    worst = std::max(worst, std::abs(v[i] - expected[static_cast<std::size_t>(i)].get<double>()));
  return worst;
}

double difference(const State& a, const State& b) {
  double worst = 0;
  for (const PartIndex p : a.parts.indices()) worst = std::max(worst, (a.parts[p] - b.parts[p]).cwiseAbs().maxCoeff());
  for (const RelationIndex r : a.groups.indices()) {
    if (a.groups[r].instances.size() != b.groups[r].instances.size()) return INFINITY;
    for (std::size_t i = 0; i < a.groups[r].instances.size(); ++i) {
      worst = std::max(worst, (a.groups[r].instances[i] - b.groups[r].instances[i]).cwiseAbs().maxCoeff());
    }
  }
  return worst;
}

void check_group(const GroupState& state, const nlohmann::json& expected) {
  REQUIRE(state.instances.size() == expected["instances"].size());
  for (std::size_t i = 0; i < state.instances.size(); ++i) {
    CHECK(difference(state.instances[i], expected["instances"][i]) < noise);
  }
  CHECK(state.source == expected["source"].get<int>());
  CHECK(state.count_changed == (state.source >= 0));
  if (expected.contains("start")) {
    CHECK(difference(state.start, expected["start"]) < noise);
    CHECK(difference(state.end, expected["end"]) < noise);
  } else {
    CHECK(difference(state.centre, expected["centre"]) < noise);
    CHECK(difference(state.axis, expected["axis"]) < noise);
    CHECK(std::abs(state.radius - expected["radius"].get<double>()) < noise);
  }
}

Shape golden_shape(const std::string& name) {
  Result<Shape> shape = shape_from_json(golden("program_vectors.json")["shapes"][name]);
  REQUIRE_MESSAGE(shape.ok(), shape.error().message());
  return *shape;
}

Program program_of(const std::string& text) {
  Result<Program> program = program_from_text(text);
  REQUIRE_MESSAGE(program.ok(), program.error().message());
  return *program;
}

}  // namespace

TEST_CASE("the golden shapes are valid") {
  const auto vectors = golden("program_vectors.json");
  for (const auto& item : vectors["shapes"].items()) {
    const std::string& name = item.key();
    const Result<Shape> shape = shape_from_json(item.value());
    REQUIRE_MESSAGE(shape.ok(), shape.error().message());
    const Status status = validate(*shape);
    CHECK_MESSAGE(status.ok(), name, ": ", status.ok() ? "" : status.error().message());
  }
}

TEST_CASE("program vectors: corners of parts and groups") {
  const auto& vectors = golden("program_vectors.json");
  CHECK(vectors["cases"].size() >= 40);
  std::map<std::string, Shape> shapes;
  for (const auto& [name, json] : vectors["shapes"].items()) shapes.emplace(name, *shape_from_json(json));
  for (const auto& vector : vectors["cases"]) {
    const std::string name = vector["name"];
    CAPTURE(name);
    const Shape& shape = shapes.at(vector["shape"]);
    const Result<Program> program = program_from_json(vector["program"]);
    REQUIRE_MESSAGE(program.ok(), program.error().message());
    const Status valid = validate(*program, shape);
    REQUIRE_MESSAGE(valid.ok(), valid.error().message());
    const Evaluator evaluate(*program, shape);
    const State rest = rest_state(shape);
    for (const auto& sample : vector["samples"]) {
      const State state = evaluate(sample["values"].get<std::vector<double>>());
      for (const PartIndex p : shape.parts.indices()) {
        const std::string& id = shape.parts[p].id;
        CAPTURE(id);
        if (sample["parts"].contains(id)) {
          CHECK(difference(state.parts[p], sample["parts"][id]) < noise);
        } else {
          CHECK((state.parts[p] - rest.parts[p]).cwiseAbs().maxCoeff() < noise);
        }
      }
      for (const RelationIndex r : shape.relations.indices()) {
        const std::string& id = shape.relations[r].id;
        CAPTURE(id);
        if (sample["groups"].contains(id)) {
          check_group(state.groups[r], sample["groups"][id]);
        } else if (shape.relations[r].is_group()) {
          CHECK(state.groups[r].instances.size() == rest.groups[r].instances.size());
          CHECK(state.groups[r].source == -1);
        }
      }
    }
  }
}

TEST_CASE("with every parameter at 0 the shape is at rest, for all vectors whose amounts vanish there") {
  const auto& vectors = golden("program_vectors.json");
  int checked = 0;
  for (const auto& vector : vectors["cases"]) {
    const Shape shape = golden_shape(vector["shape"]);
    const Result<Program> program = program_from_json(vector["program"]);
    REQUIRE(program.ok());
    const std::vector<double> zeros(program->layers.size(), 0.0);
    std::vector<std::string> names;
    for (const Layer& layer : program->layers) names.push_back(layer.parameter.name);
    bool vanishes = true;
    for (const Layer& layer : program->layers) {
      for (const Statement& s : layer.statements) vanishes &= std::abs(s.amount.compile(names)(zeros.data())) < 1e-11;
    }
    if (!vanishes) continue;
    ++checked;
    CHECK(difference(Evaluator(*program, shape)(zeros), rest_state(shape)) < 1e-12);
  }
  CHECK(checked > 100);
}

TEST_CASE("local coordinates invert the trilinear map, of boxes and of deformed hexahedra") {
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    Corners corners = make_box(Vec3(0.1, -0.2, 0.3), Mat3::Identity(), Vec3(0.5, 0.3, 0.2)).corners;
    for (int k = 0; k < 8; ++k) {
      for (int i = 0; i < 3; ++i) corners(k, i) += random.uniform(-0.05, 0.05);
    }
    const Vec3 local(random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2));
    const Vec3 found = local_coordinates(corners, interpolate(trilinear_weights(local), corners));
    CHECK((found - local).norm() < 1e-9);
  }
}

TEST_CASE("local coordinates in a collapsed hexahedron are finite") {
  Corners flat = make_box(Vec3::Zero(), Mat3::Identity(), Vec3(0.5, 0, 0.2)).corners;
  CHECK(local_coordinates(flat, Vec3(0.1, 0.1, 0.1)) == Vec3::Zero());
  CHECK(local_coordinates(Corners::Zero(), Vec3(1, 2, 3)) == Vec3::Zero());
}

TEST_CASE("a statement along a part's axis that has collapsed does nothing") {
  const Shape shape = golden_shape("pair");
  const Program program = program_of(
      "parsel program 1\nshape \"pair\" \"\"\n"
      "layer \"\": x1 = 0 in [-1, 0]\n"
      "scale_1d(\"seat\", amount=x1, origin=point(\"seat\", 0, 0, 0), direction=axis(\"seat\", 0))\n"
      "layer \"\": x2 = 0 in [0, 1]\n"
      "translate(\"leg\", amount=x2, direction=axis(\"seat\", 0))\n"
      "translate(\"leg\", amount=x2/2, direction=(0, 0, 5))\n");
  REQUIRE(validate(program, shape).ok());
  const State state = Evaluator(program, shape)({-1, 0.5});
  const PartIndex leg = *shape.find_part("leg");
  const Vec3 moved = (state.parts[leg] - shape.parts[leg].hexahedron.corners).row(3).transpose();
  CHECK((moved - Vec3(0, 0, 0.25)).norm() < 1e-12);
}

TEST_CASE("an amount that is not finite counts as 0") {
  const Shape shape = golden_shape("pair");
  // Not validated on purpose: the evaluator must not spread NaN should a bad amount slip through.
  const Program program = program_of(
      "parsel program 1\nshape \"pair\" \"\"\nlayer \"\": x1 = 0 in [0, 1]\n"
      "translate(\"leg\", amount=1/x1, direction=(1, 0, 0))\n");
  CHECK(difference(Evaluator(program, shape)({0}), rest_state(shape)) == 0);
}

TEST_CASE("an evaluator outlives its program and shape, copies share it, and it repeats itself") {
  auto shape = std::make_unique<Shape>(golden_shape("slats"));
  auto program =
      std::make_unique<Program>(program_of("parsel program 1\nshape \"slats\" \"\"\nlayer \"\": x1 = 0 in [-1, "
                                           "1]\nchange_count(\"t1\", amount=3*x1, anchor=fit)\n"));
  const Evaluator first(*program, *shape);
  const Evaluator second = first;
  shape.reset();
  program.reset();
  CHECK(difference(first({0.7}), second({0.7})) == 0);
  CHECK(first({0.7}).groups[RelationIndex(0)].instances.size() == 7);
}
