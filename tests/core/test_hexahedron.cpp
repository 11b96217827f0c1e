#include <doctest/doctest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/shape/hexahedron.h"
#include "core/shape/hexahedron_extent.h"
#include "core/shape/oriented_box.h"
#include "tests/core/glb_fixture.h"

using namespace parsel;

namespace {

PartMesh part(const fixture::Mesh& mesh) {
  PartMesh out;
  out.positions = mesh.positions;
  for (const auto& t : mesh.triangles) out.triangles.push_back({t[0], t[1], t[2]});
  return out;
}

/// How far the box's axes are from a set of directions, without regard to order and sign.
double axis_error(const Hexahedron& box, const Mat3& expected) {
  double worst = 0;
  for (int i = 0; i < 3; ++i) {
    const double best = (box.axes * expected.row(i).transpose()).cwiseAbs().maxCoeff();
    worst = std::max(worst, 1 - best);
  }
  return worst;
}

}  // namespace

TEST_CASE("local coordinates and points invert each other, corners have the signs of their number") {
  const Mat3 axes = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Hexahedron box = make_box({0.1, -0.2, 0.3}, axes, {0.5, 0.25, 0.1});
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec3 local(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
    CHECK((box.local(box.point(local)) - local).norm() < 1e-12);
    CHECK(trilinear_weights(local).sum() == doctest::Approx(1));
  }
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner = box.point(Vec3(corner_sign(k, 0), corner_sign(k, 1), corner_sign(k, 2)));
    CHECK((corner - box.corners.row(k).transpose()).norm() < 1e-14);
  }
  CHECK((box.half_extents() - Vec3(0.5, 0.25, 0.1)).norm() < 1e-14);
}

TEST_CASE("relative Jacobians are 1 at rest, scale with the volume and turn negative when a cage is inverted") {
  const Hexahedron box = make_box(Vec3::Zero(), Mat3::Identity(), {1, 1, 1});
  CHECK((relative_jacobians(box.corners, box.corners).array() - 1).abs().maxCoeff() < 1e-14);
  CHECK((relative_jacobians(box.corners * 2, box.corners).array() - 8).abs().maxCoeff() < 1e-12);
  Corners pushed = box.corners;
  for (int k = 0; k < 8; ++k) {
    if (corner_sign(k, 0) > 0) pushed(k, 0) = -1.5;  // the right side through the left one
  }
  CHECK(relative_jacobians(pushed, box.corners).maxCoeff() < 0);
}

TEST_CASE("a box keeps the global axes when it is about as tight there, else it follows the part") {
  CHECK(oriented_box(part(fixture::box({1, 2, 3}, {2, 1, 0.5}))).axes.isApprox(Mat3::Identity(), 1e-12));
  // A chunky block a little askew stays upright; a splayed leg does not.
  const auto block = fixture::turned(fixture::box({0, 0, 0}, {1, 1, 1}), Vec3::Zero(), Vec3::UnitY(), 0.03);
  CHECK(oriented_box(part(block)).axes.isApprox(Mat3::Identity(), 1e-12));
  const Mat3 tilt = Eigen::AngleAxisd(0.1, Vec3::UnitZ()).toRotationMatrix();
  const auto leg = fixture::turned(fixture::box({0, 0, 0}, {0.05, 0.7, 0.05}), Vec3::Zero(), Vec3::UnitZ(), 0.1);
  const Hexahedron box = oriented_box(part(leg));
  CHECK(axis_error(box, tilt.transpose()) < 1e-6);
  CHECK(box.half_extents()[1] == doctest::Approx(0.35));
}

TEST_CASE("a freely turned plank is boxed tightly, its axes near the global ones and right-handed") {
  Random random(7);
  for (int i = 0; i < 40; ++i) {
    const Vec3 axis = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const double angle = random.uniform(-3, 3);
    const auto mesh = fixture::turned(fixture::box({0.2, 0, 0}, {0.9, 0.05, 0.2}), Vec3::Zero(), axis, angle);
    const Hexahedron box = oriented_box(part(mesh));
    CHECK(box.half_extents().prod() <= 0.9 * 0.05 * 0.2 / 8 * (axis_snap_ratio + 1e-6));
    CHECK(box.axes.determinant() == doctest::Approx(1));
    for (const Vec3& p : mesh.positions) CHECK(box.local(p).cwiseAbs().maxCoeff() < 1 + 1e-9);
  }
}

TEST_CASE("flat panels and wires get a volume") {
  fixture::Mesh panel = fixture::box({0, 0, 0}, {1, 0, 1});
  CHECK(oriented_box(part(panel)).half_extents()[1] == doctest::Approx(min_half_extent));
  fixture::Mesh wire;
  wire.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}};
  wire.triangles = {{0, 1, 2}};
  const Vec3 half = oriented_box(part(wire)).half_extents();
  CHECK(half.minCoeff() == doctest::Approx(min_half_extent));
  CHECK(half.maxCoeff() == doctest::Approx(0.5));
}

TEST_CASE("extents, axes and thickness of a turned, a sheared and a flat box") {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(3, -1, 2).normalized()).toRotationMatrix();
  Corners corners = make_box({1, 2, 3}, turn, {0.5, 0.25, 0.1}).corners;
  const HexahedronAxes axes = axes_of(corners);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 own = turn.row(axis).transpose();
    CHECK((axes.edges[axis] - own).norm() < 1e-12);
    CHECK((axes.normals[axis] - own).norm() < 1e-12);
    CHECK(extent_along(corners, own).length() == doctest::Approx(axis == 0 ? 1 : axis == 1 ? 0.5 : 0.2));
    CHECK(extent_along(corners, own).middle() == doctest::Approx(own.dot(Vec3(1, 2, 3))));
  }
  CHECK(thickness(corners) == doctest::Approx(0.2));

  // A panel whose upper side is pushed aside keeps its thickness: its normals are not its edges.
  Corners panel = make_box({0, 0, 0}, Mat3::Identity(), {1, 0.05, 1}).corners;
  for (int k = 0; k < 8; ++k) panel(k, 0) += 2 * panel(k, 1);
  CHECK(thickness(panel) == doctest::Approx(0.1));
  CHECK((axes_of(panel).normals[1] - Vec3::UnitY()).norm() < 1e-12);
  CHECK(axes_of(panel).edges[1].dot(Vec3::UnitX()) == doctest::Approx(2 / std::sqrt(5)));

  Corners flat = make_box({0, 0, 0}, Mat3::Identity(), {1, 0, 1}).corners;
  CHECK(axes_of(flat).edges[1] == Vec3::Zero());
  CHECK(axes_of(flat).normals[0] == Vec3::Zero());

  CHECK(common({0, 2}, {1, 5}) == 1);
  CHECK(common({0, 2}, {3, 5}) == -1);
}
