#include "core/gltf/accessor.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace parsel {
namespace {

Error damaged(int accessor, std::string cause) {
  return {"shape/gltf_import", "accessor " + std::to_string(accessor), std::move(cause), "export the model again"};
}

/// A checked run of elements: element i starts at bytes[i · stride] and ends inside.
struct Run {
  std::string_view bytes;
  std::size_t stride = 0;
};

/// `count` elements of `element_size` bytes from `offset` of a bufferView.
Result<Run> find_run(const GltfDocument& document, int accessor, int view_index, std::size_t offset, std::size_t count,
                     std::size_t element_size, bool strided) {
  const auto& views = document.model.bufferViews;
  if (view_index < 0 || static_cast<std::size_t>(view_index) >= views.size()) {
    return damaged(accessor, "bufferView " + std::to_string(view_index) + " does not exist");
  }
  const tinygltf::BufferView& view = views[static_cast<std::size_t>(view_index)];
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= document.buffers.size()) {
    return damaged(accessor, "buffer " + std::to_string(view.buffer) + " does not exist");
  }
  const GltfBuffer& buffer = document.buffers[static_cast<std::size_t>(view.buffer)];
  // All numbers are below 2³¹ (checked when the document was read), so nothing overflows 64 bits.
  const std::uint64_t view_end = std::uint64_t{view.byteOffset} + view.byteLength;
  if (view_end > buffer.bytes.size()) {
    return damaged(accessor, "bufferView " + std::to_string(view_index) + " reaches beyond its buffer");
  }
  const std::uint64_t stride = strided && view.byteStride > 0 ? view.byteStride : element_size;
  if (stride < element_size) return damaged(accessor, "byteStride is smaller than an element");
  const std::uint64_t needed = count == 0 ? 0 : std::uint64_t{offset} + stride * (count - 1) + element_size;
  if (needed > view.byteLength) {
    return damaged(accessor,
                   "its " + std::to_string(count) + " elements reach beyond bufferView " + std::to_string(view_index));
  }
  const std::size_t start = std::min<std::size_t>(offset, view.byteLength);
  return Run{buffer.bytes.substr(view.byteOffset + start, view.byteLength - start), static_cast<std::size_t>(stride)};
}

template <class T>
T load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);  // glTF is little-endian, as every platform we build for
  return value;
}

/// One component as glTF 2.0 §3.6.2.2 says; `normalized` maps integers to [0,1] or [-1,1].
double component(const char* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const double value = load<std::int8_t>(bytes);
      return normalized ? std::max(value / 127.0, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const double value = load<std::int16_t>(bytes);
      return normalized ? std::max(value / 32767.0, -1.0) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
    default:
      return static_cast<double>(load<float>(bytes));
  }
}

std::size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

bool is_index_type(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::uint32_t load_index(const char* bytes, int type) {
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return load<std::uint8_t>(bytes);
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return load<std::uint16_t>(bytes);
  return load<std::uint32_t>(bytes);
}

/// Reads the elements, then lets the sparse ones replace theirs. `read` decodes one element.
template <class T, class Read>
Result<std::vector<T>> read_elements(const GltfDocument& document, int index, std::size_t element_size, const T& zero,
                                     const Read& read) {
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  std::vector<T> values(accessor.count, zero);
  if (accessor.bufferView >= 0) {
    const Result<Run> run =
        find_run(document, index, accessor.bufferView, accessor.byteOffset, accessor.count, element_size, true);
    if (!run.ok()) return run.error();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = read(run->bytes.data() + i * run->stride);
  }  // an accessor without bufferView is all zeros (glTF 2.0 §3.6.2.3)
  if (!accessor.sparse.isSparse) return values;

  const auto& sparse = accessor.sparse;
  const auto count = static_cast<std::size_t>(sparse.count);
  if (count > accessor.count) return damaged(index, "it has more sparse elements than elements");
  if (!is_index_type(sparse.indices.componentType)) return damaged(index, "its sparse indices are of no index type");
  const std::size_t index_size = component_size(sparse.indices.componentType);
  const Result<Run> at = find_run(document, index, sparse.indices.bufferView,
                                  static_cast<std::size_t>(sparse.indices.byteOffset), count, index_size, false);
  if (!at.ok()) return at.error();
  const Result<Run> with = find_run(document, index, sparse.values.bufferView,
                                    static_cast<std::size_t>(sparse.values.byteOffset), count, element_size, false);
  if (!with.ok()) return with.error();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t target = load_index(at->bytes.data() + i * at->stride, sparse.indices.componentType);
    if (target >= values.size()) return damaged(index, "a sparse index is out of range");
    values[target] = read(with->bytes.data() + i * with->stride);
  }
  return values;
}

bool exists(const GltfDocument& document, int accessor) {
  return accessor >= 0 && static_cast<std::size_t>(accessor) < document.model.accessors.size();
}

}  // namespace

std::string out_of_reach(const GltfDocument& document, int accessor) {
  if (!exists(document, accessor)) return "";
  const tinygltf::Accessor& a = document.model.accessors[static_cast<std::size_t>(accessor)];
  std::vector<int> views = {a.bufferView};
  if (a.sparse.isSparse) views.insert(views.end(), {a.sparse.indices.bufferView, a.sparse.values.bufferView});
  for (const int index : views) {
    if (index < 0 || static_cast<std::size_t>(index) >= document.model.bufferViews.size()) continue;
    const auto& entry = document.json["bufferViews"][static_cast<std::size_t>(index)];
    const int buffer = document.model.bufferViews[static_cast<std::size_t>(index)].buffer;
    const bool known = buffer >= 0 && static_cast<std::size_t>(buffer) < document.buffers.size();
    const auto extensions = entry.find("extensions");
    const bool meshopt =
        extensions != entry.end() && extensions->is_object() &&
        (extensions->contains("EXT_meshopt_compression") || extensions->contains("KHR_meshopt_compression"));
    if (!known) continue;
    const GltfBuffer& bytes = document.buffers[static_cast<std::size_t>(buffer)];
    // A fallback buffer with bytes holds the data uncompressed.
    if (meshopt && !bytes.missing.empty())
      return "it is compressed with EXT_meshopt_compression, which is not read here";
    if (!bytes.missing.empty()) return bytes.missing;
  }
  return "";
}

std::size_t accessor_count(const GltfDocument& document, int accessor) {
  return exists(document, accessor) ? document.model.accessors[static_cast<std::size_t>(accessor)].count : 0;
}

Result<std::vector<Vec3>> read_positions(const GltfDocument& document, int index) {
  if (!exists(document, index)) return damaged(index, "it does not exist");
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  if (accessor.type != TINYGLTF_TYPE_VEC3) return damaged(index, "a POSITION is not of type VEC3");
  const int type = accessor.componentType;
  const std::size_t size = component_size(type);
  if (size == 0 || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return damaged(index, "a POSITION is of component type " + std::to_string(type));
  }
  return read_elements<Vec3>(document, index, 3 * size, Vec3::Zero(), [&](const char* bytes) {
    return Vec3(component(bytes, type, accessor.normalized), component(bytes + size, type, accessor.normalized),
                component(bytes + 2 * size, type, accessor.normalized));
  });
}

Result<std::vector<std::uint32_t>> read_indices(const GltfDocument& document, int index) {
  if (!exists(document, index)) return damaged(index, "it does not exist");
  const tinygltf::Accessor& accessor = document.model.accessors[static_cast<std::size_t>(index)];
  const int type = accessor.componentType;
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_index_type(type)) {
    return damaged(index, "indices are not unsigned scalars");
  }
  return read_elements<std::uint32_t>(document, index, component_size(type), 0u,
                                      [&](const char* bytes) { return load_index(bytes, type); });
}

}  // namespace parsel
