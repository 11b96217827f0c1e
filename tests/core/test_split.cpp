// Models whose parts nobody told apart: what the generators made as parts comes apart as these parts.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/edit/evaluate.h"
#include "core/gallery/gallery.h"
#include "core/gltf/accessor.h"
#include "core/propagate/propagate.h"
#include "core/shape/abstraction.h"
#include "core/shape/gltf_import.h"
#include "core/split/split.h"
#include "tests/core/glb_fixture.h"

using namespace parsel;

namespace {

struct Bounds {
  Vec3 low, high;
};

Bounds bounds_of(const PartMesh& mesh, const Frame& frame) {
  Bounds b{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      const Vec3 p = frame.to_model(mesh.positions[v]);
      b.low = b.low.cwiseMin(p);
      b.high = b.high.cwiseMax(p);
    }
  }
  return b;
}

std::vector<Bounds> all_bounds(std::string_view glb) {
  const auto model = import_gltf(glb);
  REQUIRE(model.ok());
  std::vector<Bounds> all;
  for (const PartMesh& mesh : model->meshes) all.push_back(bounds_of(mesh, model->frame));
  return all;
}

/// How many of `wanted` have a box of their own among `found`, in metres.
std::size_t matched(const std::vector<Bounds>& wanted, std::vector<Bounds> found) {
  std::size_t count = 0;
  for (const Bounds& w : wanted) {
    const auto at = std::find_if(found.begin(), found.end(), [&](const Bounds& f) {
      return (w.low - f.low).cwiseAbs().maxCoeff() < 1e-5 && (w.high - f.high).cwiseAbs().maxCoeff() < 1e-5;
    });
    if (at == found.end()) continue;
    found.erase(at);
    ++count;
  }
  return count;
}

/// All parts of a model as one mesh without names, in metres.
std::string merged(std::string_view glb) {
  const auto model = import_gltf(glb);
  REQUIRE(model.ok());
  fixture::Mesh all;
  for (const PartMesh& mesh : model->meshes) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    for (const Vec3& p : mesh.positions) all.positions.push_back(model->frame.to_model(p));
    for (const Triangle& t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return fixture::document({{"", all}}).glb();
}

fixture::Mesh both(fixture::Mesh a, const fixture::Mesh& b) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

std::size_t parts_of(std::string_view glb, const SplitOptions& options = {}) {
  const auto split = split_model(glb, {}, options);
  REQUIRE(split.ok());
  const auto again = import_gltf(split->glb);
  REQUIRE(again.ok());
  CHECK(again->meshes.size() == split->parts);
  return split->parts;
}

}  // namespace

TEST_CASE("every gallery model comes apart into its generator's parts when it is merged into one mesh") {
  for (const GalleryModel& entry : gallery_models()) {
    CAPTURE(entry.id);
    const auto asset = build(entry);
    REQUIRE(asset.ok());
    const std::vector<Bounds> wanted = all_bounds(asset->glb);
    const auto split = split_model(merged(asset->glb));
    REQUIRE(split.ok());
    CHECK(split->before == 1);
    CHECK(split->by == SplitMethod::components);
    CHECK(split->parts == wanted.size());
    CHECK(matched(wanted, all_bounds(split->glb)) == wanted.size());
    const auto shape = abstract_shape(split->glb, entry.id);
    REQUIRE(shape.ok());
    CHECK(validate(shape->shape).ok());
  }
}

TEST_CASE("widening the merged, nameless chair moves every part as on the labelled one") {
  const auto asset = build(*find_gallery_model("chair"));
  REQUIRE(asset.ok());
  const auto split = split_model(merged(asset->glb));
  REQUIRE(split.ok());
  const auto labelled = abstract_shape(asset->glb, "chair"), nameless = abstract_shape(split->glb, "model");
  REQUIRE(labelled.ok());
  REQUIRE(nameless.ok());
  const Shape &a = labelled->shape, &b = nameless->shape;
  const auto centre = [](const Part& part) { return Vec3(part.hexahedron.corners.colwise().mean().transpose()); };
  const auto twin = [&](const Part& part) {
    std::optional<PartIndex> nearest;
    for (const PartIndex p : b.parts.indices()) {
      if (b.parts[p].is_virtual()) continue;
      if ((centre(b.parts[p]) - centre(part)).norm() < 1e-4) nearest = p;
    }
    REQUIRE(nearest.has_value());
    return *nearest;
  };
  const auto widened = [](const Shape& shape, const std::string& seat) {
    const auto request =
        edit_request_from_json({{"seed", nlohmann::json::array({{{"op", "scale_1d"},
                                                                 {"part", seat},
                                                                 {"feature", {0, 0, 0}},
                                                                 {"origin", {{"part", seat}, {"at", {0, 0, 0}}}},
                                                                 {"direction", {1, 0, 0}},
                                                                 {"amount", "x"}}})}});
    REQUIRE(request.ok());
    auto found = propagate(shape, *request);
    REQUIRE(found.ok());
    return Evaluator(found->program, shape)({0.2});
  };
  const auto seat = a.find_part("seat");
  REQUIRE(seat.has_value());
  const State on_a = widened(a, "seat"), on_b = widened(b, b.parts[twin(a.parts[*seat])].id);
  for (const PartIndex p : a.parts.indices()) {
    if (a.parts[p].is_virtual()) continue;
    CAPTURE(a.parts[p].id);
    const Corners &x = on_a.parts[p], &y = on_b.parts[twin(a.parts[p])];
    CHECK((x.colwise().minCoeff() - y.colwise().minCoeff()).cwiseAbs().maxCoeff() < 0.005);
    CHECK((x.colwise().maxCoeff() - y.colwise().maxCoeff()).cwiseAbs().maxCoeff() < 0.005);
  }
}

TEST_CASE("boxes that share corners, an edge or a whole face come apart") {
  const Vec3 size(1, 1, 1);
  const fixture::Mesh first = fixture::box({0, 0, 0}, size);
  for (const Vec3& at : {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(1, 1, 1), Vec3(0, 1, 0)}) {
    CAPTURE(at.transpose());
    CHECK(parts_of(fixture::document({{"", both(both(first, fixture::box(at, size)), fixture::box({5, 0, 0}, size))}})
                       .glb()) == 3);
  }
}

TEST_CASE("what is small goes to what it sits on, unless it is split finely") {
  fixture::Mesh mesh = both(fixture::box({0, 0, 0}, {1, 0.1, 1}), fixture::box({3, 0, 0}, {1, 0.1, 1}));
  mesh = both(both(mesh, fixture::box({6, 0, 0}, {1, 0.1, 1})), fixture::box({3, 0.06, 0}, {0.02, 0.02, 0.02}));
  const std::string glb = fixture::document({{"", mesh}}).glb();
  const auto split = split_model(glb);
  REQUIRE(split.ok());
  CHECK(split->parts == 3);
  CHECK(split->joined == 1);
  CHECK(matched({{{2.5, -0.05, -0.5}, {3.5, 0.07, 0.5}}}, all_bounds(split->glb)) == 1);
  CHECK(parts_of(glb, {SplitMethod::automatic, 1}) == 4);
}

TEST_CASE("a fused model comes apart where it is creased inwards") {
  // A T: a column on a slab, one closed surface. The column's foot is a hole in the slab's top.
  fixture::Mesh slab = fixture::box({0, 0, 0}, {2, 0.4, 2});
  fixture::Mesh column = fixture::box({0, 1.2, 0}, {0.4, 2, 0.4});
  fixture::Mesh fused = both(slab, column);
  // Corners with +y are 2, 3, 6, 7 of the slab; those with -y are 0, 1, 4, 5 of the column, at 8.
  std::erase_if(fused.triangles, [](const auto& t) {
    const auto all_of = [&](std::initializer_list<std::uint32_t> set) {
      return std::all_of(t.begin(), t.end(), [&](auto v) { return std::find(set.begin(), set.end(), v) != set.end(); });
    };
    return all_of({2, 3, 6, 7}) || all_of({8, 9, 12, 13});
  });
  const std::array<std::uint32_t, 4> outer = {2, 6, 7, 3}, inner = {8, 12, 13, 9};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    fused.triangles.push_back({outer[i], outer[next], inner[next]});
    fused.triangles.push_back({outer[i], inner[next], inner[i]});
  }
  const std::string glb = fixture::document({{"", fused}}).glb();
  CHECK(parts_of(glb, {SplitMethod::components, 0.5}) == 1);
  const auto split = split_model(glb);
  REQUIRE(split.ok());
  CHECK(split->by == SplitMethod::regions);
  CHECK(split->parts == 2);
  CHECK(matched({{{-1, -0.2, -1}, {1, 0.2, 1}}, {{-0.2, 0.2, -0.2}, {0.2, 2.2, 0.2}}}, all_bounds(split->glb)) == 2);
}

TEST_CASE("what bounds nothing by itself belongs to what is behind it") {
  SUBCASE("a hollow, also when it lies within another part's box") {
    fixture::Mesh hollow = fixture::box({0, 0, 0}, {1, 1, 1});
    for (auto& t : hollow.triangles) std::swap(t[1], t[2]);
    const fixture::Mesh inner = fixture::box({0.1, 0, 0}, {0.2, 0.2, 0.2});
    const std::string glb =
        fixture::document({{"", both(both(fixture::box({0, 0, 0}, {2, 2, 2}), hollow), inner)}}).glb();
    const auto split = split_model(glb, {}, {SplitMethod::components, 1});
    REQUIRE(split.ok());
    CHECK(split->parts == 2);
    CHECK(matched({{{-1, -1, -1}, {1, 1, 1}}, {{0, -0.1, -0.1}, {0.2, 0.1, 0.1}}}, all_bounds(split->glb)) == 2);
    const auto model = import_gltf(split->glb);
    REQUIRE(model.ok());
    std::vector<std::size_t> sizes;
    for (const PartMesh& mesh : model->meshes) sizes.push_back(mesh.triangles.size());
    std::sort(sizes.begin(), sizes.end());
    CHECK(sizes == std::vector<std::size_t>{12, 24});
  }
  SUBCASE("what is inside out stands by itself") {
    fixture::Mesh turned = fixture::box({0, 0, 0}, {1, 1, 1});
    for (auto& t : turned.triangles) std::swap(t[1], t[2]);
    CHECK(parts_of(fixture::document({{"", both(turned, fixture::box({5, 0, 0}, {1, 1, 1}))}}).glb(),
                   {SplitMethod::components, 1}) == 2);
  }
  SUBCASE("the inner faces of a drawer") {
    // A box without its top (corners 2, 3, 6, 7) in another, and a rim between them.
    fixture::Mesh drawer = fixture::box({0, 0, 0}, {2, 1, 3}), inner = fixture::box({0, 0.1, 0}, {1.8, 0.8, 2.8});
    for (auto& t : inner.triangles) std::swap(t[1], t[2]);
    drawer = both(drawer, inner);
    std::erase_if(drawer.triangles, [](const auto& t) {
      return std::all_of(t.begin(), t.end(), [](auto v) { return (v % 8) == 2 || v % 8 == 3 || v % 8 >= 6; });
    });
    const std::array<std::uint32_t, 4> rim = {2, 6, 7, 3};
    for (std::size_t i = 0; i < 4; ++i) {
      const std::uint32_t a = rim[i], b = rim[(i + 1) % 4];
      drawer.triangles.push_back({a, b, b + 8});
      drawer.triangles.push_back({a, b + 8, a + 8});
    }
    CHECK(parts_of(fixture::document({{"", drawer}}).glb(), {SplitMethod::regions, 1}) == 1);
  }
}

TEST_CASE("one that is fused but for small things comes apart along its creases") {
  // Three screws and a T: four components, one of which has nearly all of the surface.
  fixture::Mesh fused = both(fixture::box({0, 0, 0}, {2, 0.4, 2}), fixture::box({0, 1.2, 0}, {0.4, 2, 0.4}));
  std::erase_if(fused.triangles, [](const auto& t) {
    const auto lies = [&](auto... set) {
      return std::all_of(t.begin(), t.end(), [&](auto v) { return ((v == set) || ...); });
    };
    return lies(2u, 3u, 6u, 7u) || lies(8u, 9u, 12u, 13u);
  });
  const std::array<std::uint32_t, 4> outer = {2, 6, 7, 3}, inner = {8, 12, 13, 9};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    fused.triangles.push_back({outer[i], outer[next], inner[next]});
    fused.triangles.push_back({outer[i], inner[next], inner[i]});
  }
  for (const double x : {-0.7, 0.0, 0.7}) fused = both(fused, fixture::box({x, 0.25, 0.8}, {0.1, 0.1, 0.1}));
  const auto split = split_model(fixture::document({{"", fused}}).glb());
  REQUIRE(split.ok());
  CHECK(split->by == SplitMethod::regions);
  CHECK(split->parts == 5);
}

TEST_CASE("what is creased all over is left whole, unless creases are asked for") {
  // A floor of pyramids that stand in a grid, each bounded by creases.
  fixture::Mesh floor;
  constexpr std::uint32_t across = 16;
  for (std::uint32_t z = 0; z <= across; ++z) {
    for (std::uint32_t x = 0; x <= across; ++x) floor.positions.push_back(Vec3(x, 0, z));
  }
  for (std::uint32_t z = 0; z < across; ++z) {
    for (std::uint32_t x = 0; x < across; ++x) {
      const std::uint32_t first = z * (across + 1) + x, below = first + across + 1;
      const auto top = static_cast<std::uint32_t>(floor.positions.size());
      floor.positions.push_back(Vec3(x + 0.5, 0.8, z + 0.5));
      floor.triangles.insert(
          floor.triangles.end(),
          {{first, below, top}, {below, below + 1, top}, {below + 1, first + 1, top}, {first + 1, first, top}});
    }
  }
  const std::string glb = fixture::document({{"", floor}}).glb();
  const auto split = split_model(glb);
  REQUIRE(split.ok());
  CHECK(split->parts == 1);
  CHECK(split->by == SplitMethod::components);
  REQUIRE(split->warnings.size() == 1);
  CHECK(split->warnings[0].text.find("creased all over: cut it by hand") != std::string::npos);
  CHECK(parts_of(glb, {SplitMethod::regions, 0.5}) == across * across);
}

TEST_CASE("faces of one solid that are primitives of their own become one part") {
  fixture::Document d = fixture::document({{"", fixture::box({0, 0, 0}, {1, 2, 3})}});
  nlohmann::json& primitives = d.json["meshes"][0]["primitives"];
  const nlohmann::json whole = primitives[0];
  const nlohmann::json indices = d.json["accessors"][whole["indices"].get<std::size_t>()];
  primitives = nlohmann::json::array();
  for (std::size_t face = 0; face < 6; ++face) {
    nlohmann::json part = whole, accessor = indices;
    accessor["byteOffset"] = face * 6 * 4;  // two triangles of 32-bit indices
    accessor["count"] = 6;
    part["indices"] = d.json["accessors"].size();
    d.json["accessors"].push_back(accessor);
    primitives.push_back(part);
  }
  const auto split = split_model(d.glb());
  REQUIRE(split.ok());
  CHECK(split->before == 6);
  CHECK(split->parts == 1);
  CHECK(matched({{{-0.5, -1, -1.5}, {0.5, 1, 1.5}}}, all_bounds(split->glb)) == 1);
  const auto document = gltf::read_document(split->glb, {});
  REQUIRE(document.ok());
  for (std::size_t a = 0; a < document->accessors.size(); ++a) CHECK(gltf::check_accessor(*document, a).ok());
}

TEST_CASE("a split model that is split again stays as it is") {
  const auto asset = build(*find_gallery_model("chair"));
  REQUIRE(asset.ok());
  const auto once = split_model(merged(asset->glb));
  REQUIRE(once.ok());
  const auto twice = split_model(once->glb);
  REQUIRE(twice.ok());
  CHECK(twice->parts == once->parts);
  CHECK(all_bounds(twice->glb).size() == all_bounds(once->glb).size());
}

TEST_CASE("what cannot be split is refused in words, and soon") {
  SUBCASE("a hundred thousand pieces") {
    fixture::Mesh dust;
    for (std::uint32_t i = 0; i < 100'000; ++i) {
      const Vec3 at(i % 50, i / 50 % 50, i / 2500);
      dust.positions.insert(dust.positions.end(), {at, at + Vec3(0.5, 0, 0), at + Vec3(0, 0.5, 0)});
      dust.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const auto split = split_model(fixture::document({{"", dust}}).glb());
    REQUIRE(!split.ok());
    CHECK(split.error().cause.find("2000 pieces, however coarse") != std::string::npos);
    CHECK(split.error().fix.find("by hand") != std::string::npos);
  }
  SUBCASE("thousands of small pieces on three large ones go to these, unless a method is named") {
    fixture::Mesh mesh;
    for (const double x : {0.0, 30.0, 60.0}) mesh = both(mesh, fixture::box({x, -1, 0}, {20, 1, 60}));
    for (std::uint32_t i = 0; i < 2'100; ++i) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      const Vec3 at(30.0 * (i % 3) + i / 3 % 20 - 10.0, -0.5, 1.5 * (i / 60) - 25.0);
      mesh.positions.insert(mesh.positions.end(), {at, at + Vec3(0.9, 0, 0), at + Vec3(0, 0.9, 0.9)});
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
    const std::string glb = fixture::document({{"", mesh}}).glb();
    const auto split = split_model(glb);
    REQUIRE(split.ok());
    CHECK(split->parts == 3);
    CHECK(split->joined == 2'100);
    REQUIRE(split->warnings.size() == 1);
    CHECK(split->warnings[0].text.find("split coarser") != std::string::npos);
    const auto named = split_model(glb, {}, {SplitMethod::components, 0.5});
    REQUIRE(!named.ok());
    CHECK(named.error().fix.find("coarser") != std::string::npos);
  }
  SUBCASE("a number that is none") {
    const std::string glb = fixture::document({{"", fixture::box({0, 0, 0}, {1, 1, 1})}}).glb();
    CHECK(!split_model(glb, {}, {SplitMethod::automatic, std::nan("")}).ok());
    CHECK(!split_model(glb, {}, {SplitMethod::automatic, 1.5}).ok());
  }
  SUBCASE("one closed surface") {
    CHECK(parts_of(fixture::document({{"ball", fixture::box({0, 0, 0}, {1, 1, 1})}}).glb()) == 1);
  }
}
