// Writing the accessors of a glTF file (core/gltf/accessor.h reads them).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/export/apply_file.h"
#include "core/gltf/accessor.h"

namespace parsel::gltf {

/// Who reads which bytes of the file as it came: what may be patched where it is, and what must be written anew.
class Storage {
 public:
  explicit Storage(const Document& document);

  /// Whether the accessor's bytes are plain floats in the file's `home` buffer that nothing else in the file reads.
  bool can_patch_in_place(std::size_t accessor) const;
  /// Whether the view may describe other bytes, once the one accessor that reads it does not: nothing else refers to it
  /// (accessors, sparse parts, images, extensions), and no extension of its own says more of its bytes.
  bool is_free(std::size_t view) const;

 private:
  void count_references(const nlohmann::json& json);

  const Document& document_;
  std::vector<std::optional<Layout>> layouts_;            ///< of every accessor that has one
  std::vector<std::vector<std::size_t>> view_accessors_;  ///< of every view
  std::vector<std::size_t> references_;
  std::vector<bool> overlapped_;  ///< by another view of its buffer
};

/// Overwrites element i of an accessor that can be patched in place.
void patch_element(File& file, const Layout& where, std::size_t i, const float* components);

/// Where new data goes: bounds are written when `with_bounds`.
struct NewData {
  const std::vector<float>& values;  ///< count × components
  std::size_t components = 3;
  bool with_bounds = false;
  bool vertices = true;  ///< the view's target is ARRAY_BUFFER
};

/// Points an existing accessor at new float data; its old buffer view is reused when nothing else refers to it. Name,
/// extras and unknown keys stay.
void replace_data(File& file, const Storage& storage, std::size_t accessor, const NewData& data);
/// Appends an accessor with new float data: a copy of accessor `like` (name, extras) when given. Returns its index.
std::size_t append_accessor(File& file, const NewData& data, std::optional<std::size_t> like = std::nullopt);

/// The smallest and largest value of every component; count > 0. Written only where they differ from what is there.
void set_bounds(JsonText& accessor, const std::vector<float>& values, std::size_t components);

}  // namespace parsel::gltf
