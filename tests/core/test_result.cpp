#include <doctest/doctest.h>

#include <string>

#include "core/base/result.h"

using namespace parsel;

TEST_CASE("an error's message names stage, place, cause and fix") {
  const Error error{"shape/gltf_import", "accessor 3", "the buffer ends early", "export the file again"};
  CHECK(error.message() == "shape/gltf_import: accessor 3: the buffer ends early; export the file again.");
  const Error bare{"cli", "", "the file is empty", ""};
  CHECK(bare.message() == "cli: the file is empty.");
}

TEST_CASE("a result holds either a value or an error") {
  const Result<std::string> good = std::string("seat");
  REQUIRE(good.ok());
  CHECK(*good == "seat");
  CHECK(good->size() == 4);
  const Result<std::string> bad = Error{"a", "b", "c", "d"};
  CHECK_FALSE(bad.ok());
  CHECK(bad.error().cause == "c");
  CHECK(success().ok());
}
