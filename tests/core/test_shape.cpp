#include <doctest/doctest.h>

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "core/shape/shape.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;

namespace {

std::string fault(const std::function<void(Shape&)>& change) {
  static const Shape good = fixture::shape(fixture::slat_chair(4));
  Shape shape = good;
  change(shape);
  const Status sound = validate(shape);
  return sound.ok() ? "" : sound.error().message();
}

Relation& first(Shape& shape, RelationKind kind) {
  for (Relation& r : shape.relations) {
    if (r.kind == kind) return r;
  }
  FAIL("no such relation");
  return *shape.relations.begin();
}

}  // namespace

TEST_CASE("parts are found by id and by glTF node, relations by id") {
  const Shape shape = fixture::shape(fixture::slat_chair(4));
  CHECK(shape.find_part("seat") == PartIndex(0));
  CHECK(shape.find_part("node:1") == PartIndex(1));
  CHECK_FALSE(shape.find_part("node:").has_value());
  CHECK_FALSE(shape.find_part("node:1x").has_value());
  CHECK_FALSE(shape.find_part("node:-1").has_value());
  CHECK_FALSE(shape.find_part("sofa").has_value());
  CHECK(shape.find_relation("r1").has_value());
  CHECK(shape.find_relation("t1").has_value());
  CHECK_FALSE(shape.find_relation("t9").has_value());
}

TEST_CASE("validate finds every kind of fault") {
  CHECK(fault([](Shape&) {}) == "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault([&](Shape& s) { s.parts[PartIndex(0)].hexahedron.corners(3, 1) = nan; }) != "");
  CHECK(fault([&](Shape& s) { s.frame.scale = 0; }) != "");
  CHECK(fault([&](Shape& s) { s.parts[PartIndex(0)].id = s.parts[PartIndex(1)].id; }) != "");
  CHECK(fault([&](Shape& s) { s.parts[PartIndex(0)].hexahedron.corners(3, 1) += 0.1; }) != "");
  CHECK(fault([&](Shape& s) { s.parts[PartIndex(0)].hexahedron.axes.row(0) *= -1; }) != "");
  CHECK(fault([&](Shape& s) { s.parts[PartIndex(0)].node = -1; }) != "");
  CHECK(fault([&](Shape& s) { s.parts[*s.find_part("slat_group")].members.pop_back(); }) != "");
  CHECK(fault([&](Shape& s) { s.parts[*s.find_part("slat_group")].group.reset(); }) != "");
  CHECK(fault([&](Shape& s) { s.parts[PartIndex(0)].group = s.find_relation("t1"); }) != "");
  CHECK(fault([&](Shape& s) { first(s, RelationKind::reflection).parts.pop_back(); }) != "");
  CHECK(fault([&](Shape& s) { first(s, RelationKind::reflection).parts[0] = PartIndex(999); }) != "");
  CHECK(fault([&](Shape& s) { first(s, RelationKind::reflection).kind = RelationKind::point; }) != "");
  CHECK(fault([&](Shape& s) {
          std::get<Reflection>(first(s, RelationKind::reflection).detail).origin += Vec3(0.01, 0, 0.01);
        }) != "");
  CHECK(fault([&](Shape& s) { std::get<Reflection>(first(s, RelationKind::reflection).detail).corner_map[0] = 7; }) !=
        "");
  CHECK(fault([&](Shape& s) { std::get<Translation>(first(s, RelationKind::translation).detail).end *= 1.1; }) != "");
  CHECK(fault([&](Shape& s) { std::get<Translation>(first(s, RelationKind::translation).detail).direction = -1; }) !=
        "");
  CHECK(fault([&](Shape& s) { std::get<Attachment>(first(s, RelationKind::point).detail).points[0][0] += 0.1; }) != "");
  CHECK(fault([&](Shape& s) { std::get<Attachment>(first(s, RelationKind::point).detail).local_a.clear(); }) != "");
}

TEST_CASE("a shape survives JSON without loss") {
  for (const auto& parts : {fixture::slat_chair(5), fixture::fan(5), fixture::table()}) {
    const Shape shape = fixture::shape(parts);
    const nlohmann::json written = to_json(shape);
    const Result<Shape> read = shape_from_json(nlohmann::json::parse(written.dump()));
    REQUIRE_MESSAGE(read.ok(), (read.ok() ? "" : read.error().message()));
    CHECK(to_json(*read) == written);
    CHECK(read->parts.size() == shape.parts.size());
    for (const PartIndex p : shape.parts.indices()) {
      CHECK(read->parts[p].hexahedron.corners == shape.parts[p].hexahedron.corners);
      CHECK(read->parts[p].members == shape.parts[p].members);
      CHECK(read->parts[p].group == shape.parts[p].group);
    }
  }
}

TEST_CASE("JSON that is no shape is refused by name") {
  const nlohmann::json good = to_json(fixture::shape(fixture::slat_chair(4)));
  const auto refused = [&](const std::function<void(nlohmann::json&)>& change) {
    nlohmann::json bad = good;
    change(bad);
    const Result<Shape> read = shape_from_json(bad);
    return !read.ok() && !read.error().cause.empty();
  };
  CHECK_FALSE(refused([](nlohmann::json&) {}));
  CHECK(refused([](nlohmann::json& j) { j = 5; }));
  CHECK(refused([](nlohmann::json& j) { j["format"] = "parsel/program"; }));
  CHECK(refused([](nlohmann::json& j) { j["version"] = 2; }));
  CHECK(refused([](nlohmann::json& j) { j["parts"][0]["id"] = "seat\n# Task"; }));
  CHECK(refused([](nlohmann::json& j) { j["parts"][0]["name"] = "\u202eseat"; }));
  CHECK(refused([](nlohmann::json& j) { j["name"] = std::string(201, 'a'); }));
  CHECK(refused([](nlohmann::json& j) { j["version"] = 1e99; }));
  // Every member of every part and relation removed or of a wrong type; warnings and what follows from the rest aside.
  for (const char* list : {"parts", "relations"}) {
    for (std::size_t i = 0; i < good[list].size(); ++i) {
      for (const auto& item : good[list][i].items()) {
        const std::string& key = item.key();
        if (key == "count" || key == "delta" || key == "group" || key == "virtual") continue;
        CAPTURE(list);
        CAPTURE(i);
        CAPTURE(key);
        const bool is_optional = key == "patch";
        CHECK(refused([&](nlohmann::json& j) { j[list][i].erase(key); }) == !is_optional);
        CHECK(refused([&](nlohmann::json& j) { j[list][i][key] = nlohmann::json::object(); }));
      }
    }
  }
}
