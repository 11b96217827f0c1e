// The animation against the states that it plays, sampled between its keys.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <functional>
#include <iostream>

#include "core/export/apply_sweep.h"
#include "tests/core/apply_fixture.h"

using namespace parsel;
using namespace parsel::apply_fixture;

namespace {

/// Plays the animation of a file as glTF says: linear interpolation, spherical for rotations, or steps.
class Player {
 public:
  explicit Player(const std::string& glb) : file_(read(glb)), json_(json_of(glb)) {}

  double duration() const {
    double last = 0;
    for (const auto& sampler : json_["animations"][0]["samplers"])
      last = std::max(last, numbers(sampler["input"]).back());
    return last;
  }

  /// World positions of all vertices of the node's primitives at a time. The node's ancestors stand still.
  std::vector<Vec3> positions(std::size_t node, double time) const {
    gltf::Placement at = gltf::transform_of(file_.item("nodes", node)).placement;
    std::vector<double> weights;
    for (const auto& channel : json_["animations"][0]["channels"]) {
      if (channel["target"]["node"] != node) continue;
      const auto& sampler = json_["animations"][0]["samplers"][channel["sampler"].get<std::size_t>()];
      const std::string path = channel["target"]["path"];
      const auto value = sample(sampler, time, path == "rotation");
      if (path == "translation") at.translation = Vec3(value[0], value[1], value[2]);
      if (path == "scale") at.scale = Vec3(value[0], value[1], value[2]);
      if (path == "rotation") at.rotation = Eigen::Quaterniond(value[3], value[0], value[1], value[2]);
      if (path == "weights") weights = value;
    }
    const auto scene = gltf::read_scene(file_.original);
    const bool fixed = file_.item("nodes", node).has("matrix");
    const Eigen::Affine3d world = fixed ? scene->world[node] : scene->parent_world(node) * at.matrix();
    std::vector<Vec3> out;
    const auto& mesh = json_["meshes"][json_["nodes"][node]["mesh"].get<std::size_t>()];
    for (const auto& primitive : mesh["primitives"]) {
      std::vector<Vec3> points = vectors(file_, primitive["attributes"]["POSITION"]);
      for (std::size_t t = 0; t < weights.size(); ++t) {
        const std::vector<Vec3> deltas = vectors(file_, primitive["targets"][t]["POSITION"]);
        for (std::size_t i = 0; i < points.size(); ++i) points[i] += weights[t] * deltas[i];
      }
      for (const Vec3& p : points) out.push_back(world * p);
    }
    return out;
  }

 private:
  std::vector<double> numbers(std::size_t accessor) const { return *gltf::read_accessor(file_.original, accessor); }

  std::vector<double> sample(const ordered_json& sampler, double time, bool rotation) const {
    const std::vector<double> times = numbers(sampler["input"]), values = numbers(sampler["output"]);
    const std::size_t n = values.size() / times.size();
    std::size_t next = 0;
    while (next < times.size() && times[next] <= time) ++next;
    const auto key = [&](std::size_t i) {
      return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(i * n),
                                 values.begin() + static_cast<std::ptrdiff_t>((i + 1) * n));
    };
    if (next == 0) return key(0);
    if (next == times.size() || sampler["interpolation"] == "STEP") return key(next - 1);
    std::vector<double> a = key(next - 1), b = key(next);
    const double t = (time - times[next - 1]) / (times[next] - times[next - 1]);
    if (rotation) {
      const Eigen::Quaterniond q =
          Eigen::Quaterniond(a[3], a[0], a[1], a[2]).slerp(t, Eigen::Quaterniond(b[3], b[0], b[1], b[2]));
      return {q.x(), q.y(), q.z(), q.w()};
    }
    for (std::size_t i = 0; i < n; ++i) a[i] += t * (b[i] - a[i]);
    return a;
  }

  gltf::File file_;
  ordered_json json_;
};

using Motion = std::function<Vec3(double x, const Vec3& corner)>;

/// A part on its own in a node, moved by a function of the parameter x in [-1, 1]; the file is saved at x = `at`.
struct Moving {
  Glb glb;
  Shape shape;
  Motion motion;
  std::vector<Vec3> points = grid(Vec3(-0.3, -0.5, -0.2), Vec3(0.3, 0.5, 0.2), 3);
  Eigen::Affine3d world = Eigen::Affine3d::Identity();

  explicit Moving(Motion how, bool as_matrix = false) : motion(std::move(how)) {
    world.translate(Vec3(0.2, 0, 0.1)).rotate(Eigen::AngleAxisd(0.5, Vec3::UnitZ()));
    const std::vector<Vec3> normals(points.size(), Vec3::UnitX());
    const std::size_t position = glb.vectors(points), normal = glb.vectors(normals, false);
    const std::size_t mesh = glb.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}});
    if (as_matrix) {
      ordered_json matrix;
      for (int i = 0; i < 16; ++i) matrix.push_back(world.matrix()(i % 4, i / 4));
      glb.node({{"mesh", mesh}, {"matrix", matrix}});
    } else {
      glb.node({{"mesh", mesh}, {"translation", {0.2, 0, 0.1}}, {"rotation", {0, 0, std::sin(0.25), std::cos(0.25)}}});
    }
    const Corners rest = box(Vec3(-0.3, -0.5, -0.2), Vec3(0.3, 0.5, 0.2));
    add_part(shape, 0, mapped(rest, [&](const Vec3& p) { return world * p; }));
  }

  State state(double x) const {
    State out = resting(shape);
    out.parts[PartIndex(0)] = mapped(out.parts[PartIndex(0)], [&](const Vec3& p) { return motion(x, p); });
    return out;
  }

  std::string animated(double at) const {
    ApplyOptions options;
    options.sweep = Sweep{"x1", {}, 2};
    for (int i = 0; i <= 256; ++i) options.sweep->samples.push_back(state(-1 + i / 128.0));
    const auto out = apply_state(glb.bytes(), shape, state(at), options);
    REQUIRE_MESSAGE(out.ok(), (out.ok() ? "" : out.error().message()));
    CHECK(out->warnings.empty());
    return out->glb;
  }

  /// Where the vertices are by the state itself, through a file that was saved there.
  std::vector<Vec3> truth(double x) const {
    const auto out = apply_state(glb.bytes(), shape, state(x));
    REQUIRE(out.ok());
    return world_positions(out->glb, 0);
  }

  /// Largest distance of a vertex from where it should be, on the way there and back, between the keys as well.
  double error(const std::string& file) const {
    const Player player(file);
    CHECK(player.duration() == doctest::Approx(4));
    double worst = 0;
    for (int i = 0; i <= 61; ++i) {
      const double time = 4.0 * i / 61;
      const double x = time < 2 ? time - 1 : 3 - time;
      worst = std::max(worst, furthest(player.positions(0, time), truth(x)));
    }
    return worst;
  }
};

}  // namespace

TEST_CASE("apply: the animation stays within 0.2 % of the half-diagonal") {
  Motion motion;
  std::vector<std::string> paths;
  std::size_t targets = 0, keys = 0;
  bool matrix = false;
  SUBCASE("translation: two keys") {
    motion = [](double x, const Vec3& p) { return Vec3(p + Vec3(0.3 * x, 0, 0.1 * x)); };
    paths = {"translation"};
    keys = 3;  // there and back
  }
  SUBCASE("rotation about a distant axis") {
    motion = [](double x, const Vec3& p) {
      return Vec3(Eigen::AngleAxisd(x, Vec3::UnitY()) * (p - Vec3(0.5, 0, 0)) + Vec3(0.5, 0, 0));
    };
    paths = {"translation", "rotation"};
  }
  SUBCASE("scale along the node's axis") {
    motion = [](double x, const Vec3& p) {
      const Vec3 n(std::cos(0.5), std::sin(0.5), 0);
      return Vec3(p + 0.4 * x * n.dot(p) * n);
    };
    paths = {"translation", "scale"};
    keys = 3;
  }
  SUBCASE("scale across the node's axes: one morph target") {
    motion = [](double x, const Vec3& p) { return Vec3(p[0] * (1 + 0.4 * x), p[1], p[2]); };
    paths = {"weights"};
    targets = 1;
    keys = 3;
  }
  SUBCASE("a node with a matrix: a turn is two morph targets") {
    motion = [](double x, const Vec3& p) { return Vec3(Eigen::AngleAxisd(x, Vec3::UnitX()) * p); };
    paths = {"weights"};
    targets = 2;
    matrix = true;
  }
  SUBCASE("a face on a curve: two morph targets") {
    motion = [](double x, const Vec3& p) {
      return p[1] < 0 ? p : Vec3(p + Vec3(0.3 * std::sin(2 * x), 0.3 * x * x, 0));
    };
    paths = {"weights"};
    targets = 2;
  }
  const Moving model(motion, matrix);
  for (const double at : {0.0, 0.4}) {
    const std::string file = model.animated(at);
    CHECK(furthest(world_positions(file, 0), model.truth(at)) < 1e-6);
    const double worst = model.error(file);
    CHECK(worst < apply::sweep_error);
    const ordered_json animation = json_of(file)["animations"][0];
    CHECK(animation["name"] == "x1");
    std::vector<std::string> found;
    for (const auto& channel : animation["channels"]) found.push_back(channel["target"]["path"]);
    CHECK(found == paths);
    const ordered_json json = json_of(file);
    const auto input = json["accessors"][animation["samplers"][0]["input"].get<std::size_t>()];
    CHECK(input["count"].get<std::size_t>() < 70);
    if (keys > 0) CHECK(input["count"] == keys);
    const auto& primitive = json["meshes"][0]["primitives"][0];
    CHECK((primitive.contains("targets") ? primitive["targets"].size() : 0) == targets);
    if (targets > 0) CHECK(primitive["targets"][0].contains("NORMAL"));
  }
}

TEST_CASE("apply: an animation of nothing is left out") {
  const Moving model([](double, const Vec3& p) { return p; });
  ApplyOptions options;
  options.sweep = Sweep{"x1", {model.state(-1), model.state(1)}, 2};
  const auto out = apply_state(model.glb.bytes(), model.shape, model.state(0), options);
  REQUIRE(out.ok());
  CHECK(out->glb == model.glb.bytes());
  CHECK(out->warnings.size() == 1);
}

TEST_CASE("apply: instances come and go in the animation") {
  Glb glb;
  Shape shape;
  const Vec3 low(-0.1, -0.1, -0.1), high(0.1, 0.1, 0.1);
  const std::size_t mesh = glb.mesh({{"attributes", {{"POSITION", glb.vectors(grid(low, high, 1))}}}});
  for (int i = 0; i < 2; ++i) {
    glb.node({{"name", "slat"}, {"mesh", mesh}, {"translation", {i, 0, 0}}});
    add_part(shape, static_cast<std::size_t>(i), box(low + Vec3(i, 0, 0), high + Vec3(i, 0, 0)));
  }
  shape.relations.push_back({"t1",
                             RelationKind::translation,
                             {PartIndex(0), PartIndex(1)},
                             Translation{PartIndex(0), Vec3::Zero(), Vec3::Zero(), 0, 1}});
  const auto state = [&](std::size_t count) {
    State out = resting(shape);
    GroupState& group = out.groups[RelationIndex(0)];
    group.count_changed = count != 2;
    group.source = count == 2 ? -1 : 0;
    group.instances.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 at(static_cast<double>(i), 0, 0);
      group.instances.push_back(box(low + at, high + at));
    }
    return out;
  };
  ApplyOptions options;
  options.sweep = Sweep{"count", {}, 1};
  for (const std::size_t count : {1, 1, 2, 2, 3}) options.sweep->samples.push_back(state(count));
  const auto out = apply_state(glb.bytes(), shape, state(2), options);
  REQUIRE(out.ok());
  const ordered_json json = json_of(out->glb);
  REQUIRE(json["nodes"].size() == 3);
  CHECK(json["nodes"][2]["scale"] == ordered_json({0, 0, 0}));
  CHECK(json["nodes"][2]["mesh"] == mesh);
  const Player player(out->glb);
  const auto size = [&](std::size_t node, double time) {
    const std::vector<Vec3> points = player.positions(node, time);
    return (points.back() - points.front()).norm();
  };
  const double full = (high - low).norm();
  CHECK(size(0, 0.1) == doctest::Approx(full));
  CHECK(size(1, 0.1) == 0);
  CHECK(size(1, 0.6) == doctest::Approx(full));
  CHECK(size(2, 0.6) == 0);
  CHECK(size(2, 1.0) == doctest::Approx(full));
  CHECK((player.positions(2, 1.0)[0] - (low + Vec3(2, 0, 0))).norm() < 1e-6);
  CHECK(size(2, 1.4) == 0);
  CHECK(size(1, 1.9) == 0);
}

TEST_CASE("apply: a mesh with morph targets of its own is not animated by further ones") {
  Moving model([](double x, const Vec3& p) { return Vec3(p[0] * (1 + 0.4 * x), p[1], p[2]); });
  const std::size_t delta = model.glb.vectors(model.points);
  model.glb.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", delta}}};
  ApplyOptions options;
  options.sweep = Sweep{"x1", {model.state(-1), model.state(1)}, 2};
  const auto out = apply_state(model.glb.bytes(), model.shape, model.state(0), options);
  REQUIRE(out.ok());
  CHECK(out->warnings.size() == 2);
  CHECK(out->glb == model.glb.bytes());
}
