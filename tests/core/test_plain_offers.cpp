// What geometry and labels offer by themselves.
#include "core/infer/plain_offers.h"

#include <doctest/doctest.h>

#include <set>

#include "core/check/check.h"
#include "core/infer/reading.h"
#include "core/propagate/clean.h"
#include "tests/core/plain_measure.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using namespace parsel::test;

namespace {

std::set<std::string> titles(const Shape& shape) {
  std::set<std::string> all;
  for (const PlainOffer& offer : plain_offers(shape)) all.insert(offer.title);
  return all;
}

void check_has(const Shape& shape, std::initializer_list<const char*> wanted) {
  const std::set<std::string> found = titles(shape);
  std::string all;
  for (const std::string& title : found) all += title + ", ";
  for (const char* title : wanted) {
    INFO(shape.name, " offers ", all);
    CHECK(found.count(title) == 1);
  }
}

}  // namespace

TEST_CASE("furniture offers its sizes, counts, legs, lean and panels") {
  check_has(gallery_shape("chair"), {"Width", "Depth", "Height", "Slat count", "Lean of the back", "Seat thickness"});
  check_has(gallery_shape("dining_table"), {"Width", "Height", "Depth", "Tabletop thickness"});
  check_has(gallery_shape("bookcase"), {"Width", "Height", "Depth", "Shelf count"});
  check_has(gallery_shape("cabinet"), {"Width", "Depth", "Foot height"});
  check_has(gallery_shape("ladder"), {"Rung count"});
}

TEST_CASE("no two offers are the same edit, none is refused by the shape") {
  for (const GalleryModel& model : gallery_models()) {
    const Shape& shape = gallery_shape(model.id);
    std::set<std::string> signatures;
    for (const PlainOffer& offer : plain_offers(shape)) {
      CAPTURE(model.id);
      CAPTURE(offer.title);
      CHECK(signatures.insert(reading_signature(shape, offer.edit.seed)).second);
      CHECK(resolve(offer.edit, shape).ok());
    }
    CHECK(plain_offers(shape, 2).size() <= 2);
  }
}

TEST_CASE("rows are called as their labels call them, words apart and sides in") {
  auto parts = fixture::slat_chair(5);
  for (auto& part : parts) {
    if (part.name.rfind("slat", 0) == 0) part.name = "back slat";
  }
  CHECK(titles(fixture::shape(parts)).count("Back slat count") == 1);
}

TEST_CASE("a model whose labels say nothing offers what its geometry tells") {
  auto parts = fixture::slat_chair(5);
  int number = 0;
  for (auto& part : parts) part.name = "object " + std::to_string(++number);
  const std::set<std::string> found = titles(fixture::shape(parts));
  CHECK(found.count("Width") == 1);
  CHECK(found.count("Depth") == 1);
  CHECK(found.count("Height") == 1);  // that of the legs, which set it
}

TEST_CASE("offers that propagate cleanly pass the checker") {
  const Shape& shape = gallery_shape("dining_table");
  int clean = 0;
  for (const PlainOffer& offer : plain_offers(shape)) {
    CAPTURE(offer.title);
    const auto found = propagate_cleanly(shape, offer.edit);
    if (!found.ok()) continue;
    ++clean;
    CHECK(check_program(shape, found->program).accepted());
    for (const RelationReport& report : found->program.layers[0].relations)
      CHECK(report.status != RelationStatus::broken);
  }
  CHECK(clean >= 3);
}
