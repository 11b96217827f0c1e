#include <doctest/doctest.h>

#include "core/base/random.h"
#include "core/shape/surface.h"
#include "tests/core/glb_fixture.h"

using namespace parsel;

namespace {

PartMesh random_mesh(Random& random, int triangles) {
  PartMesh mesh;
  for (int i = 0; i < 3 * triangles; ++i) {
    mesh.positions.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.2, 0.2));
  }
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(triangles); ++i) {
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

}  // namespace

TEST_CASE("the distance to a triangle is that of its nearest point") {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  CHECK(distance_to_triangle({0.2, 0.2, 0.5}, a, b, c) == doctest::Approx(0.5));
  CHECK(distance_to_triangle({-3, -4, 0}, a, b, c) == doctest::Approx(5));
  CHECK(distance_to_triangle({0.5, -2, 0}, a, b, c) == doctest::Approx(2));
  CHECK(distance_to_triangle({1, 1, 0}, a, b, c) == doctest::Approx(std::sqrt(0.5)));
  // Degenerate: a segment and a point.
  CHECK(distance_to_triangle({0.5, 1, 0}, a, b, b) == doctest::Approx(1));
  CHECK(distance_to_triangle({0, 2, 0}, a, a, a) == doctest::Approx(2));
}

TEST_CASE("the grid answers as a search through all triangles does") {
  Random random(3);
  for (const int triangles : {1, 12, 400}) {
    const PartMesh mesh = random_mesh(random, triangles);
    const double distance = 0.05;
    const SurfaceGrid grid(mesh, distance);
    for (int i = 0; i < 300; ++i) {
      const Vec3 p(random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), random.uniform(-0.4, 0.4));
      bool near = false;
      for (const Triangle& t : mesh.triangles) {
        near = near ||
               distance_to_triangle(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]) <= distance;
      }
      REQUIRE(grid.near(p) == near);
    }
  }
}

TEST_CASE("samples lie on the surface, spread by area, the same every time") {
  PartMesh mesh;  // one small and one large triangle
  mesh.positions = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {2, 0, 0}, {5, 0, 0}, {2, 3, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const std::vector<Vec3> samples = sample_surface(mesh, 1000);
  CHECK(samples.size() == 1000);
  std::size_t small = 0;
  const SurfaceGrid grid(mesh, 1e-9);
  for (const Vec3& s : samples) {
    CHECK(grid.near(s));
    if (s.x() < 1) ++small;
  }
  CHECK(small <= 2);  // 0.005 of 4.505
  CHECK(samples == sample_surface(mesh, 1000));
}
