// Reads accessors: strided, sparse, normalised and quantised, every offset and count checked against its buffer first.
// Error place is "accessor N" throughout.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/result.h"
#include "core/gltf/document.h"

namespace parsel::gltf {

/// Component types of glTF.
inline constexpr std::size_t type_byte = 5120, type_unsigned_byte = 5121, type_short = 5122, type_unsigned_short = 5123,
                             type_unsigned_int = 5125, type_float = 5126;

/// Where the elements of an accessor lie. Checked: the whole of it lies inside its buffer view and buffer.
struct Layout {
  std::size_t count = 0;
  std::size_t components = 0;  ///< 1 to 4
  std::size_t component_type = 0;
  bool normalized = false;
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

/// None when there is no such view or it reaches beyond its buffer (as far as the file says how long that is).
std::optional<ViewRange> view_range(const Document& document, std::size_t view);

/// Error: no such accessor, a type or stride that glTF does not know, a range outside of its view or buffer.
Result<Layout> layout(const Document& document, std::size_t accessor);

/// Whether read_accessor() would succeed, without reading the elements (those of a sparse accessor are looked at).
Status check_accessor(const Document& document, std::size_t accessor);

/// All components in order, count × components, normalised integers as fractions (glTF 2.0 §3.6.2.2), sparse values
/// applied, NaN and infinities as they are. Error: as layout(), or a buffer that is not there.
Result<std::vector<double>> read_accessor(const Document& document, std::size_t accessor);

/// POSITION: VEC3 of float, or of (normalised) integers as KHR_mesh_quantization allows.
Result<std::vector<Vec3>> read_positions(const Document& document, std::size_t accessor);

/// Indices: SCALAR of unsigned byte, short or int.
Result<std::vector<std::uint32_t>> read_indices(const Document& document, std::size_t accessor);

/// Why the accessor's bytes are out of reach although nothing is damaged (a compressed bufferView, an external file
/// that was not given), a clause; empty when they are within reach.
std::string out_of_reach(const Document& document, std::size_t accessor);

/// How many elements the accessor says it has; 0 when there is no such accessor.
std::size_t accessor_count(const Document& document, std::size_t accessor);

}  // namespace parsel::gltf
