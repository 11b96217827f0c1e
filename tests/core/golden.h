// The vectors in tests/golden, for the tests that read them.
#pragma once

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace parsel {

/// Parsed once; the reference stays valid.
inline const nlohmann::json& golden(const std::string& name) {
  static std::map<std::string, nlohmann::json> files;
  const auto found = files.find(name);
  if (found != files.end()) return found->second;
  std::ifstream file(std::string(PARSEL_TESTS_DIR "/golden/") + name);
  return files.emplace(name, nlohmann::json::parse(file)).first->second;
}

}  // namespace parsel
