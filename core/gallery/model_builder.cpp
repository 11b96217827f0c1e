#include "core/gallery/model_builder.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace parsel::gallery {
namespace {

using Json = nlohmann::json;

double linear_from_srgb(std::uint32_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

std::string node_reference(NodeId node) {
  return "node:" + std::to_string(static_cast<int>(node));
}

Json vector_json(const Vec3& v) {
  return Json::array({v.x(), v.y(), v.z()});
}

Json seed(const char* op, NodeId part, const LocalTriple& feature) {
  return {{"op", op}, {"part", node_reference(part)}, {"feature", feature}, {"amount", "x"}};
}

Json point(NodeId part, const LocalTriple& at) {
  return {{"part", node_reference(part)}, {"at", at}};
}

}  // namespace

Eigen::Quaterniond turn(const Vec3& axis, double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
}

ModelBuilder::ModelBuilder(const GalleryModel& model, GalleryValues values, const NominalSizes* nominal)
    : model_(model), values_(std::move(values)), nominal_(nominal) {
  scene_.name = model.title;
}

double ModelBuilder::operator[](std::string_view parameter) const {
  const auto found = values_.find(parameter);
  PARSEL_ASSERT(found != values_.end(), "the model declares this parameter");
  return found->second;
}

int ModelBuilder::count(std::string_view parameter) const {
  return static_cast<int>(std::lround((*this)[parameter]));
}

MaterialId ModelBuilder::material(const Finish& finish) {
  const Vec3 linear(linear_from_srgb(finish.colour >> 16 & 0xff), linear_from_srgb(finish.colour >> 8 & 0xff),
                    linear_from_srgb(finish.colour & 0xff));
  scene_.materials.push_back({finish.name, linear, finish.roughness, finish.metallic});
  return static_cast<MaterialId>(scene_.materials.size() - 1);
}

MeshId ModelBuilder::mesh(const std::string& name, const Vec3& size, MaterialId material, const Solid& solid) {
  PARSEL_ASSERT(sizes_.count(name) == 0, "mesh names are unique");
  PARSEL_ASSERT(size.minCoeff() > 0, "a part has a positive size");
  sizes_[name] = size;
  boxes_.push_back(size);
  GlbMesh made{name, {{{}, static_cast<int>(material)}}};
  if (nominal_ != nullptr) {
    // A mesh that the default state lacks has no nominal size but its own.
    const auto found = nominal_->find(name);
    const Vec3 nominal = found == nominal_->end() ? size : found->second;
    TriangleMesh& mesh = made.primitives.front().mesh;
    mesh = solid(nominal);
    const Vec3 stretch = size.cwiseQuotient(nominal);
    for (Vec3& p : mesh.positions) p = p.cwiseProduct(stretch);
    for (Vec3& n : mesh.normals) n = n.cwiseQuotient(stretch).normalized();
  }
  scene_.meshes.push_back(std::move(made));
  return static_cast<MeshId>(boxes_.size() - 1);
}

NodeId ModelBuilder::frame(const std::string& name, const Placement& placement, NodeId parent) {
  const int index = static_cast<int>(scene_.nodes.size());
  GlbNode node;
  node.name = name;
  node.translation = placement.translation;
  node.rotation = placement.rotation;
  scene_.nodes.push_back(std::move(node));
  parents_.push_back(static_cast<int>(parent));
  labels_.emplace_back();
  if (parent != NodeId::none) scene_.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
  return static_cast<NodeId>(index);
}

NodeId ModelBuilder::part(const std::string& label, MeshId mesh, const Placement& placement, NodeId parent,
                          const std::string& name) {
  const NodeId node = frame(name.empty() ? label : name, placement, parent);
  scene_.nodes.back().mesh = static_cast<int>(mesh);
  labels_.back() = label;
  return node;
}

void ModelBuilder::label_by_extras(NodeId node, const std::string& name) {
  GlbNode& target = scene_.nodes[static_cast<std::size_t>(node)];
  target.label = labels_[static_cast<std::size_t>(node)];
  target.name = name;
}

void ModelBuilder::reflect(int axis, std::initializer_list<std::pair<NodeId, NodeId>> pairs) {
  for (const auto& [a, b] : pairs) {
    relations_.push_back({RelationKind::reflection, {Side(a).nodes, Side(b).nodes}, axis});
  }
}

Side ModelBuilder::translation(const std::vector<NodeId>& instances) {
  PARSEL_ASSERT(instances.size() > 2, "a translation group has more than two instances");
  GalleryRelation relation{RelationKind::translation, {}, -1};
  std::vector<int> nodes;
  for (const NodeId node : instances) {
    relation.parts.push_back(Side(node).nodes);
    nodes.push_back(static_cast<int>(node));
  }
  relations_.push_back(std::move(relation));
  return Side(std::move(nodes));
}

Side ModelBuilder::rotation(const std::vector<NodeId>& instances) {
  Side group = translation(instances);
  relations_.back().kind = RelationKind::rotation;
  return group;
}

void ModelBuilder::stand(std::initializer_list<Side> parts) {
  for (const Side& part : parts) relations_.push_back({RelationKind::ground, {part.nodes}, -1});
}

void ModelBuilder::attach(const Side& a, const Side& b, RelationKind kind) {
  PARSEL_ASSERT(kind >= RelationKind::point && kind <= RelationKind::volume,
                "an attachment is a point, line, face or volume");
  relations_.push_back({kind, {a.nodes, b.nodes}, -1});
}

void ModelBuilder::attach(std::initializer_list<Side> a, std::initializer_list<Side> b, RelationKind kind) {
  for (const Side& one : a) {
    for (const Side& other : b) attach(one, other, kind);
  }
}

Eigen::Affine3d ModelBuilder::world(int node) const {
  const auto index = static_cast<std::size_t>(node);
  const GlbNode& n = scene_.nodes[index];
  const Eigen::Affine3d local = Eigen::Translation3d(n.translation) * n.rotation;
  return parents_[index] < 0 ? local : world(parents_[index]) * local;
}

std::vector<GalleryPart> ModelBuilder::parts() const {
  std::vector<GalleryPart> parts;
  for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
    if (scene_.nodes[n].mesh < 0) continue;
    const Vec3 half = boxes_[static_cast<std::size_t>(scene_.nodes[n].mesh)] / 2;
    const Eigen::Affine3d to_world = world(static_cast<int>(n));
    GalleryPart part{static_cast<int>(n), 0, labels_[n], Corners::Zero()};
    for (int k = 0; k < 8; ++k) {
      part.corners.row(k) =
          to_world * Vec3(corner_sign(k, 0) * half.x(), corner_sign(k, 1) * half.y(), corner_sign(k, 2) * half.z());
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

Frame ModelBuilder::bounds() const {
  // Over the vertices: the corners of a tilted part's box reach further than the part.
  Vec3 low = Vec3::Constant(1e30), high = -low;
  for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
    if (scene_.nodes[n].mesh < 0) continue;
    const Eigen::Affine3d to_world = world(static_cast<int>(n));
    for (const GlbPrimitive& primitive : scene_.meshes[static_cast<std::size_t>(scene_.nodes[n].mesh)].primitives) {
      for (const Vec3& p : primitive.mesh.positions) {
        low = low.cwiseMin(to_world * p);
        high = high.cwiseMax(to_world * p);
      }
    }
  }
  return {(low + high) / 2, (high - low).norm() / 2};
}

void ModelBuilder::edit(EditDraft draft, std::function<GalleryValues(double)> values) {
  Json json = {{"seed", Json::array()}, {"disabled", draft.disabled}, {"hints", Json::object()}};
  for (const std::string& statement : draft.seed) json["seed"].push_back(Json::parse(statement));
  for (const auto& [side, hint] : draft.hints) {
    // The virtual part of a group has no node; its id is made of its instances' label.
    const auto first = static_cast<std::size_t>(side.nodes.front());
    const std::string part = side.nodes.size() > 1 ? labels_[first] + "_group" : "node:" + std::to_string(first);
    json["hints"][part] = hint;
  }
  edits_.push_back({std::move(draft.id), std::move(draft.request), json.dump(), std::move(values)});
}

GalleryAsset ModelBuilder::finish() const {
  return {model_.id, write_glb(scene_), bounds(), parts(), relations_, edits_};
}

std::string seed_translate(NodeId part, const Vec3& direction, LocalTriple feature, const std::string& amount) {
  Json json = seed("translate", part, feature);
  json["amount"] = amount;
  json["direction"] = vector_json(direction);
  return json.dump();
}

std::string seed_scale_1d(NodeId part, const Vec3& direction, LocalTriple at) {
  Json json = seed("scale_1d", part, {0, 0, 0});
  json["origin"] = point(part, at);
  json["direction"] = vector_json(direction);
  return json.dump();
}

std::string seed_scale_2d(NodeId part, const Vec3& normal, LocalTriple at) {
  Json json = seed("scale_2d", part, {0, 0, 0});
  json["origin"] = point(part, at);
  json["normal"] = vector_json(normal);
  return json.dump();
}

std::string seed_scale_3d(NodeId part, LocalTriple at) {
  Json json = seed("scale_3d", part, {0, 0, 0});
  json["origin"] = point(part, at);
  return json.dump();
}

std::string seed_rotate(NodeId part, const Vec3& axis, LocalTriple at) {
  Json json = seed("rotate", part, {0, 0, 0});
  json["origin"] = point(part, at);
  json["axis"] = vector_json(axis);
  return json.dump();
}

std::string seed_change_count(const std::string& relation, const std::string& anchor, const std::string& amount) {
  return Json{{"op", "change_count"}, {"relation", relation}, {"anchor", anchor}, {"amount", amount}}.dump();
}

std::string seed_change_delta(const std::string& relation, const std::string& anchor) {
  return Json{{"op", "change_delta"}, {"relation", relation}, {"anchor", anchor}, {"amount", "x"}}.dump();
}

}  // namespace parsel::gallery
