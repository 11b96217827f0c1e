#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "core/base/random.h"
#include "core/shape/words.h"
#include "tests/core/real_models.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using fixture::box;
using fixture::Named;

namespace {

std::vector<Named> moved(std::vector<Named> parts, double scale, const Vec3& offset) {
  for (Named& part : parts) {
    for (Vec3& p : part.mesh.positions) p = scale * p + offset;
  }
  return parts;
}

/// Triangles in another order, each starting at another corner, and vertices renumbered.
std::vector<Named> shuffled(std::vector<Named> parts) {
  Random random(11);
  for (Named& part : parts) {
    auto& triangles = part.mesh.triangles;
    for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[random.below(i)]);
    std::vector<std::uint32_t> to(part.mesh.positions.size());
    for (std::size_t i = 0; i < to.size(); ++i) to[i] = static_cast<std::uint32_t>(i);
    for (std::size_t i = to.size(); i > 1; --i) std::swap(to[i - 1], to[random.below(i)]);
    auto positions = part.mesh.positions;
    for (std::size_t i = 0; i < to.size(); ++i) positions[to[i]] = part.mesh.positions[i];
    part.mesh.positions = positions;
    for (auto& t : triangles) {
      t = {to[t[1]], to[t[2]], to[t[0]]};
    }
  }
  return parts;
}

std::size_t components(const Shape& shape) {
  const std::vector<PartIndex> parts = active_parts(shape);
  std::map<PartIndex, std::size_t> of;
  for (std::size_t i = 0; i < parts.size(); ++i) of[parts[i]] = i;
  for (const RelationIndex r : active_relations(shape)) {
    const Relation& relation = shape.relations[r];
    if (!relation.is_attachment()) continue;
    const std::size_t from = of[relation.parts[0]], to = of[relation.parts[1]];
    for (auto& [part, component] : of) {
      if (component == from) component = to;
    }
  }
  std::set<std::size_t> left;
  for (const auto& [part, component] : of) left.insert(component);
  return left.size();
}

}  // namespace

TEST_CASE("the same model moved, scaled by a thousand or with shuffled triangles gives the same ids and relations") {
  for (const auto& parts : {fixture::table(), fixture::slat_chair(5), fixture::fan(5), fixture::fan(3, 0.7)}) {
    const std::vector<std::string> expected = fixture::relations(fixture::shape(parts));
    CHECK(fixture::relations(fixture::shape(moved(parts, 1, {5, -3, 8}))) == expected);
    CHECK(fixture::relations(fixture::shape(moved(parts, 1000, {0, 0, 0}))) == expected);
    CHECK(fixture::relations(fixture::shape(shuffled(parts))) == expected);
  }
}

TEST_CASE("the same bytes give the same shape") {
  const std::string bytes = fixture::model(fixture::slat_chair(6));
  CHECK(to_json(fixture::abstraction(bytes).shape) == to_json(fixture::abstraction(bytes).shape));
}

TEST_CASE("labels that a person gives take the place of the file's, and symmetry follows them") {
  const auto leg = [](double x) { return box({x, 0, 0}, {0.1, 1, 0.1}); };
  const std::string bytes =
      fixture::model({{"top", box({0, 0.55, 0}, {1.4, 0.1, 0.4})}, {"leg", leg(-0.5)}, {"mesh.017", leg(0.5)}});
  const Shape before = fixture::abstraction(bytes).shape;
  CHECK(fixture::count(before, RelationKind::reflection) == 0);

  const auto labelled = [&](const Labels& labels) { return abstract_shape(bytes, "test", {}, labels); };
  const auto given = labelled({{"node:2", "leg.004"}});
  REQUIRE(given.ok());
  CHECK(validate(given->shape).ok());
  CHECK(fixture::count(given->shape, RelationKind::reflection) == 1);
  CHECK(given->shape.find_part("leg_left"));
  CHECK(given->shape.find_part("leg_right"));
  CHECK(given->shape.sha256 == before.sha256);
  CHECK(to_json(labelled({{"node:2/0", "leg"}, {"node:2", "arm"}})->shape) == to_json(given->shape));

  const auto refused = labelled({{"node:7", "leg"}});
  REQUIRE(!refused.ok());
  CHECK(refused.error().place == "node:7");
}

TEST_CASE("degenerate parts take part: panels, wires, parts inside others, duplicates, a single part") {
  const auto one = fixture::shape({{"block", box({0, 0, 0}, {1, 1, 1})}});
  CHECK(one.parts.size() == 1);
  CHECK(fixture::relations(one) == std::vector<std::string>{"ground block"});

  fixture::Mesh wire;
  wire.positions = {{-1, 0.5, 0}, {1, 0.5, 0}, {0, 0.5, 0}};
  wire.triangles = {{0, 1, 2}};
  const auto odd = fixture::shape({{"block", box({0, 0, 0}, {1, 1, 1})},
                                   {"panel", box({0, 0.5, 0}, {1, 0, 1})},
                                   {"wire", wire},
                                   {"inner", box({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2})},
                                   {"inner", box({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2})}});
  CHECK(odd.parts.size() == 5);
  CHECK(fixture::attached(odd, "block", "inner_1") == "volume");
  CHECK(fixture::attached(odd, "inner_1", "inner_2") == "volume");
  CHECK(fixture::attached(odd, "block", "panel") != "");
  CHECK(fixture::count(odd, RelationKind::reflection) == 0);
  CHECK(components(odd) == 1);
}

TEST_CASE("boxes of parts tied by symmetry are exact images even when the meshes are sloppy") {
  Random random(5);
  auto parts = fixture::slat_chair(5);
  for (Named& part : parts) {
    const Vec3 error(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    for (Vec3& p : part.mesh.positions) p += 0.001 * error;
  }
  const Shape shape = fixture::shape(parts);  // validate() holds the relations to 1e-6
  CHECK(fixture::count(shape, RelationKind::translation) == 1);
  CHECK(fixture::count(shape, RelationKind::reflection) == 4);
}

TEST_CASE("real furniture: no failure, every part in the graph, one piece") {
  const auto files = test::real_models("furniture");
  if (files.empty()) return;
  CHECK(files.size() == 20);
  double parts = 0, attachments = 0;
  for (const auto& path : files) {
    CAPTURE(path.filename().string());
    const Abstraction result = fixture::abstraction(test::read_bytes(path), path.stem().string());
    const Shape& shape = result.shape;
    CHECK(shape.warnings.empty());
    CHECK(components(shape) == 1);
    CHECK(describe(shape).size() < 8000);
    std::set<PartIndex> seen;
    for (const Relation& r : shape.relations) seen.insert(r.parts.begin(), r.parts.end());
    for (const PartIndex p : shape.parts.indices()) CHECK_MESSAGE(seen.count(p) == 1, shape.parts[p].id);
    const Result<Shape> again = shape_from_json(to_json(shape));
    CHECK(again.ok());
    parts += static_cast<double>(active_parts(shape).size());
    for (const RelationIndex r : active_relations(shape)) attachments += shape.relations[r].is_attachment() ? 1 : 0;
  }
  MESSAGE("attachments a part: " << attachments / parts);
  CHECK(attachments / parts > 1.2);
  CHECK(attachments / parts < 2.5);
}
