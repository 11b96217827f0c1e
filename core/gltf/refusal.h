// What the reader says of a file that it refuses; one stage, whoever asks.
#pragma once

#include <string>
#include <utility>

#include "core/base/result.h"

namespace parsel::gltf {

inline Error refused(std::string place, std::string cause, std::string fix = "export the model again") {
  return {"gltf/document", std::move(place), std::move(cause), std::move(fix)};
}

}  // namespace parsel::gltf
