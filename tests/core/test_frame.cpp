// A model that is turned, moved, scaled or written in another order is the same model.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/tolerance.h"
#include "core/gallery/gallery.h"
#include "core/gltf/document.h"
#include "core/shape/frame.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;

namespace {

/// The file with a node above the scene's roots that carries them all, roots in another order.
std::string placed(const std::string& glb, const Eigen::Affine3d& where, std::uint64_t shuffle) {
  const auto length = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(glb[at + static_cast<std::size_t>(i)]);
    return std::size_t{value};
  };
  nlohmann::json json = nlohmann::json::parse(glb.substr(20, length(12)));
  const std::size_t binary = 20 + length(12);
  nlohmann::json& scene = json["scenes"][json.value("scene", 0)];
  std::vector<int> roots = scene["nodes"].get<std::vector<int>>();
  Random random(shuffle);
  for (std::size_t i = roots.size(); shuffle > 0 && i > 1; --i) std::swap(roots[i - 1], roots[random.below(i)]);
  std::vector<double> matrix(where.matrix().data(), where.matrix().data() + 16);
  scene["nodes"] = {json["nodes"].size()};
  json["nodes"].push_back({{"children", roots}, {"matrix", matrix}});
  return fixture::glb(json, glb.substr(binary + 8, length(binary)));
}

/// Kind, and the nodes of the parts. `ground`: what stands on the floor as well.
std::multiset<std::string> by_nodes(const Shape& shape, bool ground = true) {
  std::multiset<std::string> lines;
  for (const RelationIndex r : active_relations(shape)) {
    const Relation& relation = shape.relations[r];
    if (relation.kind == RelationKind::ground && !ground) continue;
    std::vector<std::string> parts;
    for (const PartIndex p : relation.parts) {
      std::vector<int> nodes = {shape.parts[p].node};
      for (const PartIndex m : shape.parts[p].members) nodes.push_back(shape.parts[m].node);
      std::sort(nodes.begin(), nodes.end());
      std::string text;
      for (const int node : nodes) text += " " + std::to_string(node);
      parts.push_back(text);
    }
    std::sort(parts.begin(), parts.end());
    std::string line(to_string(relation.kind));
    for (const std::string& part : parts) line += " |" + part;
    lines.insert(line);
  }
  return lines;
}

/// Corners in model units, of real parts by node.
std::map<int, Corners> boxes(const Shape& shape) {
  std::map<int, Corners> out;
  for (const Part& part : shape.parts) {
    if (part.is_virtual()) continue;
    Corners model;
    for (int k = 0; k < 8; ++k) {
      model.row(k) = shape.frame.to_model(part.hexahedron.corners.row(k).transpose()).transpose();
    }
    out[part.node] = model;
  }
  return out;
}

/// How far a corner of `before`, moved along, is from the nearest of the same part in `after`, at worst.
double furthest_corner(const std::map<int, Corners>& before, const Eigen::Affine3d& where,
                       const std::map<int, Corners>& after) {
  double worst = 0;
  for (const auto& [node, corners] : before) {
    for (int k = 0; k < 8; ++k) {
      const Vec3 moved = where * Vec3(corners.row(k).transpose());
      worst = std::max(worst, (after.at(node).rowwise() - moved.transpose()).rowwise().norm().minCoeff());
    }
  }
  return worst;
}

Eigen::Affine3d yaw(double degrees) {
  return Eigen::Affine3d(Eigen::AngleAxisd(degrees * pi / 180, Vec3::UnitY()));
}

}  // namespace

TEST_CASE("every gallery model stands along the file's axes") {
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    CHECK(fixture::abstraction(build(model)->glb, model.id).shape.frame.axes == Mat3::Identity());
  }
}

TEST_CASE("relations do not change with a model's place, size, turn and order") {
  const Eigen::Affine3d turned = yaw(30), far_turned = yaw(137);
  const Eigen::Affine3d larger(Eigen::Scaling(1000.0)), away(Eigen::Translation3d(1e4, 0, -1e4));
  int with_direction = 0;
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    const std::string glb = build(model)->glb;
    const Shape upright = fixture::abstraction(glb, model.id).shape;
    // What is round all about has no direction to be turned back to, and the boxes of a ring follow its first instance.
    const bool is_round = fixture::abstraction(placed(glb, turned, 0), model.id).shape.frame.axes == Mat3::Identity() ||
                          fixture::count(upright, RelationKind::rotation) > 0;
    with_direction += is_round ? 0 : 1;
    for (const Eigen::Affine3d& where : {turned, far_turned, larger, away, away * far_turned * larger}) {
      CAPTURE(where.matrix());
      const Shape shape = fixture::abstraction(placed(glb, where, 7), model.id).shape;
      CHECK(by_nodes(shape) == by_nodes(upright));
      if (!is_round) CHECK(furthest_corner(boxes(upright), where, boxes(shape)) < 1e-3 * shape.frame.scale);
    }
  }
  CHECK(with_direction >= 10);
}

TEST_CASE("a model that lies on a side, or its mirror image, has the same relations but for the floor's") {
  const Eigen::Affine3d on_its_back(Eigen::AngleAxisd(-pi / 2, Vec3::UnitX()));
  const Eigen::Affine3d on_a_side(Eigen::AngleAxisd(pi / 2, Vec3::UnitZ()));
  const Eigen::Affine3d mirrored(Eigen::Scaling(-1.0, 1.0, 1.0));
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    const std::string glb = build(model)->glb;
    const Shape upright = fixture::abstraction(glb, model.id).shape;
    for (const Eigen::Affine3d& where : {on_its_back, on_a_side}) {
      CAPTURE(where.matrix());
      const Shape shape = fixture::abstraction(placed(glb, where, 3), model.id).shape;
      CHECK(by_nodes(shape, false) == by_nodes(upright, false));
    }
    CHECK(by_nodes(fixture::abstraction(placed(glb, mirrored, 3), model.id).shape) == by_nodes(upright));
  }
}
