#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/shape/attachment.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using fixture::attached;
using fixture::box;
using fixture::Named;

namespace {

const Relation& attachment(const Shape& shape, const std::string& a, const std::string& b) {
  for (const Relation& r : shape.relations) {
    if (r.is_attachment() && shape.parts[r.parts[0]].id == a && shape.parts[r.parts[1]].id == b) return r;
  }
  FAIL("no attachment of " << a << " and " << b);
  return *shape.relations.begin();
}

}  // namespace

TEST_CASE("a leg is attached to a top at a point, a back to a seat along a line, a stand to a plate over a face") {
  const Shape table = fixture::shape(fixture::table());
  CHECK(attached(table, "leg_front_left", "top") == "point");
  CHECK(fixture::count(table, RelationKind::point) == 4);
  CHECK(fixture::count(table, RelationKind::reflection) == 4);
  CHECK(fixture::count(table, RelationKind::ground) == 4);
  CHECK(table.relations.size() == 12);

  const Shape chair = fixture::shape(
      {{"seat", box({0, 0.45, 0}, {0.5, 0.04, 0.5})}, {"back", box({0, 0.72, -0.23}, {0.5, 0.5, 0.04})}});
  CHECK(attached(chair, "seat", "back") == "line");

  const Shape lamp =
      fixture::shape({{"plate", box({0, 0.01, 0}, {0.3, 0.02, 0.3})}, {"stand", box({0, 0.42, 0}, {0.04, 0.8, 0.04})}});
  CHECK(attached(lamp, "plate", "stand") == "face");

  const Shape drawer =
      fixture::shape({{"case", box({0, 0, 0}, {1, 1, 1})}, {"drawer", box({0.2, 0.1, 0.3}, {0.4, 0.2, 0.3})}});
  CHECK(attached(drawer, "case", "drawer") == "volume");
}

TEST_CASE("points lie at the ends of the region, exactly on the parts' own faces and planes") {
  // The leg ends 3 mm short of the top: close enough to stand under it.
  auto parts = fixture::table();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    for (Vec3& p : parts[i].mesh.positions) p.y() = p.y() > 0.3 ? 0.697 : 0.0;
  }
  const Shape table = fixture::shape(parts);
  const Attachment& leg = std::get<Attachment>(attachment(table, "top", "leg_front_left").detail);
  REQUIRE(leg.points.size() == 1);
  CHECK(leg.local_a[0][1] == -1);
  CHECK(leg.local_b[0] == Vec3(0, 1, 0));

  const Shape chair = fixture::shape(
      {{"seat", box({0, 0.45, 0}, {0.5, 0.04, 0.5})}, {"back", box({0, 0.72, -0.23}, {0.496, 0.5, 0.04})}});
  const Attachment& line = std::get<Attachment>(attachment(chair, "seat", "back").detail);
  REQUIRE(line.points.size() == 2);
  CHECK(line.local_a[0][0] == -1);
  CHECK(line.local_a[1][0] == 1);
  CHECK(line.local_b[0][0] == -1);
  CHECK(line.local_b[1] == Vec3(1, -1, 0));
}

TEST_CASE("parts that run into each other are tied where the longer one ends") {
  const auto tie = [](double thickness) {
    const Shape shape = fixture::shape({{"leg", box({0.3, 0.36, 0}, {0.05, 0.72, 0.05})},
                                        {"top", box({0, 0.7 + thickness / 2, 0}, {1, thickness, 0.6})}});
    return std::get<Attachment>(attachment(shape, "leg", "top").detail);
  };
  // The leg ends in the middle of the top, however long it gets it reaches no deeper.
  CHECK(tie(0.04).local_a[0].y() == 1);
  CHECK(tie(0.04).local_b[0].y() == doctest::Approx(0));
  // Of two of about the same length neither is: the middle of what they share.
  CHECK(tie(0.7).local_a[0].y() == doctest::Approx(1 - 0.02 / 0.72));
  // A block on a short peg: the block's face.
  CHECK(tie(2).local_b[0].y() == -1);
  // A leg that runs through its top is tied in the middle of the top.
  const Shape through =
      fixture::shape({{"leg", box({0.3, 0.4, 0}, {0.05, 0.8, 0.05})}, {"top", box({0, 0.7, 0}, {1, 0.06, 0.6})}});
  CHECK(std::get<Attachment>(attachment(through, "leg", "top").detail).local_b[0].y() == doctest::Approx(0));
}

TEST_CASE("what covers half of both boxes is tied at its ends, however lopsided it is") {
  // The bath stands out of its panelling to one side, by a fifth of its length, and leans.
  const auto inset = [](double length, double angle) {
    const auto bath = fixture::turned(box({0.15, 0.1, 0}, {length, 0.5, 0.4}), {0.15, 0.1, 0}, Vec3::UnitZ(), angle);
    return fixture::shape({{"panelling", box({0, 0, 0}, {1, 0.5, 0.5})}, {"bath", bath}});
  };
  CHECK(attached(inset(1, 0), "panelling", "bath") == "volume");
  CHECK(attached(inset(1, 0.3), "panelling", "bath") == "volume");
  const Shape covered = inset(1, 0);
  const Attachment& ends = std::get<Attachment>(attachment(covered, "panelling", "bath").detail);
  double low = 1, high = -1;
  for (const Vec3& local : ends.local_a) {
    low = std::min(low, local.x());
    high = std::max(high, local.x());
  }
  CHECK(low == doctest::Approx(-0.7));
  CHECK(high == 1);
  // A third of the panelling is not half of it: along its length the bath is tied at its middle alone.
  CHECK(attached(inset(0.3, 0), "panelling", "bath") == "face");
}

TEST_CASE("parts that touch at an edge are attached, parts that are apart are not") {
  const Shape edge = fixture::shape({{"a", box({0, 0, 0}, {1, 1, 1})}, {"b", box({1, 1, 0}, {1, 1, 1})}});
  CHECK(attached(edge, "a", "b") == "line");
  const Shape apart = fixture::shape({{"a", box({0, 0, 0}, {1, 1, 1})}, {"b", box({1.2, 0, 0}, {1, 1, 1})}});
  CHECK(attached(apart, "a", "b") == "");
}

TEST_CASE("legs that end short of the top are attached all the same when nothing else carries it") {
  auto parts = fixture::table();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    for (Vec3& p : parts[i].mesh.positions) p.y() = p.y() > 0.3 ? 0.688 : 0.0;  // 12 mm, 0.015 of the half-diagonal
  }
  CHECK(fixture::count(fixture::shape(parts), RelationKind::point) == 4);
}

TEST_CASE("crossed boards are not one block: only the plane that both share counts") {
  const auto board = [](double angle) {
    return fixture::turned(box({0, 0.5, 0}, {0.06, 1.2, 0.03}), {0, 0.5, 0}, Vec3::UnitZ(), angle);
  };
  const Shape shape = fixture::shape({{"leg one", board(0.6)}, {"leg two", board(-0.6)}});
  CHECK(attached(shape, "leg_one", "leg_two") == "line");
}

TEST_CASE("a group inherits the attachments of its instances, and which count depends on whether it stands") {
  const Shape chair = fixture::shape(fixture::slat_chair(5));
  CHECK(attached(chair, "slat_group", "seat") == "line");
  CHECK(attached(chair, "slat_group", "top_rail") != "");
  CHECK(attached(chair, "slat_left", "seat") != "");
  CHECK(attached(chair, "slat_group", "slat_left") == "");
  const auto group = chair.parts[*chair.find_part("slat_group")].group;
  REQUIRE(group);
  for (const bool dissolve : {false, true}) {
    const std::vector<RelationIndex> dissolved =
        dissolve ? std::vector<RelationIndex>{*group} : std::vector<RelationIndex>{};
    CHECK(is_active(chair, *chair.find_part("slat_group"), dissolved) != dissolve);
    CHECK(is_active(chair, *chair.find_part("slat_center"), dissolved) == dissolve);
    CHECK(is_active(chair, *group, dissolved) != dissolve);
    CHECK(active_parts(chair, dissolved).size() == (dissolve ? 11 : 7));
    for (const RelationIndex r : active_relations(chair, dissolved)) {
      if (chair.relations[r].is_group()) continue;
      for (const PartIndex p : chair.relations[r].parts) CHECK(is_active(chair, p, dissolved));
    }
  }
}
