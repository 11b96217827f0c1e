// Small GLB files and the shapes and states that go with them, built by hand for the tests of the patcher.
#pragma once

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/export/apply.h"
#include "core/export/apply_accessor.h"
#include "core/export/apply_file.h"
#include "core/export/apply_scene.h"

namespace parsel::apply_fixture {

using nlohmann::ordered_json;

/// A glTF file in the making: JSON to be changed at will, and a binary chunk that grows.
struct Glb {
  ordered_json json = {{"asset", {{"version", "2.0"}}},
                       {"scene", 0},
                       {"scenes", {{{"nodes", ordered_json::array()}}}},
                       {"nodes", ordered_json::array()},
                       {"meshes", ordered_json::array()},
                       {"accessors", ordered_json::array()},
                       {"bufferViews", ordered_json::array()},
                       {"buffers", {{{"byteLength", 0}}}}};
  std::string binary;

  template <class T>
  std::size_t view(const std::vector<T>& values) {
    binary.append((4 - binary.size() % 4) % 4, '\0');
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", values.size() * sizeof(T)}});
    const std::size_t at = binary.size();
    binary.resize(at + values.size() * sizeof(T));
    std::memcpy(binary.data() + at, values.data(), values.size() * sizeof(T));
    return json["bufferViews"].size() - 1;
  }

  /// VEC3 floats; bounds as glTF wants them for positions.
  std::size_t vectors(const std::vector<Vec3>& values, bool bounds = true) {
    std::vector<float> floats;
    for (const Vec3& v : values) {
      for (int c = 0; c < 3; ++c) floats.push_back(static_cast<float>(v[c]));
    }
    ordered_json accessor{
        {"bufferView", view(floats)}, {"componentType", 5126}, {"count", values.size()}, {"type", "VEC3"}};
    if (bounds) {
      Vec3 low = values[0], high = values[0];
      for (const Vec3& v : values) {
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
      }
      for (int c = 0; c < 3; ++c) {
        accessor["min"].push_back(static_cast<double>(static_cast<float>(low[c])));
        accessor["max"].push_back(static_cast<double>(static_cast<float>(high[c])));
      }
    }
    json["accessors"].push_back(accessor);
    return json["accessors"].size() - 1;
  }

  std::size_t indices(const std::vector<std::uint16_t>& values) {
    json["accessors"].push_back(
        {{"bufferView", view(values)}, {"componentType", 5123}, {"count", values.size()}, {"type", "SCALAR"}});
    return json["accessors"].size() - 1;
  }

  /// A mesh of one primitive. Returns its index.
  std::size_t mesh(const ordered_json& primitive) {
    json["meshes"].push_back({{"primitives", ordered_json::array({primitive})}});
    return json["meshes"].size() - 1;
  }

  /// A root of the scene. Returns its index.
  std::size_t node(const ordered_json& node) {
    json["nodes"].push_back(node);
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
    return json["nodes"].size() - 1;
  }

  std::string bytes() const { return bytes_of(json.dump()); }
  std::string bytes_of(std::string text) const;
};

inline void put_u32(std::string& out, std::size_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

/// A GLB with any JSON text, for what ordered_json would not write.
inline std::string glb_of(std::string text, std::string binary) {
  text.append((4 - text.size() % 4) % 4, ' ');
  binary.append((4 - binary.size() % 4) % 4, '\0');
  std::string out = "glTF";
  put_u32(out, 2);
  put_u32(out, 28 + text.size() + binary.size());
  put_u32(out, text.size());
  out += "JSON" + text;
  put_u32(out, binary.size());
  return out + std::string("BIN\0", 4) + binary;
}

inline std::string Glb::bytes_of(std::string text) const {
  auto patched = ordered_json::parse(text);
  if (patched["buffers"][0]["byteLength"] != 0) return glb_of(std::move(text), binary);
  patched["buffers"][0]["byteLength"] = binary.size();
  return glb_of(patched.dump(), binary);
}

/// Corners of the box between two points.
inline Corners box(const Vec3& low, const Vec3& high) {
  Corners corners;
  for (int k = 0; k < 8; ++k) {
    for (int c = 0; c < 3; ++c) corners(k, c) = corner_sign(k, c) < 0 ? low[c] : high[c];
  }
  return corners;
}

/// A vertex at every corner of the box with 2 × 2 × 2 cells, 27 in all, or any other grid.
inline std::vector<Vec3> grid(const Vec3& low, const Vec3& high, int n = 2) {
  std::vector<Vec3> points;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k <= n; ++k) points.push_back(low + (high - low).cwiseProduct(Vec3(i, j, k) / n));
    }
  }
  return points;
}

/// A real part with that rest cage, in the normalised frame.
inline PartIndex add_part(Shape& shape, std::size_t node, const Corners& rest, std::size_t primitive = 0) {
  Part part;
  part.id = "part_" + std::to_string(shape.parts.size());
  part.node = static_cast<int>(node);
  part.primitive = static_cast<int>(primitive);
  part.hexahedron.corners = rest;
  return shape.parts.push_back(part);
}

/// Everything at rest.
inline State resting(const Shape& shape) {
  State state;
  for (const Part& part : shape.parts) state.parts.push_back(part.hexahedron.corners);
  state.groups = RelationData<GroupState>(shape.relations.size());
  for (const RelationIndex r : shape.relations.indices()) {
    for (const PartIndex p : shape.relations[r].parts) {
      state.groups[r].instances.push_back(shape.parts[p].hexahedron.corners);
    }
  }
  return state;
}

template <class Function>
Corners mapped(const Corners& corners, const Function& function) {
  Corners out;
  for (int k = 0; k < 8; ++k) out.row(k) = function(Vec3(corners.row(k).transpose())).transpose();
  return out;
}

inline gltf::File read(const std::string& glb) {
  auto file = gltf::read_file(glb, {});
  PARSEL_ASSERT(file.ok(), file.error().message().c_str());
  return std::move(file).value();
}

/// The JSON chunk as it stands in the file.
inline std::string json_chunk(const std::string& glb) {
  std::uint32_t size = 0;
  std::memcpy(&size, glb.data() + 12, 4);
  return glb.substr(20, size);
}

inline ordered_json json_of(const std::string& glb) {
  return ordered_json::parse(json_chunk(glb));
}

inline std::vector<Vec3> vectors(const gltf::File& file, std::size_t accessor) {
  const auto values = gltf::read_accessor(file.original, accessor);
  PARSEL_ASSERT(values.ok(), values.error().message().c_str());
  const auto where = gltf::layout(file.original, accessor);
  std::vector<Vec3> out;
  for (std::size_t i = 0; i + 2 < values->size(); i += where->components) {
    out.emplace_back((*values)[i], (*values)[i + 1], (*values)[i + 2]);
  }
  return out;
}

/// An attribute of primitive 0 (or another) of the mesh that the node shows, in the node's coordinates.
inline std::vector<Vec3> attribute(const std::string& glb, std::size_t node, const std::string& name,
                                   std::size_t primitive = 0) {
  const gltf::File file = read(glb);
  const std::size_t mesh = file.item("nodes", node).get("mesh").index().value();
  const auto& primitives = file.item("meshes", mesh).get("primitives");
  return vectors(file, primitives.item(primitive).get("attributes").get(name).index().value());
}

/// POSITION, in model coordinates.
inline std::vector<Vec3> world_positions(const std::string& glb, std::size_t node, std::size_t primitive = 0) {
  const gltf::File file = read(glb);
  const auto scene = gltf::read_scene(file.original);
  PARSEL_ASSERT(scene.ok(), "the scene cannot be read");
  std::vector<Vec3> out = attribute(glb, node, "POSITION", primitive);
  for (Vec3& p : out) p = scene->world[node] * p;
  return out;
}

inline double furthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return 1e300;
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

/// Whether min and max of every POSITION accessor in use are exactly those of its data.
inline bool bounds_hold(const std::string& glb) {
  const gltf::File file = read(glb);
  const ordered_json json = json_of(glb);
  for (const auto& mesh : json["meshes"]) {
    for (const auto& primitive : mesh["primitives"]) {
      const auto accessor = primitive["attributes"]["POSITION"].get<std::size_t>();
      const std::vector<Vec3> points = vectors(file, accessor);
      Vec3 low = points[0], high = points[0];
      for (const Vec3& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
      for (int c = 0; c < 3; ++c) {
        if (json["accessors"][accessor]["min"][static_cast<std::size_t>(c)] != low[c]) return false;
        if (json["accessors"][accessor]["max"][static_cast<std::size_t>(c)] != high[c]) return false;
      }
    }
  }
  return true;
}

}  // namespace parsel::apply_fixture
