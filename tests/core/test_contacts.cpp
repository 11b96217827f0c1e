// Contacts: bounded in heaps, alike for twins, none through a part, and the patch that a joint keeps.
#include "core/shape/contacts.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/core/shape_fixture.h"

using namespace parsel;
using fixture::attached;
using fixture::box;
using fixture::Named;

namespace {

std::size_t joints(const Shape& shape) {
  std::size_t count = 0;
  for (const Relation& r : shape.relations) count += r.is_attachment() ? 1 : 0;
  return count;
}

/// Parts that can be reached from the first along joints.
std::size_t reached(const Shape& shape) {
  std::set<PartIndex> seen = {PartIndex(0)};
  for (std::size_t before = 0; before < seen.size();) {
    before = seen.size();
    for (const Relation& r : shape.relations) {
      if (r.is_attachment() && (seen.count(r.parts[0]) > 0 || seen.count(r.parts[1]) > 0)) {
        seen.insert(r.parts.begin(), r.parts.end());
      }
    }
  }
  return seen.size();
}

const Attachment& joint(const Shape& shape, const std::string& a, const std::string& b) {
  const auto pa = shape.find_part(a), pb = shape.find_part(b);
  for (const Relation& r : shape.relations) {
    if (r.is_attachment() && r.parts == std::vector<PartIndex>{*pa, *pb}) return std::get<Attachment>(r.detail);
  }
  FAIL("no joint of " << a << " and " << b);
  return std::get<Attachment>(shape.relations[RelationIndex(0)].detail);
}

}  // namespace

TEST_CASE("of a heap of equal parts as many joints are kept as hold it together, not one a pair") {
  std::vector<Named> heap(400, Named{"box", box({0, 0, 0}, {1, 1, 1})});
  const Shape shape = fixture::shape(heap);
  CHECK(joints(shape) >= heap.size() - 1);
  CHECK(joints(shape) <= 5 * heap.size());
  CHECK(reached(shape) == heap.size());
}

TEST_CASE("of a heap of different parts the joints grow with the parts, not with the pairs") {
  std::vector<Named> heap;
  for (int i = 0; i < 300; ++i) {
    const std::string name = {'n', static_cast<char>('a' + i % 26), static_cast<char>('a' + i / 26), 'x'};
    heap.push_back({name, box({0.3 * std::sin(i), 0.3 * std::sin(2.1 * i), 0.3 * std::sin(3.7 * i)}, {1, 1, 1})});
  }
  const Shape shape = fixture::shape(heap);
  CHECK(reached(shape) == shape.parts.size());
  CHECK(joints(shape) <= 80 * heap.size());  // of 45,000 pairs
}

TEST_CASE("a floor with a thousand things on it is joined to each of them") {
  std::vector<Named> parts = {{"floor", box({0, -0.05, 0}, {40, 0.1, 40})}};
  for (int i = 0; i < 1000; ++i) {
    // Places in no row, so that no group stands for them.
    const double x = i % 32 - 16 + 0.3 * std::sin(7.0 * i), z = std::floor(i / 32.0) - 16 + 0.3 * std::sin(5.0 * i);
    parts.push_back({"thing", box({x, 0.2, z}, {0.3, 0.4, 0.3})});
  }
  const Shape shape = fixture::shape(parts);
  std::set<PartIndex> joined;
  for (const Relation& r : shape.relations) {
    if (r.is_attachment() && r.parts[0] == PartIndex(0) && !shape.parts[r.parts[1]].is_virtual())
      joined.insert(r.parts[1]);
  }
  CHECK(joined.size() == 1000);
}

TEST_CASE("a reduced region reaches as far along its axes and has the same mean") {
  ContactRegion region;
  for (int i = 0; i < 500; ++i) region.add(Vec3(std::sin(i), std::cos(2 * i), std::sin(3 * i + 1)));
  ContactRegion reduced = region;
  reduced.reduce({Mat3::Identity()});
  CHECK(reduced.vertices.size() <= 6);
  CHECK((reduced.mean() - region.mean()).norm() < 1e-12);
  for (int axis = 0; axis < 3; ++axis) {
    const auto ends = [&](const ContactRegion& r) {
      std::pair<double, double> out{1e9, -1e9};
      for (const Vec3& v : r.vertices) out = {std::min(out.first, v[axis]), std::max(out.second, v[axis])};
      return out;
    };
    CHECK(ends(reduced) == ends(region));
  }
}

TEST_CASE("a joint keeps the rectangle in which its parts touch") {
  const Shape shape = fixture::shape(fixture::table());
  const Attachment& leg = joint(shape, "top", "leg_front_left");
  REQUIRE(leg.patch.has_value());
  CHECK(std::abs(leg.patch->normal.y() + 1) < 1e-9);  // out of the top, into the leg
  for (const Vec3& corner : leg.patch->local_b) CHECK(corner.cwiseAbs() == Vec3::Ones());
  for (const Vec3& corner : leg.patch->local_a) CHECK(corner.y() == -1);
  const Vec3 leg_half = shape.parts[*shape.find_part("leg_front_left")].hexahedron.half_extents();
  for (const Vec3& side : leg.patch->half_sides) CHECK(side.norm() == doctest::Approx(leg_half.x()).epsilon(1e-3));
}

TEST_CASE("what is inside another part has no patch; a sheet that lies on a face is not inside") {
  const Shape inside =
      fixture::shape({{"shade", box({0, 0, 0}, {1, 1, 1})}, {"bulb", box({0, 0, 0}, {0.2, 0.2, 0.2})}});
  CHECK(attached(inside, "shade", "bulb") == "volume");
  CHECK_FALSE(joint(inside, "shade", "bulb").patch.has_value());
  const Shape sheet =
      fixture::shape({{"board", box({0, 0, 0}, {1, 0.1, 1})}, {"sheet", box({0, 0.054, 0}, {0.4, 0.008, 0.4})}});
  CHECK(attached(sheet, "board", "sheet") == "face");
}

TEST_CASE("a foot that ends a little short is joined as its mirror image is, at the same ends") {
  std::vector<Named> parts = fixture::table();
  for (Vec3& p : parts[1].mesh.positions) p.y() -= p.y() > 0.5 ? 0.012 : 0;  // 0.016 of the half-diagonal
  // Held by bars, so that a second look for what hangs on nothing does not see it.
  parts.push_back({"bar", box({0, 0.2, 0.35}, {1.08, 0.04, 0.04})});
  parts.push_back({"side bar", box({0.55, 0.2, 0}, {0.04, 0.04, 0.68})});
  const Shape shape = fixture::shape(parts);
  for (const char* leg : {"leg_front_left", "leg_front_right", "leg_back_left", "leg_back_right"}) {
    CHECK(attached(shape, "top", leg) == "point");
    CHECK(std::abs(joint(shape, "top", leg).local_b[0].y() - 1) < 0.06);
  }
}

TEST_CASE("a leg is joined to the board of a seat, not also to the cushion on it") {
  std::vector<Named> parts = {{"board", box({0, 0.4, 0}, {0.5, 0.006, 0.5})},
                              {"cushion", box({0, 0.443, 0}, {0.5, 0.08, 0.5})},
                              {"leg", box({0.2, 0.1985, 0.2}, {0.05, 0.397, 0.05})}};
  const Shape shape = fixture::shape(parts);
  CHECK(attached(shape, "board", "leg") != "");
  CHECK(attached(shape, "board", "cushion") != "");
  CHECK(attached(shape, "cushion", "leg") == "");
}
