// What core/shape finds in the gallery's files is what their generators put there.
#include <doctest/doctest.h>

#include "core/shape/abstraction.h"
#include "tests/core/gallery_difference.h"

using namespace parsel;

TEST_CASE("gallery: parts, boxes and relations found are those that the generators state") {
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    const Result<GalleryAsset> asset = build(model);
    REQUIRE(asset.ok());
    const Result<Abstraction> found = abstract_shape(asset->glb, model.id);
    REQUIRE(found.ok());
    CHECK(found->shape.warnings.empty());
    for (const std::string& line : test::part_differences(*asset, found->shape, 0.002)) {
      FAIL_CHECK(model.id << ": " << line);
    }
    for (const std::string& line : test::relation_differences(*asset, found->shape)) {
      FAIL_CHECK(model.id << ": " << line);
    }
  }
}
