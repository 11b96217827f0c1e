#include "core/gallery/glb_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace parsel::gallery {
namespace {

using Json = nlohmann::json;

// Values of the glTF 2.0 specification.
constexpr std::uint32_t magic_gltf = 0x46546C67, magic_json = 0x4E4F534A, magic_bin = 0x004E4942;
constexpr int target_vertices = 34962, target_indices = 34963;
constexpr int type_float = 5126, type_u16 = 5123, type_u32 = 5125;

constexpr double position_grid = 1e-6, normal_grid = 1e-5;

double on_grid(double value, double grid) {
  const double snapped = std::round(value / grid) * grid;
  return snapped == 0 ? 0.0 : snapped;  // no negative zero
}

Json to_json(const Vec3& v) {
  // Through text with few digits: 0.1 rather than 0.10000000000000001 times the grid.
  Json array = Json::array();
  for (int i = 0; i < 3; ++i) array.push_back(std::round(v[i] * 1e6) / 1e6 + 0.0);
  return array;
}

class BinaryChunk {
 public:
  std::size_t size() const { return bytes_.size(); }
  void put_u32(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes_.push_back(static_cast<char>(value >> shift & 0xff));
  }
  void put_u16(std::uint32_t value) {
    for (int shift = 0; shift < 16; shift += 8) bytes_.push_back(static_cast<char>(value >> shift & 0xff));
  }
  void put_float(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    put_u32(bits);
  }
  void put_text(const std::string& text) { bytes_ += text; }
  void pad(char with) {
    while (bytes_.size() % 4 != 0) bytes_.push_back(with);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Vertices in the precision of the file, equal ones merged.
struct PackedMesh {
  using Vertex = std::array<float, 6>;
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

PackedMesh pack(const TriangleMesh& mesh) {
  PackedMesh packed;
  std::map<PackedMesh::Vertex, std::uint32_t> known;
  const auto vertex = [&](std::uint32_t i) {
    PackedMesh::Vertex v;
    for (int k = 0; k < 3; ++k) {
      v[static_cast<std::size_t>(k)] = static_cast<float>(on_grid(mesh.positions[i][k], position_grid));
      v[static_cast<std::size_t>(k + 3)] = static_cast<float>(on_grid(mesh.normals[i][k], normal_grid));
    }
    const auto [entry, is_new] = known.emplace(v, static_cast<std::uint32_t>(packed.vertices.size()));
    if (is_new) packed.vertices.push_back(v);
    return entry->second;
  };
  const auto same_place = [&](std::uint32_t a, std::uint32_t b) {
    const auto &p = packed.vertices[a], &q = packed.vertices[b];
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
  };
  for (const auto& t : mesh.triangles) {
    const std::array<std::uint32_t, 3> corners{vertex(t[0]), vertex(t[1]), vertex(t[2])};
    if (same_place(corners[0], corners[1]) || same_place(corners[1], corners[2]) || same_place(corners[2], corners[0]))
      continue;
    packed.triangles.push_back(corners);
  }
  return packed;
}

struct Writer {
  Json accessors = Json::array(), views = Json::array();
  BinaryChunk binary;

  int add_view(std::size_t begin, int target) {
    views.push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", binary.size() - begin}, {"target", target}});
    binary.pad('\0');
    return static_cast<int>(views.size()) - 1;
  }

  Json add_primitive(const GlbPrimitive& primitive) {
    const PackedMesh mesh = pack(primitive.mesh);
    PARSEL_ASSERT(!mesh.triangles.empty(), "a solid has triangles");
    Json attributes;
    for (const std::size_t offset : {std::size_t{0}, std::size_t{3}}) {
      const std::size_t begin = binary.size();
      std::array<float, 3> low{mesh.vertices[0][offset], mesh.vertices[0][offset + 1], mesh.vertices[0][offset + 2]};
      std::array<float, 3> high = low;
      for (const PackedMesh::Vertex& v : mesh.vertices) {
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], v[offset + k]);
          high[k] = std::max(high[k], v[offset + k]);
          binary.put_float(v[offset + k]);
        }
      }
      Json accessor = {{"bufferView", add_view(begin, target_vertices)},
                       {"componentType", type_float},
                       {"count", mesh.vertices.size()},
                       {"type", "VEC3"}};
      if (offset == 0) {
        accessor["min"] = low;
        accessor["max"] = high;
      }
      attributes[offset == 0 ? "POSITION" : "NORMAL"] = accessors.size();
      accessors.push_back(std::move(accessor));
    }
    const bool is_short = mesh.vertices.size() < 65535;
    const std::size_t begin = binary.size();
    for (const auto& t : mesh.triangles) {
      for (const std::uint32_t i : t) is_short ? binary.put_u16(i) : binary.put_u32(i);
    }
    accessors.push_back({{"bufferView", add_view(begin, target_indices)},
                         {"componentType", is_short ? type_u16 : type_u32},
                         {"count", mesh.triangles.size() * 3},
                         {"type", "SCALAR"}});
    return {{"attributes", attributes}, {"indices", accessors.size() - 1}, {"material", primitive.material}};
  }
};

Json to_json(const GlbMaterial& material) {
  Json colour = to_json(material.colour);
  colour.push_back(1);
  return {
      {"name", material.name},
      {"pbrMetallicRoughness",
       {{"baseColorFactor", colour}, {"metallicFactor", material.metallic}, {"roughnessFactor", material.roughness}}}};
}

Json to_json(const GlbNode& node) {
  Json json = {{"name", node.name}};
  if (!node.label.empty()) json["extras"] = {{"label", node.label}};
  if (node.mesh >= 0) json["mesh"] = node.mesh;
  if (!node.children.empty()) json["children"] = node.children;
  if (!node.translation.isZero()) json["translation"] = to_json(node.translation);
  if (!node.rotation.isApprox(Eigen::Quaterniond::Identity())) {
    Json rotation = Json::array();
    for (int i = 0; i < 4; ++i) rotation.push_back(std::round(node.rotation.coeffs()[i] * 1e9) / 1e9 + 0.0);
    json["rotation"] = std::move(rotation);
  }
  return json;
}

}  // namespace

std::string write_glb(const GlbScene& scene) {
  Writer writer;
  Json json = {{"asset", {{"version", "2.0"}, {"generator", scene.generator}}}, {"scene", 0}};
  for (const GlbMaterial& material : scene.materials) json["materials"].push_back(to_json(material));
  for (const GlbMesh& mesh : scene.meshes) {
    Json primitives = Json::array();
    for (const GlbPrimitive& primitive : mesh.primitives) primitives.push_back(writer.add_primitive(primitive));
    json["meshes"].push_back({{"name", mesh.name}, {"primitives", std::move(primitives)}});
  }
  std::vector<bool> is_child(scene.nodes.size(), false);
  for (const GlbNode& node : scene.nodes) {
    json["nodes"].push_back(to_json(node));
    for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = true;
  }
  Json roots = Json::array();
  for (std::size_t i = 0; i < is_child.size(); ++i) {
    if (!is_child[i]) roots.push_back(i);
  }
  json["scenes"] = Json::array({{{"name", scene.name}, {"nodes", std::move(roots)}}});
  json["accessors"] = std::move(writer.accessors);
  json["bufferViews"] = std::move(writer.views);
  json["buffers"] = Json::array({{{"byteLength", writer.binary.size()}}});

  BinaryChunk text;
  text.put_text(json.dump());
  text.pad(' ');
  BinaryChunk file;
  file.put_u32(magic_gltf);
  file.put_u32(2);
  file.put_u32(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + writer.binary.size()));
  file.put_u32(static_cast<std::uint32_t>(text.size()));
  file.put_u32(magic_json);
  file.put_text(text.bytes());
  file.put_u32(static_cast<std::uint32_t>(writer.binary.size()));
  file.put_u32(magic_bin);
  file.put_text(writer.binary.bytes());
  return file.bytes();
}

}  // namespace parsel::gallery
