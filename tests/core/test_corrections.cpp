// Joints and mirror images that a person declares.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/propagate/propagate.h"
#include "core/shape/corrections.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using fixture::attached;
using fixture::box;
using fixture::Named;
using nlohmann::json;

namespace {

Abstraction corrected(const std::vector<Named>& parts, const Corrections& corrections) {
  Result<Abstraction> result = abstract_shape(fixture::model(parts), "test", {}, {}, corrections);
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? "" : result.error().message()));
  const Status sound = validate(result->shape);
  CHECK_MESSAGE(sound.ok(), (sound.ok() ? "" : sound.error().message()));
  return std::move(*result);
}

std::string key(std::size_t node) {
  return "node:" + std::to_string(node) + "/0";
}

Correction correction(CorrectionKind kind, std::size_t a, std::size_t b) {
  return {kind, {key(a), key(b)}};
}

bool mirrors(const Shape& shape, const std::string& a, const std::string& b) {
  const auto lines = fixture::relations(shape);
  return std::find(lines.begin(), lines.end(), "reflection " + std::min(a, b) + " " + std::max(a, b)) != lines.end();
}

/// A shade that hangs over a foot without touching it.
std::vector<Named> lamp() {
  return {{"foot", box({0, 0.1, 0}, {0.4, 0.2, 0.4})}, {"shade", box({0, 0.9, 0}, {0.6, 0.4, 0.6})}};
}

}  // namespace

TEST_CASE("a declared joint across a gap ties two parts, and one taken apart is none") {
  CHECK(attached(fixture::shape(lamp()), "foot", "shade").empty());
  const Shape joined = corrected(lamp(), {correction(CorrectionKind::joined, 0, 1)}).shape;
  CHECK(attached(joined, "foot", "shade") == "face");
  const Shape apart =
      corrected(lamp(), {correction(CorrectionKind::joined, 0, 1), correction(CorrectionKind::apart, 0, 1)}).shape;
  CHECK(attached(apart, "foot", "shade").empty());
}

TEST_CASE("a declared joint carries an edit across") {
  const auto edit = edit_request_from_json(json::parse(
      R"({"seed": [{"op": "translate", "part": "foot", "feature": [0, 0, 0], "direction": [1, 0, 0], "amount": "x"}]})"));
  REQUIRE_MESSAGE(edit.ok(), (edit.ok() ? "" : edit.error().message()));
  const auto moved = [&](const Corrections& corrections) {
    const Shape shape = corrected(lamp(), corrections).shape;
    const auto found = propagate(shape, *edit);
    REQUIRE(found.ok());
    return found->program.layers[0].statements.size();
  };
  CHECK(moved({}) == 1);
  CHECK(moved({correction(CorrectionKind::joined, 0, 1)}) == 2);
}

TEST_CASE("what is declared of one leg holds for its mirror images") {
  const std::vector<Named> table = fixture::table();
  const Shape found = fixture::shape(table);
  REQUIRE(fixture::count(found, RelationKind::reflection) == 4);
  std::vector<std::string> legs;
  for (const Part& part : found.parts) {
    if (part.label == "leg") legs.push_back(part.id);
  }
  REQUIRE(legs.size() == 4);
  const auto top = std::find_if(found.parts.begin(), found.parts.end(), [](const Part& p) { return p.label != "leg"; });
  const std::size_t top_node = static_cast<std::size_t>(top->node);
  const std::size_t leg_node = static_cast<std::size_t>(found.parts[*found.find_part(legs[0])].node);
  for (const std::string& leg : legs) CHECK(!attached(found, leg, top->id).empty());

  const Shape apart = corrected(table, {correction(CorrectionKind::apart, top_node, leg_node)}).shape;
  for (const std::string& leg : legs) CHECK(attached(apart, leg, top->id).empty());

  const Shape loose = corrected(table, {correction(CorrectionKind::loose, leg_node, top_node)}).shape;
  for (const std::string& leg : legs) CHECK(attached(loose, leg, top->id) == "point");
}

TEST_CASE("mirror images that are none go with their own images, the others stay") {
  const std::vector<Named> table = fixture::table();
  const Shape found = fixture::shape(table);
  const Relation* across = nullptr;
  for (const Relation& relation : found.relations) {
    if (across == nullptr && relation.kind == RelationKind::reflection &&
        std::get<Reflection>(relation.detail).normal[0] != 0)
      across = &relation;
  }
  REQUIRE(across != nullptr);
  const auto node = [&](int k) { return static_cast<std::size_t>(found.parts[across->parts[std::size_t(k)]].node); };
  const Shape left = corrected(table, {correction(CorrectionKind::unmirrored, node(0), node(1))}).shape;
  CHECK(fixture::count(left, RelationKind::reflection) == 2);
  for (const Relation& relation : left.relations) {
    if (relation.kind == RelationKind::reflection) CHECK(std::get<Reflection>(relation.detail).normal[2] != 0);
  }
}

TEST_CASE("parts whose names say nothing are declared mirror images") {
  const std::vector<Named> pair = {{"seat", box({0, 0.5, 0}, {1, 0.1, 1})},
                                   {"rest", box({-0.5, 0.8, 0.1}, {0.1, 0.5, 0.6})},
                                   {"bolster", box({0.505, 0.8, 0.1}, {0.1, 0.51, 0.6})}};
  CHECK(!mirrors(fixture::shape(pair), "rest", "bolster"));
  const Abstraction declared = corrected(pair, {correction(CorrectionKind::mirrored, 2, 1)});
  CHECK(mirrors(declared.shape, "rest", "bolster"));
  CHECK(declared.shape.warnings.empty());
}

TEST_CASE("a mirror image that cannot be is left out and said") {
  const Abstraction declared =
      corrected(lamp(), {correction(CorrectionKind::mirrored, 0, 1), correction(CorrectionKind::joined, 0, 1)});
  REQUIRE(declared.shape.warnings.size() == 1);
  CHECK(declared.shape.warnings[0].place == "foot and shade");
  CHECK(declared.shape.warnings[0].text.find("they differ too much") == 0);
  CHECK(fixture::count(declared.shape, RelationKind::reflection) == 0);
  CHECK(attached(declared.shape, "foot", "shade") == "face");
}

TEST_CASE("a joint of one slat is that of its row, and of what stands for it") {
  const std::vector<Named> chair = fixture::slat_chair(5);
  const Shape found = fixture::shape(chair);
  const Relation* row = nullptr;
  for (const Relation& relation : found.relations) {
    if (relation.kind == RelationKind::translation) row = &relation;
  }
  REQUIRE(row != nullptr);
  const PartIndex slat = row->parts[2];
  std::vector<std::string> held;
  std::size_t other = 0;
  for (const Relation& relation : found.relations) {
    if (!relation.is_attachment() || std::count(relation.parts.begin(), relation.parts.end(), slat) == 0) continue;
    const PartIndex partner = relation.parts[0] == slat ? relation.parts[1] : relation.parts[0];
    if (found.parts[partner].is_virtual()) continue;
    held.push_back(found.parts[partner].id);
    other = static_cast<std::size_t>(found.parts[partner].node);
  }
  REQUIRE(!held.empty());
  const std::size_t own = static_cast<std::size_t>(found.parts[slat].node);
  const Shape apart = corrected(chair, {correction(CorrectionKind::apart, own, other)}).shape;
  for (const PartIndex p : row->parts) CHECK(attached(apart, found.parts[p].id, held.back()).empty());
  CHECK(attached(apart, found.parts[parent_of(*row)].id, held.back()).empty());
}

TEST_CASE("corrections that say nothing are refused by name") {
  const auto place = [](const char* text) {
    const auto read = corrections_from_file(json::parse(text));
    return read.ok() ? std::string("none") : read.error().place;
  };
  CHECK(place(R"({"format": "parsel/corrections", "version": 1, "corrections": []})") == "none");
  CHECK(place(R"({"corrections": [{"kind": "apart", "parts": ["node:1/0", "node:2"]}]})") == "none");
  CHECK(place(R"({"corrections": [{"kind": "glued", "parts": ["node:1/0", "node:2"]}]})") == "/corrections/0/kind");
  CHECK(place(R"({"corrections": [{"kind": "apart", "parts": ["node:1/0"]}]})") == "/corrections/0/parts");
  CHECK(place(R"({"corrections": [{"kind": "apart", "parts": [1, 2], "x": 1}]})") == "/corrections/0/x");
  CHECK(place(R"({"corrections": 3})") == "/corrections");
  CHECK(place(R"({"version": 2, "corrections": []})") == "/version");
  CHECK(place(R"([])") == "");
  for (const auto& [a, b] : {std::pair("node:7/0", "node:1/0"), std::pair("node:1/0", "node:1")}) {
    const auto refused = abstract_shape(fixture::model(lamp()), "test", {}, {}, {{CorrectionKind::apart, {a, b}}});
    REQUIRE(!refused.ok());
    CHECK(refused.error().stage == "shape/corrections");
  }
}
