// Models that are not part of the project: the folder that PARSEL_DATA names, if it does.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <string>

namespace parsel::test {

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The .glb and .gltf files below a folder of PARSEL_DATA, in order of their names. None, and a line that says so,
/// where there is no such folder.
inline std::set<std::filesystem::path> real_models(const std::string& folder) {
  std::set<std::filesystem::path> files;
  const char* data = std::getenv("PARSEL_DATA");
  if (data == nullptr || *data == '\0') {
    std::cerr << "skipped: PARSEL_DATA is not set, so " << folder << " is not read\n";
    return files;
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(std::filesystem::path(data) / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".glb" || extension == ".gltf") files.insert(entry.path());
  }
  return files;
}

}  // namespace parsel::test
