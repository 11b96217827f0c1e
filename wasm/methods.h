// What the page can ask of the core: a name, JSON and bytes in, JSON and bytes out. Plain C++, without Emscripten.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace parsel::wasm {

struct Input {
  nlohmann::json parameters;         ///< an object; each method checks its own
  std::vector<std::string> buffers;  ///< raw bytes
  Progress progress;                 ///< may be empty
};

struct Output {
  nlohmann::json result;
  std::vector<std::string> buffers;
};

struct Method {
  std::string_view name;
  Result<Output> (*run)(const Input& input);
};

/// Every method of this module, each of the same name in web/src/worker/protocol.ts. methods.cpp has those of the module
/// that the page begins with, cad_methods.cpp those of the one for CAD programs.
std::span<const Method> methods();

}  // namespace parsel::wasm
