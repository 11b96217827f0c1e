// Contact points: where surfaces lie against each other, or are flush, although the boxes around them run into each
// other, and what is seen of them when a part moves.
#include "core/shape/contact_points.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/propagate/propagate.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using fixture::box;
using fixture::Mesh;
using fixture::Named;

namespace {

Mesh joined(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const auto& [a, b, c] : mesh.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

/// A frame with two arms in one mesh, and a cushion that lies on it between them.
std::vector<Named> sofa() {
  const Mesh frame = joined(
      {box({0, 0.2, 0}, {2, 0.4, 0.8}), box({-0.9, 0.6, 0}, {0.2, 0.4, 0.8}), box({0.9, 0.6, 0}, {0.2, 0.4, 0.8})});
  return {{"frame", frame}, {"cushion", box({0, 0.5, 0}, {1.6, 0.2, 0.8})}};
}

const Relation& joint(const Shape& shape) {
  for (const Relation& r : shape.relations) {
    if (r.is_attachment()) return r;
  }
  FAIL("no joint");
  return shape.relations[RelationIndex(0)];
}

struct Seen {
  explicit Seen(const std::vector<Named>& parts) : shape(fixture::shape(parts)) {
    const Relation& r = joint(shape);
    a = r.parts[0];
    b = r.parts[1];
    points = std::get<Attachment>(r.detail).contact_points;
  }
  const Corners& rest(PartIndex part) const { return shape.parts[part].hexahedron.corners; }
  SurfaceContact contact() const { return {points, shape.parts[a].hexahedron, shape.parts[b].hexahedron}; }
  /// The second part of the joint moves by a step.
  ContactShift moved_by(const Vec3& step) const {
    return contact().shift(rest(a), rest(b).rowwise() + step.transpose());
  }
  Shape shape;
  PartIndex a, b;
  std::vector<ContactPoint> points;
};

}  // namespace

TEST_CASE("contact points: a cushion in its sofa touches the seat and both arms") {
  const Seen seen(sofa());
  REQUIRE(!seen.points.empty());
  CHECK(seen.points.size() <= 16);
  bool below = false, beside = false;
  for (const ContactPoint& point : seen.points) {
    below = below || point.normal.y() > 0.99;
    beside = beside || std::abs(point.normal.x()) > 0.99;
    CHECK(point.normal.norm() == doctest::Approx(1));
  }
  CHECK(below);
  CHECK(beside);
  CHECK(seen.contact().lie_against());
}

TEST_CASE("contact points: what lifts a part off is seen, sliding along the surfaces is not until it has come off") {
  const Seen seen(sofa());
  CHECK(seen.moved_by({0, 0, 0}).apart == doctest::Approx(0));
  CHECK(seen.moved_by({0, 0.1, 0}).apart == doctest::Approx(0.1));
  CHECK(seen.moved_by({0, -0.1, 0}).apart == doctest::Approx(0.1));
  const ContactShift pulled = seen.moved_by({0, 0, 0.05});
  CHECK(pulled.apart == doctest::Approx(0).epsilon(1e-9));
  CHECK(pulled.lost < 0.75);
  CHECK(seen.moved_by({0, 0, 5}).lost == doctest::Approx(1));
}

TEST_CASE("contact points: a step between faces that were flush is told from a gap") {
  const Seen seen({{"post", box({0, 0.5, 0}, {0.2, 1, 0.2})}, {"rail", box({0.45, 0.5, 0}, {0.8, 0.2, 0.2})}});
  REQUIRE(!seen.points.empty());
  const ContactShift forward = seen.moved_by({0, 0, 0.03});
  CHECK(forward.stepped == doctest::Approx(0.03));
  CHECK(forward.apart == doctest::Approx(0).epsilon(1e-9));
  CHECK(seen.moved_by({0, 0.03, 0}).stepped == doctest::Approx(0).epsilon(1e-9));
}

TEST_CASE("contact points: parts that are stretched and turned together are not apart") {
  const Seen seen(sofa());
  Mat3 map = Mat3::Identity();
  map << 1.7, 0, 0.3, 0, 0.6, 0, -0.3, 0, 1.1;
  const ContactShift shift = seen.contact().shift(seen.rest(seen.a) * map, seen.rest(seen.b) * map);
  CHECK(shift.apart == doctest::Approx(0).epsilon(1e-9));
  CHECK(shift.stepped == doctest::Approx(0).epsilon(1e-9));
  CHECK(shift.lost == doctest::Approx(0));
}

TEST_CASE("contact points: boxes that meet in a face tell themselves") {
  const Shape shape =
      fixture::shape({{"top", box({0, 1, 0}, {1, 0.1, 1})}, {"leg", box({0, 0.475, 0}, {0.1, 0.95, 0.1})}});
  CHECK(std::get<Attachment>(joint(shape).detail).contact_points.empty());
}

TEST_CASE("contact points are read back from a shape's JSON, and a normal that is none is refused") {
  const Seen seen(sofa());
  const Result<Shape> read = shape_from_json(to_json(seen.shape));
  REQUIRE(read.ok());
  const auto& again = std::get<Attachment>(joint(*read).detail).contact_points;
  REQUIRE(again.size() == seen.points.size());
  for (std::size_t i = 0; i < again.size(); ++i) {
    CHECK((again[i].point - seen.points[i].point).norm() < 1e-9);
    CHECK((again[i].normal - seen.points[i].normal).norm() < 1e-9);
  }
  Shape wrong = seen.shape;
  for (Relation& relation : wrong.relations) {
    if (auto* attachment = std::get_if<Attachment>(&relation.detail)) attachment->contact_points[0].normal *= 2;
  }
  CHECK(!validate(wrong).ok());
}

TEST_CASE("contact points: a sofa's frame that gets taller takes its cushion along on its seat") {
  const Shape shape = fixture::shape(sofa());
  const nlohmann::json seed = {{"op", "scale_1d"},
                               {"part", "frame"},
                               {"origin", {{"part", "frame"}, {"at", {0, -1, 0}}}},
                               {"direction", {0, 1, 0}},
                               {"amount", "x"}};
  const Result<EditRequest> request = edit_request_from_json({{"seed", {seed}}});
  REQUIRE(request.ok());
  const Result<Propagation> found = propagate(shape, *request);
  REQUIRE(found.ok());
  const State state = Evaluator(found->program, shape)({0.3});
  const PartIndex cushion = *shape.find_part("cushion"), frame = *shape.find_part("frame");
  const Corners& rest = shape.parts[frame].hexahedron.corners;
  const double floor = rest.col(1).minCoeff();
  const double seat = shape.parts[cushion].hexahedron.corners.col(1).minCoeff();
  CHECK(state.parts[cushion].col(1).minCoeff() == doctest::Approx(floor + 1.3 * (seat - floor)).epsilon(0.005));
}
