// Reads accessors: strided, sparse, normalised and quantised, every offset and count checked against its buffer first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/result.h"
#include "core/gltf/document.h"

namespace parsel {

/// Why the accessor's bytes are out of reach although nothing is damaged (a compressed bufferView, an external file
/// that was not given), a clause; empty when they are within reach.
std::string out_of_reach(const GltfDocument& document, int accessor);

/// How many elements the accessor says it has; 0 when there is no such accessor.
std::size_t accessor_count(const GltfDocument& document, int accessor);

/// POSITION: VEC3 of float, or of (normalised) integers as KHR_mesh_quantization allows. Values as in the file, NaN and
/// infinities included. Error place is "accessor N".
Result<std::vector<Vec3>> read_positions(const GltfDocument& document, int accessor);

/// Indices: SCALAR of unsigned byte, short or int.
Result<std::vector<std::uint32_t>> read_indices(const GltfDocument& document, int accessor);

}  // namespace parsel
