#include "core/gltf/accessor.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "core/gltf/refusal.h"

namespace parsel::gltf {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian and read as they are");

/// Triangle lists name each vertex some six times; far more, and a count asks for memory that no model needs.
constexpr std::size_t most_indices_per_vertex = 8;

Error damaged(std::size_t accessor, std::string cause) {
  return refused("accessor " + std::to_string(accessor), std::move(cause));
}

std::size_t component_size(std::size_t type) {
  switch (type) {
    case type_byte:
    case type_unsigned_byte:
      return 1;
    case type_short:
    case type_unsigned_short:
      return 2;
    case type_unsigned_int:
    case type_float:
      return 4;
    default:
      return 0;
  }
}

bool is_index_type(std::size_t type) {
  return type == type_unsigned_byte || type == type_unsigned_short || type == type_unsigned_int;
}

template <class T>
T load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// One component as glTF 2.0 §3.6.2.2 says; `normalized` maps integers to [0,1] or [-1,1].
double component(const char* bytes, std::size_t type, bool normalized) {
  switch (type) {
    case type_byte: {
      const double value = load<std::int8_t>(bytes);
      return normalized ? std::max(value / 127.0, -1.0) : value;
    }
    case type_unsigned_byte:
      return load<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
    case type_short: {
      const double value = load<std::int16_t>(bytes);
      return normalized ? std::max(value / 32767.0, -1.0) : value;
    }
    case type_unsigned_short:
      return load<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
    case type_unsigned_int:
      return load<std::uint32_t>(bytes);
    default:
      return static_cast<double>(load<float>(bytes));
  }
}

std::uint32_t load_index(const char* bytes, std::size_t type) {
  if (type == type_unsigned_byte) return load<std::uint8_t>(bytes);
  if (type == type_unsigned_short) return load<std::uint16_t>(bytes);
  return load<std::uint32_t>(bytes);
}

/// `where` (count, type and components given) placed at `offset` of a view.
Result<Layout> place_in_view(const Document& document, std::size_t accessor, std::size_t view, std::size_t offset,
                             bool strided, Layout where) {
  if (view >= document.views.size()) {
    return damaged(accessor, "bufferView " + std::to_string(view) + " does not exist");
  }
  const BufferView& entry = document.views[view];
  if (entry.buffer >= document.buffers.size()) {
    return damaged(accessor, "buffer " + std::to_string(entry.buffer) + " does not exist");
  }
  const auto range = view_range(document, view);
  if (!range) return damaged(accessor, "bufferView " + std::to_string(view) + " reaches beyond its buffer");
  where.view = view;
  where.buffer = range->buffer;
  where.element = where.components * component_size(where.component_type);
  where.stride = where.element;
  if (strided && entry.stride > 0) {
    where.stride = entry.stride;
    if (where.stride < where.element) return damaged(accessor, "its byteStride is smaller than an element");
  }
  // All numbers are below 2³¹ (checked when the document was read), so nothing overflows 64 bits.
  const std::uint64_t needed =
      where.count == 0
          ? 0
          : std::uint64_t{offset} + std::uint64_t{where.stride} * (where.count - 1) + std::uint64_t{where.element};
  if (needed > entry.length) {
    return damaged(accessor,
                   "its " + std::to_string(where.count) + " elements reach beyond bufferView " + std::to_string(view));
  }
  where.begin = range->begin + std::min(offset, entry.length);
  return where;
}

Status within_reach(const Document& document, std::size_t accessor, const Layout& where) {
  const std::string& missing = document.buffers[where.buffer].missing;
  return missing.empty() ? success() : damaged(accessor, missing);
}

const char* element_of(const Document& document, const Layout& where, std::size_t i) {
  return document.buffers[where.buffer].bytes.data() + where.begin + i * where.stride;
}

/// Where the replaced elements of a sparse accessor and their indices lie; every index is below the count.
struct SparseLayout {
  Layout indices, values;
};

Result<SparseLayout> sparse_layout(const Document& document, std::size_t accessor, const Layout& base) {
  const Accessor::Sparse& sparse = *document.accessors[accessor].sparse;
  if (sparse.count > base.count) return damaged(accessor, "it has more sparse elements than elements");
  if (!is_index_type(sparse.index_type)) return damaged(accessor, "its sparse indices are of no index type");
  Layout indices, values = base;
  indices.count = values.count = sparse.count;
  indices.components = 1;
  indices.component_type = sparse.index_type;
  auto at = place_in_view(document, accessor, sparse.index_view, sparse.index_offset, false, indices);
  if (!at.ok()) return at.error();
  auto with = place_in_view(document, accessor, sparse.value_view, sparse.value_offset, false, values);
  if (!with.ok()) return with.error();
  for (const Layout* part : {&*at, &*with}) {
    if (Status s = within_reach(document, accessor, *part); !s.ok()) return s.error();
  }
  for (std::size_t i = 0; i < sparse.count; ++i) {
    if (load_index(element_of(document, *at, i), sparse.index_type) >= base.count) {
      return damaged(accessor, "a sparse index is out of range");
    }
  }
  return SparseLayout{*at, *with};
}

/// Reads the elements, then lets the sparse ones replace theirs. `read` decodes one element to values[i · size].
template <class T, class Read>
Result<std::vector<T>> read_elements(const Document& document, std::size_t accessor, const Layout& where,
                                     std::size_t size, const T& zero, const Read& read) {
  std::vector<T> values(where.count * size, zero);
  if (where.view) {
    if (Status s = within_reach(document, accessor, where); !s.ok()) return s.error();
    for (std::size_t i = 0; i < where.count; ++i) read(element_of(document, where, i), &values[i * size]);
  }
  if (!document.accessors[accessor].sparse) return values;
  const auto sparse = sparse_layout(document, accessor, where);
  if (!sparse.ok()) return sparse.error();
  for (std::size_t i = 0; i < sparse->indices.count; ++i) {
    const std::size_t target = load_index(element_of(document, sparse->indices, i), sparse->indices.component_type);
    read(element_of(document, sparse->values, i), &values[target * size]);
  }
  return values;
}

}  // namespace

std::optional<ViewRange> view_range(const Document& document, std::size_t view) {
  if (view >= document.views.size()) return std::nullopt;
  const BufferView& entry = document.views[view];
  if (entry.buffer >= document.buffers.size()) return std::nullopt;
  const Buffer& buffer = document.buffers[entry.buffer];
  if (entry.offset > buffer.length || entry.length > buffer.length - entry.offset) return std::nullopt;
  return ViewRange{entry.buffer, entry.offset, entry.offset + entry.length};
}

Result<Layout> layout(const Document& document, std::size_t accessor) {
  if (accessor >= document.accessors.size()) return damaged(accessor, "it does not exist");
  const Accessor& entry = document.accessors[accessor];
  Layout where;
  where.count = entry.count;
  where.components = entry.components;
  where.component_type = entry.component_type;
  where.normalized = entry.normalized;
  if (where.components == 0) return damaged(accessor, "its type is not SCALAR, VEC2, VEC3 or VEC4");
  if (where.count > ImportLimits().vertices * most_indices_per_vertex) {
    return damaged(accessor, "it has more than " + std::to_string(ImportLimits().vertices * most_indices_per_vertex) +
                                 " elements");
  }
  if (!entry.view) return where;
  return place_in_view(document, accessor, *entry.view, entry.offset, true, where);
}

Status check_accessor(const Document& document, std::size_t accessor) {
  const auto where = layout(document, accessor);
  if (!where.ok()) return where.error();
  if (where->view) {
    if (Status s = within_reach(document, accessor, *where); !s.ok()) return s;
  }
  if (!document.accessors[accessor].sparse) return success();
  const auto sparse = sparse_layout(document, accessor, *where);
  return sparse.ok() ? success() : sparse.error();
}

Result<std::vector<double>> read_accessor(const Document& document, std::size_t accessor) {
  const auto where = layout(document, accessor);
  if (!where.ok()) return where.error();
  const std::size_t n = where->components, size = component_size(where->component_type);
  return read_elements<double>(document, accessor, *where, n, 0.0, [&](const char* bytes, double* out) {
    for (std::size_t c = 0; c < n; ++c) out[c] = component(bytes + c * size, where->component_type, where->normalized);
  });
}

Result<std::vector<Vec3>> read_positions(const Document& document, std::size_t accessor) {
  const auto where = layout(document, accessor);
  if (!where.ok()) return where.error();
  const std::size_t type = where->component_type, size = component_size(type);
  if (where->components != 3) return damaged(accessor, "a POSITION is not of type VEC3");
  if (type == type_unsigned_int) return damaged(accessor, "a POSITION is of component type " + std::to_string(type));
  return read_elements<Vec3>(document, accessor, *where, 1, Vec3::Zero(), [&](const char* bytes, Vec3* out) {
    for (int c = 0; c < 3; ++c) {
      (*out)[c] = component(bytes + static_cast<std::size_t>(c) * size, type, where->normalized);
    }
  });
}

Result<std::vector<std::uint32_t>> read_indices(const Document& document, std::size_t accessor) {
  const auto where = layout(document, accessor);
  if (!where.ok()) return where.error();
  const std::size_t type = where->component_type;
  if (where->components != 1 || !is_index_type(type)) return damaged(accessor, "indices are not unsigned scalars");
  return read_elements<std::uint32_t>(document, accessor, *where, 1, 0u,
                                      [&](const char* bytes, std::uint32_t* out) { *out = load_index(bytes, type); });
}

std::string out_of_reach(const Document& document, std::size_t accessor) {
  if (accessor >= document.accessors.size()) return "";
  const Accessor& entry = document.accessors[accessor];
  std::vector<std::size_t> views;
  if (entry.view) views.push_back(*entry.view);
  if (entry.sparse) views.insert(views.end(), {entry.sparse->index_view, entry.sparse->value_view});
  for (const std::size_t view : views) {
    if (view >= document.views.size() || document.views[view].buffer >= document.buffers.size()) continue;
    // A fallback buffer with bytes holds the data uncompressed.
    const std::string& missing = document.buffers[document.views[view].buffer].missing;
    if (missing.empty()) continue;
    return document.views[view].meshopt ? "it is compressed with EXT_meshopt_compression, which is not read here"
                                        : missing;
  }
  return "";
}

std::size_t accessor_count(const Document& document, std::size_t accessor) {
  return accessor < document.accessors.size() ? document.accessors[accessor].count : 0;
}

}  // namespace parsel::gltf
