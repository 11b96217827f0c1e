// A model that is turned, moved, scaled or written in another order is the same model.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
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

/// Kind, and the nodes of the parts.
std::multiset<std::string> by_nodes(const Shape& shape) {
  std::multiset<std::string> lines;
  for (const RelationIndex r : active_relations(shape)) {
    const Relation& relation = shape.relations[r];
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
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    const std::string glb = build(model)->glb;
    const Shape upright = fixture::abstraction(glb, model.id).shape;
    for (const Eigen::Affine3d& where : {turned, far_turned, larger, away, away * far_turned * larger}) {
      CAPTURE(where.matrix());
      const Shape shape = fixture::abstraction(placed(glb, where, 7), model.id).shape;
      CHECK(by_nodes(shape) == by_nodes(upright));
    }
  }
}
