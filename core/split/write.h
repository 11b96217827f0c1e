// Writes a file in which pieces of meshes are nodes of their own.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "core/export/apply_file.h"
#include "core/shape/part.h"

namespace parsel::split {

/// A vertex of a glTF mesh: which primitive's, and its number there.
struct VertexOf {
  std::uint32_t primitive = 0, vertex = 0;
  auto operator<=>(const VertexOf&) const = default;
};

struct NewNode {
  std::string name;
  /// All of primitives that go together (alike()).
  std::vector<std::array<VertexOf, 3>> triangles;
};

/// The pieces of one glTF mesh. Every node that shows the mesh gets a child a piece, at its own place, and shows
/// nothing itself: instances stay instances.
struct NewNodes {
  std::size_t mesh = 0;
  std::vector<NewNode> nodes;
};

/// Every vertex keeps the bytes of all its attributes; each piece has those that it uses. Accessors and buffer views that
/// nothing else reads are used again, and the bytes that nothing reads any more are left out. Error: attributes that
/// cannot be read, more than 4 GB.
Status write_pieces(gltf::File& file, const std::vector<NewNodes>& meshes);

/// Whether two primitives of a mesh can become one: they have one material and attributes of the same kinds, and nothing
/// else tells them apart.
bool alike(const gltf::Document& document, std::size_t mesh, std::size_t a, std::size_t b);

/// Why a primitive's vertices cannot be told apart without loss, a clause; empty when they can.
std::string why_whole(const gltf::Document& document, const gltf::Primitive& primitive);

}  // namespace parsel::split
