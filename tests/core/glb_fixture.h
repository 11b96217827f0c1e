// Small models for tests, built in memory: named nodes with meshes of plain positions and indices.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/tolerance.h"

namespace parsel::fixture {

struct Mesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A box by centre and full size.
inline Mesh box(const Vec3& centre, const Vec3& size) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.positions.push_back(centre +
                             Vec3(corner_sign(k, 0), corner_sign(k, 1), corner_sign(k, 2)).cwiseProduct(size) / 2);
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline Mesh turned(Mesh mesh, const Vec3& about, const Vec3& axis, double angle) {
  const Mat3 r = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  for (Vec3& p : mesh.positions) p = about + r * (p - about);
  return mesh;
}

struct Named {
  std::string name;
  Mesh mesh;
};

inline void append(std::string& bytes, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 0xff);
}

inline std::string glb(const nlohmann::json& json, std::string binary) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append(bytes, 2);
  append(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size())));
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  if (binary.empty()) return bytes;
  append(bytes, static_cast<std::uint32_t>(binary.size()));
  bytes += std::string("BIN\0", 4) + binary;
  return bytes;
}

struct Document {
  nlohmann::json json;
  std::string binary;
  std::string glb() const { return fixture::glb(json, binary); }
};

/// One node a mesh, float positions and 32-bit indices, one bufferView an accessor, no transforms.
inline Document document(const std::vector<Named>& parts) {
  using nlohmann::json;
  Document d;
  json nodes = json::array(), meshes = json::array(), accessors = json::array(), views = json::array();
  json roots = json::array();
  const auto add_view = [&](std::size_t start) {
    views.push_back({{"buffer", 0}, {"byteOffset", start}, {"byteLength", d.binary.size() - start}});
    return views.size() - 1;
  };
  for (const Named& part : parts) {
    std::size_t start = d.binary.size();
    for (const Vec3& p : part.mesh.positions) {
      for (int i = 0; i < 3; ++i) {
        const auto value = static_cast<float>(p[i]);
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, 4);
        append(d.binary, bits);
      }
    }
    accessors.push_back({{"bufferView", add_view(start)},
                         {"componentType", 5126},
                         {"count", part.mesh.positions.size()},
                         {"type", "VEC3"}});
    start = d.binary.size();
    for (const auto& t : part.mesh.triangles) {
      for (const std::uint32_t v : t) append(d.binary, v);
    }
    accessors.push_back({{"bufferView", add_view(start)},
                         {"componentType", 5125},
                         {"count", 3 * part.mesh.triangles.size()},
                         {"type", "SCALAR"}});
    roots.push_back(nodes.size());
    nodes.push_back({{"name", part.name}, {"mesh", meshes.size()}});
    meshes.push_back(
        {{"primitives", {{{"attributes", {{"POSITION", accessors.size() - 2}}}, {"indices", accessors.size() - 1}}}}});
  }
  d.json = {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", roots}}}},
            {"nodes", nodes},
            {"meshes", meshes},
            {"accessors", accessors},
            {"bufferViews", views},
            {"buffers", {{{"byteLength", d.binary.size()}}}}};
  return d;
}

inline std::string model(const std::vector<Named>& parts) {
  return document(parts).glb();
}

/// A table with four legs under the corners of its top.
inline std::vector<Named> table(double width = 1.2, double depth = 0.8) {
  std::vector<Named> parts = {{"top", box({0, 0.72, 0}, {width, 0.04, depth})}};
  for (const double z : {1.0, -1.0}) {
    for (const double x : {1.0, -1.0}) {
      parts.push_back({"leg", box({x * (width / 2 - 0.05), 0.35, z * (depth / 2 - 0.05)}, {0.06, 0.7, 0.06})});
    }
  }
  return parts;
}

/// A chair whose back has `slats` upright slats between a top rail and the seat.
inline std::vector<Named> slat_chair(int slats) {
  std::vector<Named> parts = {{"seat", box({0, 0.45, 0}, {0.5, 0.04, 0.5})},
                              {"top rail", box({0, 0.95, -0.23}, {0.5, 0.06, 0.03})}};
  for (int i = 0; i < slats; ++i) {
    const double x = -0.2 + 0.4 * i / (slats - 1);
    parts.push_back({"slat." + std::to_string(i + 1), box({x, 0.695, -0.23}, {0.04, 0.45, 0.02})});
  }
  for (const double z : {1.0, -1.0}) {
    for (const double x : {1.0, -1.0}) {
      parts.push_back({"leg", box({x * 0.22, 0.215, z * 0.22}, {0.04, 0.43, 0.04})});
    }
  }
  return parts;
}

/// A fan: `blades` blades about a vertical hub, the first turned by `start` radians from +x.
inline std::vector<Named> fan(int blades, double start = 0.2) {
  std::vector<Named> parts = {{"hub", box({0, 0, 0}, {0.2, 0.2, 0.2})}};
  for (int k = 0; k < blades; ++k) {
    parts.push_back({"blade", turned(box({0.5, 0, 0}, {0.85, 0.02, 0.12}), Vec3::Zero(), Vec3::UnitY(),
                                     start + 2 * pi * k / blades)});
  }
  return parts;
}

}  // namespace parsel::fixture
