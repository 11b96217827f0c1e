// What each way of splitting would tell apart, without doing it.
#include <doctest/doctest.h>

#include <algorithm>

#include "core/gallery/gallery.h"
#include "core/shape/gltf_import.h"
#include "core/split/split.h"
#include "tests/core/glb_fixture.h"

using namespace parsel;

namespace {

void check_as_done(std::string_view glb, double fine) {
  const auto found = split_ways(glb, {}, fine);
  REQUIRE(found.ok());
  REQUIRE(found->ways.size() == 3);
  for (const SplitWay& way : found->ways) {
    CAPTURE(to_string(way.by));
    const auto split = split_model(glb, {}, {way.by, fine});
    CHECK(way.too_many == !split.ok());
    if (!split.ok()) continue;
    CHECK(way.parts == split->parts);
    CHECK(found->before == split->before);
  }
}

}  // namespace

TEST_CASE("ways to split: as many parts as splitting so gives, for every gallery model, coarse and fine") {
  for (const GalleryModel& model : gallery_models()) {
    CAPTURE(model.id);
    const auto built = build(model);
    REQUIRE(built.ok());
    check_as_done(built->glb, 0.5);
    check_as_done(built->glb, 1);
  }
}

TEST_CASE("ways to split: what hangs together, and more than a model may have") {
  fixture::Mesh mesh;
  const auto add = [&](const Vec3& at) {
    const fixture::Mesh box = fixture::box(at, {1, 1, 1});
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), box.positions.begin(), box.positions.end());
    for (const auto& t : box.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  };
  for (int i = 0; i < 3; ++i) add({2.0 * i, 0, 0});
  const auto few = split_ways(fixture::document({{"", mesh}}).glb());
  REQUIRE(few.ok());
  CHECK(few->before == 1);
  CHECK(few->ways[0].parts == 3);
  CHECK(few->ways[1].parts == 1);  // one material
  CHECK(few->ways[2].parts == 3);  // boxes are not creased inwards

  const auto most = static_cast<int>(ImportLimits().parts);
  for (int i = 3; i <= most; ++i) add({2.0 * i, 0, 0});
  const auto many = split_ways(fixture::document({{"", mesh}}).glb(), {}, 1);
  REQUIRE(many.ok());
  CHECK(many->ways[0].too_many);
  CHECK_FALSE(many->ways[1].too_many);
  CHECK_FALSE(split_ways(fixture::document({{"", mesh}}).glb(), {}, 1.5).ok());
  CHECK_FALSE(split_ways("no model").ok());
}
