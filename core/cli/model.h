// Loads a model with the external buffers that lie next to it.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/shape/abstraction.h"

namespace parsel::cli {

struct Model {
  std::string bytes;
  ExternalBuffers buffers;
  Abstraction abstraction;
};

/// Reads MODEL.glb or MODEL.gltf; a .gltf's buffers are read from its own folder or below, never from elsewhere. The
/// shape's name is the file's without folder and extension. `labels` and `corrections`: see abstract_shape().
Result<Model> load_model(const std::string& path, const Labels& labels = {}, const Corrections& corrections = {});

}  // namespace parsel::cli
