// Mirror images: planes beside the middle, pairs of unequal company, rows and single parts, twins of like names.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "tests/core/real_models.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using fixture::box;
using fixture::count;
using fixture::Named;

namespace {

void move(fixture::Mesh& mesh, const Vec3& by) {
  for (Vec3& p : mesh.positions) p += by;
}

/// Parts that some symmetry ties to others: a row that breaks may go on as pairs.
std::size_t tied_parts(const Shape& shape) {
  std::set<PartIndex> tied;
  for (const Relation& relation : shape.relations) {
    if (relation.is_symmetry()) tied.insert(relation.parts.begin(), relation.parts.end());
  }
  return tied.size();
}

}  // namespace

TEST_CASE("legs are mirror images however far beside the middle of the top they stand") {
  for (double off = 0; off < 0.03; off += 0.0005) {
    CAPTURE(off);
    auto parts = fixture::table();
    for (std::size_t i = 1; i < parts.size(); ++i) move(parts[i].mesh, {off, 0, 0});
    CHECK(count(fixture::shape(parts), RelationKind::reflection) == 4);
    // Two legs on the middle's one side of the tolerance, two on its other.
    move(parts[1].mesh, {0.0002, 0, 0});
    move(parts[2].mesh, {0.0002, 0, 0});
    CHECK(count(fixture::shape(parts), RelationKind::reflection) == 4);
  }
}

TEST_CASE("a leg of another size does not cost the others their mirror images") {
  for (const double longer : {0.001, 0.01, 0.02, 0.05}) {
    CAPTURE(longer);
    auto parts = fixture::table();
    for (std::size_t i = 1; i < parts.size(); ++i) move(parts[i].mesh, {0.03, 0, 0});
    parts[4].mesh = box({parts[4].mesh.positions[0].x() + 0.03, 0.35, -0.35}, {0.06, 0.7 + longer, 0.06});
    const Shape shape = fixture::shape(parts);
    const auto relations = fixture::relations(shape);
    CHECK(std::count(relations.begin(), relations.end(), "reflection leg_front_left leg_front_right") == 1);
    CHECK(std::count(relations.begin(), relations.end(), "reflection leg_back_left leg_front_left") == 1);
  }
}

TEST_CASE("a row that stands opposite single parts keeps its mirror images") {
  std::vector<Named> parts = {{"base", box({0, 0, 0}, {1.2, 0.04, 1.2})}};
  for (int i = 0; i < 3; ++i) parts.push_back({"picket", box({0.5, 0.3, -0.4 + 0.4 * i}, {0.02, 0.56, 0.08})});
  SUBCASE("of which one is missing") {
    for (int i = 0; i < 2; ++i) parts.push_back({"picket", box({-0.5, 0.3, -0.4 + 0.4 * i}, {0.02, 0.56, 0.08})});
    const Shape shape = fixture::shape(parts);
    CHECK(count(shape, RelationKind::translation) == 1);
    // Left and right twice, and front and back of the two; those with the row's instances count when it is dissolved.
    CHECK(count(shape, RelationKind::reflection) == 3);
  }
  SUBCASE("that are only just uneven") {
    const double uneven[] = {0, 0.012, 0};
    for (int i = 0; i < 3; ++i) {
      parts.push_back({"picket", box({-0.5, 0.3, -0.4 + 0.4 * i + uneven[i]}, {0.02, 0.56, 0.08})});
    }
    const Shape shape = fixture::shape(parts);
    CHECK(count(shape, RelationKind::translation) == 2);
    CHECK(count(shape, RelationKind::reflection) == 4);
  }
}

TEST_CASE("twins whose names differ by a small word are told by shape and place") {
  const auto bed = [](double length) {
    return std::vector<Named>{{"top", box({0, 0.4, 0}, {0.9, 0.2, 2})},
                              {"sidebottom", box({0.46, 0.3, 0}, {0.02, 0.15, 1.9})},
                              {"sideboard", box({-0.46, 0.3, 0}, {0.02, 0.15, length})}};
  };
  CHECK(count(fixture::shape(bed(1.9)), RelationKind::reflection) == 1);
  CHECK(count(fixture::shape(bed(1.5)), RelationKind::reflection) == 0);
}

TEST_CASE("what lies one above the other is marked as stacked, and what stands side by side is not") {
  const std::vector<Named> parts = {{"toppanel", box({0, 1, 0}, {0.96, 0.02, 0.4})},
                                    {"botpanel", box({0, 0, 0}, {0.96, 0.02, 0.4})},
                                    {"leftwall", box({0.49, 0.5, 0}, {0.02, 1.02, 0.4})},
                                    {"rightwall", box({-0.49, 0.5, 0}, {0.02, 1.02, 0.4})}};
  const Shape shape = fixture::shape(parts);
  REQUIRE(count(shape, RelationKind::reflection) == 2);
  for (const Relation& relation : shape.relations) {
    if (relation.kind != RelationKind::reflection) continue;
    const bool panels = shape.parts[relation.parts[0]].label == "toppanel";
    CHECK(std::get<Reflection>(relation.detail).stacked == panels);
  }
}

TEST_CASE("rows are marked when their instances touch") {
  for (const double gap : {0.0, 0.1}) {
    std::vector<Named> parts = {{"wall", box({0, 0.5, 0.3}, {0.1, 1, 0.1})}};
    for (int i = 0; i < 4; ++i) parts.push_back({"drawer", box({0, 0.1 + (0.2 + gap) * i, 0}, {0.4, 0.2, 0.4})});
    const Shape shape = fixture::shape(parts);
    REQUIRE(count(shape, RelationKind::translation) == 1);
    for (const Relation& relation : shape.relations) {
      if (const auto* t = std::get_if<Translation>(&relation.detail)) CHECK(t->touching == (gap == 0));
    }
  }
}

TEST_CASE("with growing disorder fewer parts of a chair are tied by symmetry, without a hole") {
  constexpr int directions = 10, steps = 20;
  std::vector<double> mean(steps, 0);
  for (int direction = 0; direction < directions; ++direction) {
    for (int step = 0; step < steps; ++step) {
      Random random(static_cast<std::uint64_t>(direction));
      auto parts = fixture::slat_chair(5);
      const double jitter = 0.02 * step / (steps - 1) * 0.6;  // the chair's half diagonal is about 0.6
      for (Named& part : parts) {
        Vec3 by;
        for (int axis = 0; axis < 3; ++axis) by[axis] = random.uniform(-jitter, jitter);
        move(part.mesh, by);
      }
      mean[static_cast<std::size_t>(step)] += static_cast<double>(tied_parts(fixture::shape(parts))) / directions;
    }
  }
  CHECK(mean[0] == doctest::Approx(9));  // four legs and five slats
  for (std::size_t step = 1; step < mean.size(); ++step) {
    CAPTURE(step);
    CAPTURE(mean[step - 1]);
    CHECK(mean[step] <= mean[step - 1] + 0.3);
    CHECK(mean[step] >= mean[step - 1] - 3);
  }
}

TEST_CASE("legs named by letters or in German are one kind") {
  for (const auto& path : test::real_models("hunt")) {
    const std::string name = path.stem().string();
    if (name != "S09_letters" && name != "S09_german") continue;
    CAPTURE(name);
    CHECK(count(fixture::abstraction(test::read_bytes(path), name).shape, RelationKind::reflection) == 4);
  }
}
