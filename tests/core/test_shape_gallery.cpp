// The relations found in every gallery model against those that its generator knows: kinds, members and orders.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/gallery/gallery.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;

namespace {

/// Node indices in brackets, sorted: "[3 4 5]".
std::string nodes_text(std::vector<int> nodes) {
  std::sort(nodes.begin(), nodes.end());
  std::string text = "[";
  for (const int node : nodes) text += (text.size() > 1 ? " " : "") + std::to_string(node);
  return text + "]";
}

std::string line(RelationKind kind, std::vector<std::string> parts, int axis) {
  std::sort(parts.begin(), parts.end());
  std::string text(to_string(kind));
  for (const std::string& part : parts) text += " " + part;
  if (kind == RelationKind::reflection) text += std::string(" across ") + "xyz"[axis];
  return text;
}

std::set<std::string> expected(const GalleryAsset& asset) {
  std::set<std::string> lines;
  for (const GalleryRelation& relation : asset.relations) {
    std::vector<std::string> parts;
    for (const std::vector<int>& nodes : relation.parts) parts.push_back(nodes_text(nodes));
    lines.insert(line(relation.kind, parts, relation.axis));
  }
  return lines;
}

std::set<std::string> found(const Shape& shape) {
  std::set<std::string> lines;
  for (const RelationIndex r : active_relations(shape)) {
    const Relation& relation = shape.relations[r];
    std::vector<std::string> parts;
    for (const PartIndex p : relation.parts) {
      std::vector<int> nodes;
      for (const PartIndex m : shape.parts[p].members) nodes.push_back(shape.parts[m].node);
      if (nodes.empty()) nodes.push_back(shape.parts[p].node);
      parts.push_back(nodes_text(nodes));
    }
    int axis = -1;
    if (const auto* reflection = std::get_if<Reflection>(&relation.detail)) reflection->normal.maxCoeff(&axis);
    lines.insert(line(relation.kind, parts, axis));
  }
  return lines;
}

std::string difference(const std::set<std::string>& truth, const std::set<std::string>& relations, const Shape& shape) {
  std::string text;
  for (const std::string& l : truth) {
    if (relations.count(l) == 0) text += "  missing: " + l + "\n";
  }
  for (const std::string& l : relations) {
    if (truth.count(l) == 0) text += "  unknown: " + l + "\n";
  }
  if (text.empty()) return text;
  for (const Part& part : shape.parts) {
    if (!part.is_virtual()) text += "  node " + std::to_string(part.node) + " is " + part.id + "\n";
  }
  return text;
}

}  // namespace

TEST_CASE("the relations of every gallery model are those of its generator") {
  for (const GalleryModel& model : gallery_models()) {
    const Result<GalleryAsset> asset = build(model);
    REQUIRE(asset.ok());
    const Abstraction abstraction = fixture::abstraction(asset->glb, asset->id);
    CHECK(abstraction.shape.warnings.empty());
    const std::string off = difference(expected(*asset), found(abstraction.shape), abstraction.shape);
    CHECK_MESSAGE(off.empty(), model.id << ":\n" << off);
  }
}
