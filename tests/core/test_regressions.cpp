// Inputs on which something went wrong once: every step accepts what the one before it wrote, or refuses by name.
#include <doctest/doctest.h>

#include <filesystem>
#include <set>

#include "tests/core/real_models.h"
#include "tests/core/tests_folder.h"
#include "tests/fuzz/pipeline.h"

using namespace parsel;

TEST_CASE("what the fuzzers found stays mended") {
  const std::filesystem::path folder = test::tests_folder() + "/fuzz/regressions";
  std::set<std::filesystem::path> models;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".glb") models.insert(entry.path());
  }
  for (std::filesystem::path path : models) {
    CAPTURE(path.filename().string());
    const std::string glb = test::read_bytes(path);
    const std::string edit = test::read_bytes(path.replace_extension(".json"));
    CHECK(!edit.empty());
    const fuzz::Walk walked = fuzz::walk(glb, edit);
    CHECK_MESSAGE(!walked.fault, walked.fault.value_or(""));
  }
}
