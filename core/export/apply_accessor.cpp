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
  ordered_json view{{"buffer", file.home}, {"byteOffset", offset}, {"byteLength", bytes.size()}};
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

void patch_element(File& file, const Layout& where, std::size_t i, const float* components) {
  PARSEL_ASSERT(where.buffer == file.home && i < where.count && where.end() <= file.binary.size(),
                "outside of the layout");
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
  if (old_view && storage.is_free(*old_view)) {
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
