// Reading and writing the accessors of a glTF file, every index and range checked before use.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/export/apply_file.h"

namespace parsel::gltf {

/// Component types of glTF.
inline constexpr std::size_t type_float = 5126;

/// Where the elements of an accessor lie. Checked: the whole of it lies inside its buffer view and buffer.
struct Layout {
  std::size_t count = 0;
  std::size_t components = 0;      ///< 1 to 4
  std::size_t component_type = 0;  ///< 5120 … 5126
  bool normalized = false;
  bool sparse = false;
  std::optional<std::size_t> view;  ///< without one the elements are zero
  std::size_t buffer = 0;
  std::size_t begin = 0;    ///< of the first element, in the buffer
  std::size_t stride = 0;   ///< bytes from element to element
  std::size_t element = 0;  ///< bytes of one element

  std::size_t end() const { return count == 0 ? begin : begin + stride * (count - 1) + element; }
};

/// The byte range of a buffer view in its buffer.
struct ViewRange {
  std::size_t buffer = 0, begin = 0, end = 0;
};

/// None when the view is malformed or reaches beyond its buffer.
std::optional<ViewRange> view_range(const File& file, std::size_t view);

/// Error: no such accessor, a malformed field, a range outside of its buffer, a matrix type.
Result<Layout> layout(const File& file, std::size_t accessor);

/// All components in order, count × components, normalised integers as fractions, sparse values applied. Reads what
/// the file brought, not what has been patched. Error: as layout(), or a buffer that is not there.
Result<std::vector<double>> read_accessor(const File& file, std::size_t accessor);
/// A SCALAR accessor of unsigned integers. Error: as read_accessor(), or another type.
Result<std::vector<std::uint32_t>> read_indices(const File& file, std::size_t accessor);

/// Who reads which bytes of the file as it came: what may be patched where it is, and what must be written anew.
class Storage {
 public:
  explicit Storage(const File& file);

  /// Whether the accessor's bytes are plain floats in the binary chunk that nothing else in the file reads.
  bool can_patch_in_place(std::size_t accessor) const;
  /// How often a buffer view is referred to, by accessors, sparse parts, images and extensions.
  std::size_t references(std::size_t view) const { return view < references_.size() ? references_[view] : 0; }

 private:
  void count_references(const JsonText& json);

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
