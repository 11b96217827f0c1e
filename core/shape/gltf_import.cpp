#include "core/shape/gltf_import.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/base/text.h"
#include "core/gltf/accessor.h"
#include "core/gltf/primitive.h"
#include "core/gltf/scene.h"
#include "core/shape/label.h"

namespace parsel {
namespace {

using nlohmann::json;

/// Modes of glTF from here on show triangles: a list, a strip, a fan.
constexpr std::size_t mode_triangles = 4, mode_triangle_fan = 6;

Error refused(std::string place, std::string cause, std::string fix = "export the model again") {
  return {"shape/gltf_import", std::move(place), std::move(cause), std::move(fix)};
}

/// Half-diagonals from the origin to the model's centre. A float has 24 bits: from 10,000 on a step of it is 0.001
/// half-diagonals, a tenth of the distance within which parts touch; nearer nothing is lost that could be seen.
constexpr double far_away = 1e4;

class Importer {
 public:
  Importer(const gltf::Document& document, const gltf::Scene& scene, const ImportLimits& limits)
      : document_(document), scene_(scene), limits_(limits) {}

  Result<ImportedModel> run() {
    note_extensions();
    note_hidden();
    for (const std::size_t node : scene_.order) {
      if (scene_.hidden[node]) continue;
      if (Status s = read_node(node); !s.ok()) return s.error();
    }
    if (model_.meshes.empty()) return nothing_shown();
    if (Status s = normalise(); !s.ok()) return s.error();
    return std::move(model_);
  }

 private:
  void warn(std::string place, std::string text) { model_.warnings.push_back({std::move(place), std::move(text)}); }

  Error nothing_shown() const {
    std::string why = "it shows no triangle mesh";
    if (!model_.warnings.empty()) why += ": " + model_.warnings[0].place + ": " + model_.warnings[0].text;
    return refused("file", why,
                   compressed_ ? "decompress it first, for instance with gltf-transform cp, or open it in the page"
                               : "open a model with triangle meshes");
  }

  /// KHR_node_visibility: a node that is not visible hides all below it.
  void note_hidden() {
    for (const std::size_t node : scene_.order) {
      const auto& parent = scene_.parent[node];
      if (!scene_.hidden[node] || (parent && scene_.hidden[*parent])) continue;
      warn("node " + std::to_string(node),
           "it and what is below it are hidden (KHR_node_visibility): they are no parts");
    }
  }

  /// Extensions that the file requires and that could change what the shape is.
  void note_extensions() {
    static const std::set<std::string> harmless = {
        "KHR_mesh_quantization", "KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual",
        "EXT_texture_webp",      "EXT_texture_avif",      "MSFT_texture_dds",   "KHR_node_visibility"};
    static const std::set<std::string> named_elsewhere = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                                          "KHR_meshopt_compression"};
    const auto required = document_.json.find("extensionsRequired");
    if (required == document_.json.end() || !required->is_array()) return;
    for (const json& entry : *required) {
      if (!entry.is_string()) continue;
      const std::string& name = entry.get_ref<const std::string&>();
      if (name.starts_with("KHR_materials_") || harmless.count(name) || named_elsewhere.count(name)) continue;
      warn("extensionsRequired", "the file requires " + printable(name) + ", which is not read");
    }
  }

  Status read_node(std::size_t index) {
    const gltf::Node& node = document_.nodes[index];
    const std::string place = "node " + std::to_string(index);
    if (!node.mesh) return success();
    if (*node.mesh >= document_.meshes.size()) {
      return refused(place, "mesh " + std::to_string(*node.mesh) + " does not exist");
    }
    if (node.skinned) warn(place, "its skin is not read: the mesh is taken in its rest pose");
    if (node.instanced) warn(place, "EXT_mesh_gpu_instancing is not read: the mesh is taken once");
    if (!scene_.world[index].matrix().allFinite()) {
      warn(place, "it was left out: its place in the scene is not finite");
      return success();
    }
    const std::size_t before = model_.meshes.size();
    for (std::size_t i = 0; i < document_.meshes[*node.mesh].primitives.size(); ++i) {
      if (Status s = read_primitive(index, i); !s.ok()) return s;
    }
    const std::string fixed = gltf::why_fixed(document_, scene_, index);
    if (!fixed.empty() && model_.meshes.size() > before) warn(place, "it stays as it is when it is edited: " + fixed);
    return success();
  }

  std::string name_of(std::size_t node_index, std::optional<std::size_t> material) const {
    const gltf::Node& node = document_.nodes[node_index];
    const json& raw = document_.json["nodes"][node_index];
    if (const auto extras = raw.find("extras"); extras != raw.end() && extras->is_object()) {
      const auto label = extras->find("label");
      if (label != extras->end() && label->is_string() && !label->get_ref<const std::string&>().empty()) {
        return label->get_ref<const std::string&>();
      }
    }
    if (!node.name.empty()) return node.name;
    const std::string& mesh = document_.meshes[*node.mesh].name;
    if (!mesh.empty()) return mesh;
    const auto materials = document_.json.find("materials");
    if (material && materials != document_.json.end() && materials->is_array() && *material < materials->size()) {
      const json& entry = (*materials)[*material];
      if (entry.is_object() && entry.contains("name") && entry["name"].is_string()) {
        return entry["name"].get_ref<const std::string&>();
      }
    }
    return "";
  }

  Status read_primitive(std::size_t node, std::size_t index) {
    const gltf::Mesh& mesh = document_.meshes[*document_.nodes[node].mesh];
    const gltf::Primitive& primitive = mesh.primitives[index];
    std::string place = "node " + std::to_string(node);
    if (mesh.primitives.size() > 1) place += ", primitive " + std::to_string(index);
    const auto leave_out = [&](const std::string& why) {
      warn(place, "it was left out: " + why);
      return success();
    };

    static const char* const modes[] = {"points", "lines", "a line loop", "a line strip"};
    if (primitive.mode < mode_triangles) return leave_out(std::string("it is made of ") + modes[primitive.mode]);
    if (primitive.mode > mode_triangle_fan) return refused(place, "its mode is none of glTF's");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return leave_out("it has no POSITION");
    if (const std::string why = gltf::unreadable(document_, primitive); !why.empty()) {
      compressed_ = compressed_ || gltf::is_compressed(document_, primitive);
      return leave_out(why);
    }

    const std::size_t vertices = gltf::accessor_count(document_, position->second);
    const std::size_t corners = primitive.indices ? gltf::accessor_count(document_, *primitive.indices) : vertices;
    const bool is_list = primitive.mode == mode_triangles;
    const std::size_t triangles = is_list ? corners / 3 : corners < 3 ? 0 : corners - 2;
    if (vertices > limits_.vertices - vertices_ || triangles > limits_.triangles - triangles_ ||
        model_.meshes.size() >= limits_.parts) {
      return refused(place,
                     "the model has more than " + std::to_string(limits_.parts) + " parts, " +
                         std::to_string(limits_.vertices) + " vertices or " + std::to_string(limits_.triangles) +
                         " triangles",
                     "simplify the model or join its small parts");
    }
    vertices_ += vertices;
    triangles_ += triangles;

    Result<std::vector<Vec3>> positions = gltf::read_positions(document_, position->second);
    if (!positions.ok()) return positions.error();
    std::vector<std::uint32_t> indices;
    if (primitive.indices) {
      Result<std::vector<std::uint32_t>> read = gltf::read_indices(document_, *primitive.indices);
      if (!read.ok()) return read.error();
      indices = std::move(*read);
    } else {
      indices.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) indices[i] = static_cast<std::uint32_t>(i);
    }

    PartMesh part;
    part.name = name_of(node, primitive.material);
    part.label = clean_label(part.name);
    part.node = static_cast<int>(node);
    part.primitive = static_cast<int>(index);
    part.world = scene_.world[node].matrix();
    part.positions = std::move(*positions);
    const Mat3 linear = scene_.world[node].linear();
    const Vec3 offset = scene_.world[node].translation();
    for (Vec3& p : part.positions) {
      p = linear * p + offset;
      if (!p.allFinite()) p.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    if (Status s = collect_triangles(part, indices, primitive.mode, place); !s.ok()) return s;
    if (part.triangles.empty()) return leave_out("it has no triangle");
    if (!primitive.targets.empty()) warn(place, "its morph targets are not read: the mesh is taken at rest");
    for (const gltf::LostAttribute& lost : gltf::lost_attributes(document_, primitive)) warn(place, lost.why);
    model_.meshes.push_back(std::move(part));
    return success();
  }

  Status collect_triangles(PartMesh& part, const std::vector<std::uint32_t>& indices, std::size_t mode,
                           const std::string& place) {
    std::size_t broken = 0;
    for (const std::uint32_t index : indices) {
      if (index >= part.positions.size()) {
        return refused(place, "index " + std::to_string(index) + " is out of range: there are " +
                                  std::to_string(part.positions.size()) + " vertices");
      }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (a == b || b == c || c == a) return;
      if (part.positions[a].hasNaN() || part.positions[b].hasNaN() || part.positions[c].hasNaN()) {
        ++broken;
      } else {
        part.triangles.push_back({a, b, c});
      }
    };
    const std::size_t n = indices.size();
    if (mode == mode_triangles) {
      part.triangles.reserve(n / 3);
      for (std::size_t i = 0; i + 3 <= n; i += 3) add(indices[i], indices[i + 1], indices[i + 2]);
    } else if (n >= 3) {
      part.triangles.reserve(n - 2);
      for (std::size_t i = 0; i + 2 < n; ++i) {
        if (mode == mode_triangle_fan) {
          add(indices[0], indices[i + 1], indices[i + 2]);
        } else {
          add(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);  // every other one is wound the other way
        }
      }
    }
    if (broken > 0) warn(place, std::to_string(broken) + " triangles were left out: a position is not a finite number");
    return success();
  }

  /// Puts all parts into the normalised frame: the box of what the triangles use is centred, half-diagonal 1.
  Status normalise() {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const PartMesh& mesh : model_.meshes) {
      for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) {
          low = low.cwiseMin(mesh.positions[v]);
          high = high.cwiseMax(mesh.positions[v]);
        }
      }
    }
    model_.frame.centre = low / 2 + high / 2;
    model_.frame.scale = (high / 2 - low / 2).norm();
    if (!model_.frame.centre.allFinite() || !(model_.frame.scale > 1e-30) || !(model_.frame.scale < 1e30)) {
      return refused("file", "its size is zero, or too small or too large to compute with",
                     "scale the model to metres");
    }
    if (model_.frame.centre.norm() > far_away * model_.frame.scale) {
      warn("file", "the model lies so far from its origin that single-precision coordinates blur it: move it there");
    }
    if (model_.meshes.size() == 1) {
      warn("file", "the model is one part, so that nothing can follow an edit of it: split it into named parts");
    }
    for (PartMesh& mesh : model_.meshes) {
      for (Vec3& p : mesh.positions) p = model_.frame.to_normalised(p);
    }
    return success();
  }

  const gltf::Document& document_;
  const gltf::Scene& scene_;
  const ImportLimits& limits_;
  ImportedModel model_;
  bool compressed_ = false;  ///< whether something was left out for that
  std::size_t vertices_ = 0, triangles_ = 0;
};

}  // namespace

Result<ImportedModel> import_gltf(std::string_view bytes, const ExternalBuffers& buffers, const ImportLimits& limits) {
  const Result<gltf::Document> document = gltf::read_document(bytes, buffers, limits);
  if (!document.ok()) return document.error();
  const Result<gltf::Scene> scene = gltf::read_scene(*document);
  if (!scene.ok()) return scene.error();
  return Importer(*document, *scene, limits).run();
}

}  // namespace parsel
