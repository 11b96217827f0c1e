// The typed sections of a glTF file: what document.h reads. Whatever stands in a Document has its type, though an index may
// still point nowhere.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/gltf/container.h"
#include "core/gltf/transform.h"

namespace parsel::gltf {

/// The extension that keeps a primitive compressed, beside its attributes or in their place.
inline constexpr const char* draco = "KHR_draco_mesh_compression";

struct Buffer {
  std::string_view bytes;  ///< into the file, an external buffer, or `decoded`; exactly byteLength of them
  std::string decoded;     ///< of a data URI
  std::size_t length = 0;  ///< byteLength, there or not
  std::string missing;     ///< why there are no bytes, a clause; empty when there are
};

struct BufferView {
  std::size_t buffer = 0, offset = 0, length = 0;
  std::size_t stride = 0;  ///< 0: tightly packed
  bool meshopt = false;    ///< compressed with EXT_meshopt_compression or its KHR successor
  bool extended = false;   ///< has an extension of any kind
};

struct Accessor {
  /// Elements that replace those of the accessor: indices and values, each in a buffer view without stride.
  struct Sparse {
    std::size_t count = 0;
    std::size_t index_view = 0, index_offset = 0, index_type = 0;
    std::size_t value_view = 0, value_offset = 0;
  };

  std::optional<std::size_t> view;  ///< without one the elements are zero
  std::size_t offset = 0, count = 0;
  std::size_t component_type = 0;  ///< as the file says, 5120 … 5126 when it is sound
  std::size_t components = 0;      ///< 1 to 4; 0 for matrices and types that glTF does not know
  bool normalized = false;
  std::optional<Sparse> sparse;
};

using Attributes = std::map<std::string, std::size_t>;  ///< accessor by name

struct Primitive {
  Attributes attributes;
  std::vector<Attributes> targets;
  std::optional<std::size_t> indices, material;
  std::size_t mode = 4;
  bool has_draco = false;  ///< has the extension draco
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

struct Node {
  std::string name;
  std::optional<std::size_t> mesh;
  bool skinned = false;
  bool instanced = false;  ///< EXT_mesh_gpu_instancing
  bool visible = true;     ///< false: KHR_node_visibility hides it and all below it
  std::vector<std::size_t> children;
  std::vector<std::size_t> levels;  ///< MSFT_lod: nodes shown in its place from further away
  Transform transform;
};

struct Document {
  Container container;
  nlohmann::json json;  ///< the whole of it, for what stands nowhere below
  std::vector<Buffer> buffers;
  std::vector<BufferView> views;
  std::vector<Accessor> accessors;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::size_t scene = 0;                          ///< the default scene, or the first
  std::optional<std::vector<std::size_t>> roots;  ///< of that scene; none when the file has no scenes
};

}  // namespace parsel::gltf
