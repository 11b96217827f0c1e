// What a model's generator writes with: parameters, materials, meshes, nodes, and the truth about them.
#pragma once

#include <Eigen/Geometry>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/gallery/gallery.h"
#include "core/gallery/glb_writer.h"
#include "core/gallery/palette.h"
#include "core/gallery/solid.h"

namespace parsel::gallery {

enum class MaterialId : int {};
enum class MeshId : int {};
/// A glTF node: a part, or a frame that carries parts.
enum class NodeId : int { none = -1 };

/// A part of a relation: one node, or the virtual part of a group (its instances in order).
struct Side {
  Side(NodeId node) : nodes{static_cast<int>(node)} {}
  explicit Side(std::vector<int> instances) : nodes(std::move(instances)) {}
  std::vector<int> nodes;
};

struct Placement {
  Placement(const Vec3& at) : translation(at) {}
  Placement(double x, double y, double z) : translation(x, y, z) {}
  Placement(const Vec3& at, const Eigen::Quaterniond& turn) : translation(at), rotation(turn) {}

  Vec3 translation;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
};

/// A turn of `angle` radians about a unit axis.
Eigen::Quaterniond turn(const Vec3& axis, double angle);

/// Sizes of all meshes in the model's default state, by mesh name.
using NominalSizes = std::map<std::string, Vec3, std::less<>>;

/// The seeds and hints of an edit, in the words of parsel/edit v1.
struct EditDraft {
  std::string id, request;
  std::vector<std::string> seed;      ///< JSON objects, from the seed_ functions
  std::vector<std::string> disabled;  ///< relation ids or "kind:reflection"
  std::vector<std::pair<Side, std::string>> hints;
};

class ModelBuilder {
 public:
  /// `nominal` null: this run only measures the sizes of meshes, no mesh is made.
  ModelBuilder(const GalleryModel& model, GalleryValues values, const NominalSizes* nominal);

  double operator[](std::string_view parameter) const;
  int count(std::string_view parameter) const;

  MaterialId material(const Finish& finish);
  /// A mesh of `size` metres: the solid made at the nominal size of this name, stretched to `size`. Names are unique.
  MeshId mesh(const std::string& name, const Vec3& size, MaterialId material, const Solid& solid);

  /// A node without a mesh.
  NodeId frame(const std::string& name, const Placement& placement, NodeId parent = NodeId::none);
  /// A node with a mesh: a part. `name`, the label unless given, may carry a counter that is no part of the label.
  NodeId part(const std::string& label, MeshId mesh, const Placement& placement, NodeId parent = NodeId::none,
              const std::string& name = "");
  /// Writes the label into extras and gives the node a meaningless name.
  void label_by_extras(NodeId node, const std::string& name);

  // The truth.
  /// Parts that are mirror images about a plane across `axis`. Instances of one group are not stated again as pairs.
  void reflect(int axis, std::initializer_list<std::pair<NodeId, NodeId>> pairs);
  /// Three or more parts at equal distances, in order.
  Side translation(const std::vector<NodeId>& instances);
  /// Three or more parts on a closed ring, in order.
  Side rotation(const std::vector<NodeId>& instances);
  /// Parts that stand on the floor.
  void stand(std::initializer_list<Side> parts);
  void attach(const Side& a, const Side& b, RelationKind kind);
  void attach(std::initializer_list<Side> a, std::initializer_list<Side> b, RelationKind kind);

  /// Metres for one unit of the normalised frame; only after all parts are placed.
  double half_diagonal() const { return bounds().scale; }
  void edit(EditDraft draft, std::function<GalleryValues(double)> values);

  GalleryAsset finish() const;
  const NominalSizes& sizes() const { return sizes_; }

 private:
  Eigen::Affine3d world(int node) const;
  std::vector<GalleryPart> parts() const;
  Frame bounds() const;

  const GalleryModel& model_;
  GalleryValues values_;
  const NominalSizes* nominal_;
  NominalSizes sizes_;
  GlbScene scene_;
  std::vector<Vec3> boxes_;          // size by mesh
  std::vector<int> parents_;         // by node
  std::vector<std::string> labels_;  // by node
  std::vector<GalleryRelation> relations_;
  std::vector<GalleryEdit> edits_;
};

// Seed statements, amount x unless given. `at` names the origin's local triple; `feature` what is moved.
std::string seed_translate(NodeId part, const Vec3& direction, LocalTriple feature = {0, 0, 0},
                           const std::string& amount = "x");
std::string seed_scale_1d(NodeId part, const Vec3& direction, LocalTriple at = {0, 0, 0});
std::string seed_scale_2d(NodeId part, const Vec3& normal, LocalTriple at = {0, 0, 0});
std::string seed_scale_3d(NodeId part, LocalTriple at = {0, 0, 0});
std::string seed_rotate(NodeId part, const Vec3& axis, LocalTriple at);
std::string seed_change_count(const std::string& relation, const std::string& anchor, const std::string& amount);
std::string seed_change_delta(const std::string& relation, const std::string& anchor);

}  // namespace parsel::gallery
