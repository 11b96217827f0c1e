// Compares what a gallery model's generator knows about it with a shape that was found from its file.
#pragma once

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/gallery/gallery.h"

namespace parsel::test {

namespace detail {

/// "leg#4", or "slat#7..#11" for the virtual part of a group.
inline std::string part_text(const GalleryAsset& asset, std::vector<int> nodes) {
  std::sort(nodes.begin(), nodes.end());
  const auto found = std::find_if(asset.parts.begin(), asset.parts.end(),
                                  [&](const GalleryPart& part) { return part.node == nodes.front(); });
  std::string text = (found == asset.parts.end() ? "?" : found->label) + "#" + std::to_string(nodes.front());
  if (nodes.size() > 1) text += "..#" + std::to_string(nodes.back());
  return text;
}

/// The instances in order, from a canonical first one: a row read backwards, or a ring from elsewhere, is the same.
inline std::vector<int> canonical_order(std::vector<int> nodes, bool is_ring) {
  if (is_ring) std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
  const auto first = nodes.begin() + (is_ring ? 1 : 0);
  if (*first > nodes.back()) std::reverse(first, nodes.end());
  return nodes;
}

inline std::string relation_text(const GalleryAsset& asset, const GalleryRelation& relation) {
  std::ostringstream text;
  text << to_string(relation.kind);
  if (relation.kind == RelationKind::translation || relation.kind == RelationKind::rotation) {
    std::vector<int> nodes;
    for (const auto& part : relation.parts) nodes.push_back(part.front());
    for (const int node : canonical_order(nodes, relation.kind == RelationKind::rotation)) {
      text << ' ' << part_text(asset, {node});
    }
    return text.str();
  }
  if (relation.axis >= 0)
    text << " across "
         << "xyz"[relation.axis];
  std::vector<std::string> names;
  for (const auto& part : relation.parts) names.push_back(part_text(asset, part));
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) text << ' ' << name;
  return text.str();
}

inline GalleryRelation as_gallery_relation(const Shape& shape, const Relation& relation) {
  GalleryRelation out{relation.kind, {}, -1};
  for (const PartIndex p : relation.parts) {
    const Part& part = shape.parts[p];
    std::vector<int> nodes;
    for (const PartIndex member : part.members) nodes.push_back(shape.parts[member].node);
    if (!part.is_virtual()) nodes.push_back(part.node);
    out.parts.push_back(std::move(nodes));
  }
  if (relation.kind == RelationKind::reflection) {
    std::get<Reflection>(relation.detail).normal.cwiseAbs().maxCoeff(&out.axis);
  }
  return out;
}

}  // namespace detail

/// One line for every relation that only one side has ("missing …", "unexpected …"), sorted; empty when they agree.
/// Attachments and ground of single instances of a group are left out: they count only once an edit dissolves the
/// group.
inline std::vector<std::string> relation_differences(const GalleryAsset& asset, const Shape& shape) {
  std::multiset<std::string> expected, found;
  for (const GalleryRelation& relation : asset.relations) expected.insert(detail::relation_text(asset, relation));
  const auto is_instance = [&](PartIndex p) { return shape.parts[p].group && !shape.parts[p].is_virtual(); };
  for (const Relation& relation : shape.relations) {
    if (!relation.is_symmetry() && std::any_of(relation.parts.begin(), relation.parts.end(), is_instance)) continue;
    found.insert(detail::relation_text(asset, detail::as_gallery_relation(shape, relation)));
  }
  std::vector<std::string> missing, unexpected, lines;
  std::set_difference(expected.begin(), expected.end(), found.begin(), found.end(), std::back_inserter(missing));
  std::set_difference(found.begin(), found.end(), expected.begin(), expected.end(), std::back_inserter(unexpected));
  for (const std::string& text : missing) lines.push_back("missing " + text);
  for (const std::string& text : unexpected) lines.push_back("unexpected " + text);
  return lines;
}

/// One line for every part whose box, as a set of corners, is off by more than `tolerance` of the half-diagonal, that
/// has another label, or that only one side has.
inline std::vector<std::string> part_differences(const GalleryAsset& asset, const Shape& shape, double tolerance) {
  std::vector<std::string> lines;
  std::size_t real_parts = 0;
  for (const Part& part : shape.parts) real_parts += part.is_virtual() ? 0 : 1;
  if (real_parts != asset.parts.size()) {
    lines.push_back(std::to_string(real_parts) + " parts instead of " + std::to_string(asset.parts.size()));
  }
  for (const GalleryPart& expected : asset.parts) {
    const auto found = std::find_if(shape.parts.begin(), shape.parts.end(), [&](const Part& part) {
      return part.node == expected.node && part.primitive == expected.primitive;
    });
    const std::string name = detail::part_text(asset, {expected.node});
    if (found == shape.parts.end()) {
      lines.push_back("missing part " + name);
      continue;
    }
    if (found->label != expected.label) lines.push_back(name + " has the label " + found->label);
    double worst = 0;
    for (int k = 0; k < 8; ++k) {
      const Vec3 corner = asset.frame.to_normalised(expected.corners.row(k).transpose());
      const double nearest = (found->hexahedron.corners.rowwise() - corner.transpose()).rowwise().norm().minCoeff();
      worst = std::max(worst, nearest);
    }
    if (worst > tolerance) lines.push_back(name + " has a box that is off by " + std::to_string(worst));
  }
  return lines;
}

}  // namespace parsel::test
