#include "core/export/apply_accessor.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace parsel::gltf {
namespace {

using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF buffers are little-endian and read as they are");

/// More elements than any model has, so that a count alone cannot ask for all memory.
constexpr std::size_t max_count = std::size_t{1} << 24;

Error refusal(std::size_t accessor, std::string cause) {
  return {"edit/apply_accessor", "accessor " + std::to_string(accessor), std::move(cause),
          "export the file again, or repair it with a glTF tool"};
}

std::size_t component_size(std::size_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

std::size_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC2") return 2;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  return 0;
}

template <class T>
T load(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

/// glTF 2.0 §3.6.2.2 for normalised integers.
double component(const char* bytes, std::size_t type, bool normalized) {
  switch (type) {
    case 5120: {
      const double value = load<std::int8_t>(bytes);
      return normalized ? std::max(value / 127, -1.0) : value;
    }
    case 5121:
      return load<std::uint8_t>(bytes) / (normalized ? 255.0 : 1.0);
    case 5122: {
      const double value = load<std::int16_t>(bytes);
      return normalized ? std::max(value / 32767, -1.0) : value;
    }
    case 5123:
      return load<std::uint16_t>(bytes) / (normalized ? 65535.0 : 1.0);
    case 5125:
      return load<std::uint32_t>(bytes);
    default:
      return load<float>(bytes);
  }
}

/// The layout of `count` elements of a type in a view, as an accessor or a sparse part of one has them.
Result<Layout> layout_in_view(const File& file, std::size_t accessor, const JsonText& json, Layout where) {
  const auto view = json.get("bufferView").index();
  if (!view) return refusal(accessor, "its bufferView is not an index");
  const auto range = view_range(file, *view);
  if (!range) return refusal(accessor, "its buffer view is missing or lies outside of its buffer");
  const std::size_t offset = json.has("byteOffset") ? json.get("byteOffset").index().value_or(SIZE_MAX) : 0;
  if (offset > range->end - range->begin) return refusal(accessor, "its byteOffset lies outside of its buffer view");
  where.view = *view;
  where.buffer = range->buffer;
  where.begin = range->begin + offset;
  where.element = where.components * component_size(where.component_type);
  where.stride = where.element;
  if (file.item("bufferViews", *view).has("byteStride")) {
    where.stride = file.item("bufferViews", *view).get("byteStride").index().value_or(0);
    if (where.stride < where.element || where.stride > 252) return refusal(accessor, "its byteStride is out of range");
  }
  if (where.count > 0) {
    // Divided, not multiplied: sizes fit 32 bits, their products need not.
    const std::size_t available = range->end - where.begin;
    if (available < where.element || (available - where.element) / where.stride < where.count - 1) {
      return refusal(accessor, "it reaches beyond its buffer view");
    }
  }
  return where;
}

/// Reads the elements of a checked layout into values.
Status read_elements(const File& file, std::size_t accessor, const Layout& where, std::vector<double>& values) {
  if (!file.buffers[where.buffer]) {
    return Error{"edit/apply_accessor", "buffer " + std::to_string(where.buffer),
                 "accessor " + std::to_string(accessor) + " needs its bytes, which are neither in the file nor given",
                 "give the .bin file as well, or decode compressed buffers first"};
  }
  const std::string& bytes = *file.buffers[where.buffer];
  const std::size_t size = component_size(where.component_type);
  values.resize(where.count * where.components);
  for (std::size_t i = 0; i < where.count; ++i) {
    const char* element = bytes.data() + where.begin + i * where.stride;
    for (std::size_t c = 0; c < where.components; ++c) {
      values[i * where.components + c] = component(element + c * size, where.component_type, where.normalized);
    }
  }
  return success();
}

Status apply_sparse(const File& file, std::size_t accessor, const Layout& base, std::vector<double>& values) {
  const JsonText& sparse = file.item("accessors", accessor).get("sparse");
  const auto count = sparse.get("count").index();
  if (!count || *count > base.count) return refusal(accessor, "its sparse count is out of range");
  Layout indices, replaced = base;
  indices.count = replaced.count = *count;
  indices.components = 1;
  indices.component_type = sparse.get("indices").get("componentType").index().value_or(0);
  if (indices.component_type != 5121 && indices.component_type != 5123 && indices.component_type != 5125) {
    return refusal(accessor, "its sparse indices are not unsigned integers");
  }
  const auto index_layout = layout_in_view(file, accessor, sparse.get("indices"), indices);
  if (!index_layout) return index_layout.error();
  const auto value_layout = layout_in_view(file, accessor, sparse.get("values"), replaced);
  if (!value_layout) return value_layout.error();
  std::vector<double> at, with;
  if (Status read = read_elements(file, accessor, *index_layout, at); !read.ok()) return read;
  if (Status read = read_elements(file, accessor, *value_layout, with); !read.ok()) return read;
  for (std::size_t i = 0; i < *count; ++i) {
    const auto element = static_cast<std::size_t>(at[i]);
    if (element >= base.count) return refusal(accessor, "a sparse index is out of range");
    for (std::size_t c = 0; c < base.components; ++c) {
      values[element * base.components + c] = with[i * base.components + c];
    }
  }
  return success();
}

/// Numbers that are not finite (damage that was in the file) have no say.
std::pair<std::vector<double>, std::vector<double>> bounds(const std::vector<float>& values, std::size_t components) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> low(components, infinity), high(components, -infinity);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i];
    if (!std::isfinite(value)) continue;
    low[i % components] = std::min(low[i % components], value);
    high[i % components] = std::max(high[i % components], value);
  }
  for (std::size_t c = 0; c < components; ++c) {
    if (low[c] > high[c]) low[c] = high[c] = 0;
  }
  return {low, high};
}

std::string bytes_of(const std::vector<float>& values) {
  std::string bytes(values.size() * sizeof(float), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

JsonText new_view(File& file, const NewData& data) {
  const std::string bytes = bytes_of(data.values);
  const std::size_t offset = file.append_bytes(bytes);
  ordered_json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}};
  if (data.vertices) view["target"] = 34962;
  return JsonText(view);
}

/// Makes the accessor's JSON describe plain floats in a view.
void describe(JsonText& accessor, const NewData& data, std::size_t view) {
  static constexpr std::array<const char*, 5> types{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  for (const char* key : {"byteOffset", "normalized", "sparse"}) accessor.erase(key);
  const auto put = [&](const char* key, const ordered_json& value) {
    if (accessor.get(key).text() != value.dump()) accessor.set(key, JsonText(value));
  };
  put("bufferView", view);
  put("componentType", type_float);
  put("count", data.values.size() / data.components);
  put("type", types[data.components]);
  if (data.with_bounds || accessor.has("min") || accessor.has("max")) {
    set_bounds(accessor, data.values, data.components);
  }
}

}  // namespace

std::optional<ViewRange> view_range(const File& file, std::size_t view) {
  const JsonText& json = file.item("bufferViews", view);
  const auto buffer = json.get("buffer").index();
  const auto length = json.get("byteLength").index();
  if (!buffer || !length || *buffer >= file.buffers.size()) return std::nullopt;
  const std::size_t begin = json.has("byteOffset") ? json.get("byteOffset").index().value_or(SIZE_MAX) : 0;
  const std::size_t size = file.item("buffers", *buffer).get("byteLength").index().value_or(0);
  if (begin > size || *length > size - begin) return std::nullopt;
  return ViewRange{*buffer, begin, begin + *length};
}

Result<Layout> layout(const File& file, std::size_t accessor) {
  const JsonText& json = file.item("accessors", accessor);
  if (!json.is_object()) return refusal(accessor, "the file has no such accessor");
  Layout where;
  where.components = component_count(json.get("type").string().value_or(""));
  if (where.components == 0) return refusal(accessor, "its type is not SCALAR, VEC2, VEC3 or VEC4");
  where.component_type = json.get("componentType").index().value_or(0);
  if (component_size(where.component_type) == 0) return refusal(accessor, "its componentType is unknown");
  const auto count = json.get("count").index();
  if (!count || *count > max_count) return refusal(accessor, "its count is missing or too large");
  where.count = *count;
  where.normalized = json.get("normalized").boolean().value_or(false);
  where.sparse = json.has("sparse");
  if (!json.has("bufferView")) return where;
  return layout_in_view(file, accessor, json, where);
}

Result<std::vector<double>> read_accessor(const File& file, std::size_t accessor) {
  const auto where = layout(file, accessor);
  if (!where) return where.error();
  std::vector<double> values(where->count * where->components, 0.0);
  if (where->view) {
    if (const Status read = read_elements(file, accessor, *where, values); !read.ok()) return read.error();
  }
  if (where->sparse) {
    if (const Status read = apply_sparse(file, accessor, *where, values); !read.ok()) return read.error();
  }
  return values;
}

Result<std::vector<std::uint32_t>> read_indices(const File& file, std::size_t accessor) {
  const auto where = layout(file, accessor);
  if (!where) return where.error();
  const std::size_t type = where->component_type;
  if (where->components != 1 || where->normalized || (type != 5121 && type != 5123 && type != 5125)) {
    return refusal(accessor, "indices are unsigned integers");
  }
  const auto values = read_accessor(file, accessor);
  if (!values) return values.error();
  std::vector<std::uint32_t> indices;
  indices.reserve(values->size());
  for (const double value : *values) indices.push_back(static_cast<std::uint32_t>(value));
  return indices;
}

void patch_element(File& file, const Layout& where, std::size_t i, const float* components) {
  PARSEL_ASSERT(where.buffer == 0 && i < where.count && where.end() <= file.binary.size(), "outside of the layout");
  std::memcpy(file.binary.data() + where.begin + i * where.stride, components, where.components * sizeof(float));
}

void set_bounds(JsonText& accessor, const std::vector<float>& values, std::size_t components) {
  const auto [low, high] = bounds(values, components);
  const auto put = [&](const char* key, const std::vector<double>& bound) {
    bool same = accessor.get(key).size() == components;
    for (std::size_t c = 0; same && c < components; ++c) same = accessor.get(key).item(c).number() == bound[c];
    if (!same) accessor.set(key, JsonText(ordered_json(bound)));
  };
  put("min", low);
  put("max", high);
}

void replace_data(File& file, const Storage& storage, std::size_t accessor, const NewData& data) {
  const auto old_view = file.item("accessors", accessor).get("bufferView").index();
  JsonText described = new_view(file, data);
  std::size_t view = file.size("bufferViews");
  if (old_view && *old_view < view && storage.references(*old_view) == 1) {
    view = *old_view;
    JsonText& reused = *file.find_item("bufferViews", view);
    reused.erase("byteStride");
    for (std::size_t i = 0; i < described.size(); ++i) reused.set(described.key(i), described.get(described.key(i)));
  } else {
    file.append("bufferViews", std::move(described));
  }
  describe(*file.find_item("accessors", accessor), data, view);
}

std::size_t append_accessor(File& file, const NewData& data, std::optional<std::size_t> like) {
  JsonText accessor = like ? file.item("accessors", *like) : JsonText(ordered_json::object());
  describe(accessor, data, file.append("bufferViews", new_view(file, data)));
  return file.append("accessors", std::move(accessor));
}

}  // namespace parsel::gltf
