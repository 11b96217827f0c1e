// The vectors in tests/golden, for the tests that read them.
#pragma once

#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/core/tests_folder.h"

namespace parsel {

/// Parsed once; the reference stays valid.
inline const nlohmann::json& golden(const std::string& name) {
  static std::map<std::string, nlohmann::json> files;
  const auto found = files.find(name);
  if (found != files.end()) return found->second;
  std::ifstream file(test::tests_folder() + "/golden/" + name);
  return files.emplace(name, nlohmann::json::parse(file)).first->second;
}

/// A file as it is.
inline std::string golden_text(const std::string& name) {
  std::ifstream file(test::tests_folder() + "/golden/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace parsel
