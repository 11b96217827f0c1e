#include "core/gallery/solid.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/result.h"
#include "core/base/tolerance.h"

namespace parsel::gallery {
namespace {

using Map = std::function<Vec3(const Vec3&)>;

/// Moves positions by `map` and normals by the inverse transpose of its Jacobian (central differences).
void deform(TriangleMesh& mesh, const Map& map) {
  constexpr double step = 1e-6;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = mesh.positions[i];
    Mat3 jacobian;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 h = step * Vec3::Unit(axis);
      jacobian.col(axis) = (map(p + h) - map(p - h)) / (2 * step);
    }
    // Cofactors: det(J) · J⁻ᵀ, which needs no division.
    Mat3 cofactors;
    cofactors.col(0) = jacobian.col(1).cross(jacobian.col(2));
    cofactors.col(1) = jacobian.col(2).cross(jacobian.col(0));
    cofactors.col(2) = jacobian.col(0).cross(jacobian.col(1));
    mesh.positions[i] = map(p);
    mesh.normals[i] = (cofactors * mesh.normals[i]).normalized();
  }
}

/// Stretches the mesh so that its bounding box is exactly [-size/2, size/2].
void fit(TriangleMesh& mesh, const Vec3& size) {
  Vec3 low = Vec3::Constant(1e30), high = -low;
  for (const Vec3& p : mesh.positions) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec3 centre = (low + high) / 2;
  const Vec3 ratio = size.cwiseQuotient(high - low);
  for (Vec3& p : mesh.positions) p = (p - centre).cwiseProduct(ratio);
  for (Vec3& n : mesh.normals) n = n.cwiseQuotient(ratio).normalized();
}

/// A rounded box of which every face's flat part has divisions[i] steps along axis i.
TriangleMesh make_rounded_box(const Vec3& size, double radius, int segments, const std::array<int, 3>& divisions) {
  radius = std::min(radius, 0.499 * size.minCoeff());
  const Vec3 inner = size / 2 - Vec3::Constant(radius);
  TriangleMesh mesh;

  // Along one axis of a face: the position of the rounding's centre and the tangent of the normal's angle.
  struct Step {
    double centre, slope;
  };
  const auto steps_along = [&](int axis) {
    std::vector<Step> steps;
    for (int i = 0; i <= segments; ++i) steps.push_back({-inner[axis], std::tan(pi / 4 * (double(i) / segments - 1))});
    const int n = divisions[static_cast<std::size_t>(axis)];
    for (int i = 1; i < n; ++i) steps.push_back({inner[axis] * (2.0 * i / n - 1), 0});
    for (int i = 0; i <= segments; ++i) steps.push_back({inner[axis], std::tan(pi / 4 * double(i) / segments)});
    return steps;
  };

  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const std::vector<Step> along_u = steps_along(u), along_v = steps_along(v);
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const Step& sv : along_v) {
        for (const Step& su : along_u) {
          Vec3 normal, centre;
          normal[axis] = side;
          normal[u] = su.slope;
          normal[v] = sv.slope;
          normal.normalize();
          centre[axis] = side * inner[axis];
          centre[u] = su.centre;
          centre[v] = sv.centre;
          mesh.positions.push_back(centre + radius * normal);
          mesh.normals.push_back(normal);
        }
      }
      const auto columns = static_cast<std::uint32_t>(along_u.size()),
                 rows = static_cast<std::uint32_t>(along_v.size());
      for (std::uint32_t r = 0; r + 1 < rows; ++r) {
        for (std::uint32_t c = 0; c + 1 < columns; ++c) {
          const std::uint32_t a = first + r * columns + c, b = a + 1, d = a + columns, e = d + 1;
          if (side > 0) {
            mesh.triangles.push_back({a, b, e});
            mesh.triangles.push_back({a, e, d});
          } else {
            mesh.triangles.push_back({a, e, b});
            mesh.triangles.push_back({a, d, e});
          }
        }
      }
    }
  }
  return mesh;
}

/// Revolves (radius, height) pairs in metres about y. A closed loop runs counter-clockwise seen with the radius to the
/// right; an open profile runs upwards and starts and ends on the axis.
TriangleMesh revolve(const std::vector<Point2>& profile, bool closed, int segments) {
  TriangleMesh mesh;
  const std::size_t n = profile.size(), edges = closed ? n : n - 1;
  const double crease = std::cos(35 * pi / 180);
  const auto edge_normal = [&](std::size_t e) {
    const Point2 along = profile[(e + 1) % n] - profile[e];
    return Point2(along.y(), -along.x()).normalized();
  };
  const auto vertex_normal = [&](std::size_t edge, std::size_t vertex) {
    const Point2 own = edge_normal(edge);
    const bool is_end = vertex == edge;
    if (!closed && ((is_end && edge == 0) || (!is_end && edge + 1 == edges))) return own;
    const Point2 other = edge_normal(is_end ? (edge + edges - 1) % edges : (edge + 1) % edges);
    return own.dot(other) < crease ? own : Point2((own + other).normalized());
  };
  for (std::size_t e = 0; e < edges; ++e) {
    const std::size_t ends[2] = {e, (e + 1) % n};
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const std::size_t end : {0u, 1u}) {
      const Point2 p = profile[ends[end]], normal = vertex_normal(e, end == 0 ? e : e + 1);
      for (int s = 0; s <= segments; ++s) {
        const double angle = 2 * pi * (s % segments) / segments, x = std::sin(angle), z = std::cos(angle);
        mesh.positions.push_back({p.x() * x, p.y(), p.x() * z});
        mesh.normals.push_back({normal.x() * x, normal.y(), normal.x() * z});
      }
    }
    const auto row = static_cast<std::uint32_t>(segments + 1);
    for (std::uint32_t s = 0; s + 1 < row; ++s) {
      const std::uint32_t a = first + s, b = a + 1, c = a + row, d = c + 1;
      if (profile[ends[0]].x() > 0) mesh.triangles.push_back({a, b, d});
      if (profile[ends[1]].x() > 0) mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

/// Quarter-circle steps that round a profile's corner, from the direction `from` to `to` about `centre`.
void add_arc(std::vector<Point2>& profile, const Point2& centre, double radius, double from, double to, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    profile.push_back(centre + radius * Point2(std::cos(angle), std::sin(angle)));
  }
}

void add_flat_triangle(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = (b - a).cross(c - a);
  if (normal.norm() < 1e-14) return;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {a, b, c}) {
    mesh.positions.push_back(p);
    mesh.normals.push_back(normal.normalized());
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_flat_quad(TriangleMesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 normal = (c - a).cross(d - b).normalized();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {a, b, c, d}) {
    mesh.positions.push_back(p);
    mesh.normals.push_back(normal);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// The convex polygon with every side moved inwards by `distance`.
std::vector<Point2> inset(const std::vector<Point2>& polygon, double distance) {
  const std::size_t n = polygon.size();
  std::vector<Point2> result;
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 before = (polygon[i] - polygon[(i + n - 1) % n]).normalized();
    const Point2 after = (polygon[(i + 1) % n] - polygon[i]).normalized();
    const Point2 inward_before(-before.y(), before.x()), inward_after(-after.y(), after.x());
    const Point2 bisector = inward_before + inward_after;
    result.push_back(polygon[i] + bisector * (distance / (0.5 * bisector.squaredNorm())));
  }
  return result;
}

/// Axes permuted cyclically: y → z (turns = 1) or y → x (turns = 2), which keeps the orientation.
Solid permuted(Solid solid, int turns) {
  return [solid = std::move(solid), turns](const Vec3& size) {
    const auto permute = [](const Vec3& v, int by) {
      Vec3 result;
      for (int i = 0; i < 3; ++i) result[(i + by) % 3] = v[i];
      return result;
    };
    TriangleMesh mesh = solid(permute(size, 3 - turns));
    for (Vec3& p : mesh.positions) p = permute(p, turns);
    for (Vec3& n : mesh.normals) n = permute(n, turns);
    return mesh;
  };
}

}  // namespace

Solid rounded_box(double radius, int segments) {
  return [=](const Vec3& size) { return make_rounded_box(size, radius, segments, {1, 1, 1}); };
}

Solid tapered_box(double radius, double foot, double from) {
  return [=](const Vec3& size) {
    TriangleMesh mesh = make_rounded_box(size, radius, 2, {1, 12, 1});
    deform(mesh, [&](const Vec3& p) {
      const double height = p.y() / size.y() + 0.5;
      const double section = height >= from ? 1.0 : foot + (1 - foot) * height / from;
      return Vec3(p.x() * section, p.y(), p.z() * section);
    });
    fit(mesh, size);
    return mesh;
  };
}

Solid cushion(double radius, double swell) {
  return [=](const Vec3& size) {
    TriangleMesh mesh = make_rounded_box(size - Vec3::Constant(swell), radius, 3, {6, 6, 6});
    const Vec3 half = size / 2;
    deform(mesh, [&](const Vec3& p) {
      Vec3 moved = p;
      for (int axis = 0; axis < 3; ++axis) {
        const double u = p[(axis + 1) % 3] / half[(axis + 1) % 3], v = p[(axis + 2) % 3] / half[(axis + 2) % 3];
        moved[axis] += swell * p[axis] / half[axis] * std::max(0.0, 1 - u * u) * std::max(0.0, 1 - v * v);
      }
      return moved;
    });
    fit(mesh, size);
    return mesh;
  };
}

Solid arched_box(double radius, double rise) {
  return [=](const Vec3& size) {
    TriangleMesh mesh = make_rounded_box(size, radius, 2, {16, 1, 1});
    deform(mesh, [&](const Vec3& p) {
      const double u = 2 * p.x() / size.x(), height = p.y() / size.y() + 0.5;
      return Vec3(p.x(), p.y() - rise * u * u * height, p.z());
    });
    fit(mesh, size);
    return mesh;
  };
}

Solid turned(std::vector<Point2> profile, int segments) {
  return [profile = std::move(profile), segments](const Vec3& size) {
    std::vector<Point2> metres;
    if (profile.front().x() > 0) metres.push_back({0, profile.front().y() * size.y()});
    for (const Point2& p : profile) metres.push_back({p.x() * size.x() / 2, p.y() * size.y()});
    if (profile.back().x() > 0) metres.push_back({0, profile.back().y() * size.y()});
    TriangleMesh mesh = revolve(metres, false, segments);
    fit(mesh, size);
    return mesh;
  };
}

Solid cylinder(double bevel, int segments) {
  return cone(1, 1, bevel, segments);
}

Solid cone(double bottom, double top, double bevel, int segments) {
  return [=](const Vec3& size) {
    const double h = size.y(), low = bottom * size.x() / 2, high = top * size.x() / 2;
    const double r = std::min({bevel, 0.45 * h, 0.9 * low, 0.9 * high});
    const double slant = std::atan2(low - high, h);
    std::vector<Point2> profile = {{0, 0}};
    add_arc(profile, {low - r, r}, r, -pi / 2, slant, 3);
    add_arc(profile, {high - r, h - r}, r, slant, pi / 2, 3);
    profile.push_back({0, h});
    TriangleMesh mesh = revolve(profile, false, segments);
    fit(mesh, size);
    return mesh;
  };
}

Solid ring(double tube, int segments, int tube_segments) {
  return [=](const Vec3& size) {
    std::vector<Point2> profile;
    for (int i = 0; i < tube_segments; ++i) {
      const double angle = 2 * pi * i / tube_segments;
      profile.push_back({size.x() / 2 - tube + tube * std::cos(angle), size.y() / 2 * std::sin(angle)});
    }
    TriangleMesh mesh = revolve(profile, true, segments);
    fit(mesh, size);
    return mesh;
  };
}

Solid shade(double wall, double top, int segments) {
  return [=](const Vec3& size) {
    const double low = size.x() / 2, high = top * low, h = size.y();
    TriangleMesh mesh = revolve({{low - wall, 0}, {low, 0}, {high, h}, {high - wall, h}}, true, segments);
    fit(mesh, size);
    return mesh;
  };
}

Solid prism(std::vector<Point2> outline, double bevel) {
  return [outline = std::move(outline), bevel](const Vec3& size) {
    std::vector<Point2> outer;
    for (const Point2& p : outline) outer.push_back({p.x() * size.x() / 2, p.y() * size.y() / 2});
    const double b = std::min(bevel, 0.45 * size.z());
    const std::vector<Point2> inner = inset(outer, b);
    const double z = size.z() / 2;
    const auto at = [](const Point2& p, double depth) { return Vec3(p.x(), p.y(), depth); };
    TriangleMesh mesh;
    const std::size_t n = outer.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      add_flat_triangle(mesh, at(inner[0], z), at(inner[i], z), at(inner[i + 1], z));
      add_flat_triangle(mesh, at(inner[0], -z), at(inner[i + 1], -z), at(inner[i], -z));
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = (i + 1) % n;
      add_flat_quad(mesh, at(inner[i], z), at(outer[i], z - b), at(outer[j], z - b), at(inner[j], z));
      add_flat_quad(mesh, at(outer[i], z - b), at(outer[i], b - z), at(outer[j], b - z), at(outer[j], z - b));
      add_flat_quad(mesh, at(outer[i], b - z), at(inner[i], -z), at(inner[j], -z), at(outer[j], b - z));
    }
    fit(mesh, size);
    return mesh;
  };
}

Solid faceted(int sides, double top, double phase, double lip) {
  return [=](const Vec3& size) {
    const auto corner = [&](int i, double radius, double height) {
      const double angle = phase + 2 * pi * (i % sides) / sides;
      return Vec3(radius * std::sin(angle), height, radius * std::cos(angle));
    };
    TriangleMesh mesh;
    const double h = size.y(), edge = std::min(lip, 0.5 * h);
    for (int i = 0; i < sides; ++i) {
      add_flat_triangle(mesh, {0, 0, 0}, corner(i + 1, 1, 0), corner(i, 1, 0));
      add_flat_quad(mesh, corner(i, 1, 0), corner(i + 1, 1, 0), corner(i + 1, 1, edge), corner(i, 1, edge));
      if (top > 0) {
        add_flat_quad(mesh, corner(i, 1, edge), corner(i + 1, 1, edge), corner(i + 1, top, h), corner(i, top, h));
        add_flat_triangle(mesh, {0, h, 0}, corner(i, top, h), corner(i + 1, top, h));
      } else {
        add_flat_triangle(mesh, corner(i, 1, edge), corner(i + 1, 1, edge), {0, h, 0});
      }
    }
    fit(mesh, size);
    return mesh;
  };
}

Solid along_x(Solid solid) {
  return permuted(std::move(solid), 2);
}
Solid along_z(Solid solid) {
  return permuted(std::move(solid), 1);
}

}  // namespace parsel::gallery
