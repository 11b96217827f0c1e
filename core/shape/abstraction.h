// From the bytes of a model to its structured shape: the one entry point of core/shape.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/index.h"
#include "core/base/result.h"
#include "core/gltf/document.h"
#include "core/shape/corrections.h"
#include "core/shape/part.h"
#include "core/shape/shape.h"

namespace parsel {

/// Labels that a person gives instead of the file's own, by part: "node:3" for every primitive of glTF node 3, or
/// "node:3/1" for its primitive 1 alone, which counts before the former. Ids are no keys here: they follow from labels.
using Labels = std::map<std::string, std::string, std::less<>>;

struct Abstraction {
  Shape shape;
  /// The mesh of every real part: real parts come first in shape.parts, so meshes[p] belongs to shape.parts[p], and a
  /// virtual part is one whose index is at least meshes.size().
  PartData<PartMesh> meshes;
};

/// Reads a GLB or glTF file and finds its parts, hexahedra, relations and virtual parts (ParSEL §4.1, supplement §3.1,
/// §3.3). `name` is the shape's name, usually the file's without extension. The result passes validate().
/// Deterministic: the same bytes give the same shape, ids and numbers. Fails when the file is damaged, too large, or
/// holds no triangle mesh that can be read; what else is left out stands in shape.warnings. `labels` are cleaned like
/// the file's own; one that names no part of the file is refused, its key being the error's place. So are `corrections`;
/// one that cannot be, such as of parts that are no mirror images by far, is left out and stands in shape.warnings.
Result<Abstraction> abstract_shape(std::string_view bytes, std::string_view name, const ExternalBuffers& buffers = {},
                                   const Labels& labels = {}, const Corrections& corrections = {});

/// The URIs of external buffers that the file names, percent-decoded, for the caller to fetch before abstract_shape().
/// Empty for a damaged file, which abstract_shape() then refuses by name.
std::vector<std::string> external_buffer_uris(std::string_view bytes);

}  // namespace parsel
