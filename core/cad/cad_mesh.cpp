#include "core/cad/cad_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/tolerance.h"
#include "core/gallery/glb_writer.h"

namespace parsel::cad {

namespace {

using gallery::TriangleMesh;

constexpr int round_sides = 48, sphere_rings = 24;  // multiples of 4: round parts touch their boxes

/// A polygon with its corners counter-clockwise seen from outside, flat.
void add_face(TriangleMesh& mesh, const std::vector<Vec3>& corners) {
  Vec3 normal = Vec3::Zero();  // Newell's: a corner or two may coincide
  for (std::size_t i = 0; i < corners.size(); ++i) normal += corners[i].cross(corners[(i + 1) % corners.size()]);
  if (normal.norm() < 1e-300) return;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& corner : corners) {
    mesh.positions.push_back(corner);
    mesh.normals.push_back(normal.normalized());
  }
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) mesh.triangles.push_back({first, first + i, first + i + 1});
}

TriangleMesh box_mesh(const Vec3& size) {
  TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {-1, 1}) {
      std::vector<Vec3> corners;
      for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
        Vec3 corner;
        corner[axis] = side;
        corner[u] = side > 0 ? a : b;
        corner[v] = side > 0 ? b : a;
        corners.push_back(corner.cwiseProduct(size) / 2);
      }
      add_face(mesh, corners);
    }
  }
  return mesh;
}

/// cos of quarter_steps / quarter quarter turns.
double exact_cos(int quarter_steps, int quarter) {
  // Corners at whole quarter turns lie exactly on the axes.
  constexpr std::array at_quarter = {1.0, 0.0, -1.0, 0.0};
  if (quarter_steps % quarter == 0) return at_quarter[static_cast<std::size_t>(std::abs(quarter_steps / quarter) % 4)];
  return std::cos(pi / 2 * quarter_steps / quarter);
}

TriangleMesh round_mesh(const Part& part) {
  const int a = part.axis, u = (a + 1) % 3, v = (a + 2) % 3;
  const int sides = part.sides > 0 ? part.sides : round_sides;
  const double narrow = part.kind == Kind::cone ? part.top / part.size[u] : 1;
  const auto corner = [&](int k, int end) {  // end -1: base, 1: top
    Vec3 p;
    const double r = end < 0 ? 0.5 : narrow / 2;
    const int step = 4 * k + part.phase * sides;  // in quarter turns of 1 / sides
    p[u] = exact_cos(step, sides) * r * part.size[u];
    p[v] = exact_cos(step + 3 * sides, sides) * r * part.size[v];
    p[a] = end * part.towards * part.size[a] / 2;
    return p;
  };
  TriangleMesh mesh;
  std::vector<Vec3> base, top;
  for (int k = 0; k < sides; ++k) {
    base.push_back(corner(k, -1));
    top.push_back(corner(k, 1));
  }
  const auto outward = [&](std::vector<Vec3> corners, bool is_turned) {
    if (is_turned == (part.towards > 0)) std::reverse(corners.begin(), corners.end());
    add_face(mesh, corners);
  };
  outward(base, true);
  if (narrow > 0) outward(top, false);
  for (int k = 0; k < sides; ++k) {
    const auto i = static_cast<std::size_t>(k), j = static_cast<std::size_t>((k + 1) % sides);
    if (narrow > 0) {
      outward({base[i], base[j], top[j], top[i]}, false);
    } else {
      outward({base[i], base[j], top[i]}, false);
    }
  }
  if (part.sides > 0) return mesh;
  // A smooth side: normals of the two ends of an edge lean alike and turn with their corner.
  const double slope = (1 - narrow) / 2 / part.size[a];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (std::abs(mesh.normals[i][a]) > 0.999999) continue;
    Vec3 n = mesh.positions[i];
    const double reach = std::hypot(n[u] / part.size[u], n[v] / part.size[v]);
    if (reach < 1e-12) continue;  // the tip keeps the normals of its faces
    n[u] /= part.size[u] * part.size[u] * reach;
    n[v] /= part.size[v] * part.size[v] * reach;
    n[a] = part.towards * slope;
    mesh.normals[i] = n.normalized();
  }
  return mesh;
}

TriangleMesh sphere_mesh(const Vec3& size) {
  TriangleMesh mesh;
  const auto at = [&](int ring, int k) {
    const int half = sphere_rings / 2;
    const double r = exact_cos(ring - half, half), height = exact_cos(ring, half);
    return Vec3(exact_cos(4 * k, round_sides) * r, height, exact_cos(4 * k + 3 * round_sides, round_sides) * r);
  };
  for (int ring = 0; ring <= sphere_rings; ++ring) {
    for (int k = 0; k <= round_sides; ++k) {
      const Vec3 p = at(ring, k % round_sides);
      mesh.positions.push_back(p.cwiseProduct(size) / 2);
      mesh.normals.push_back(p.cwiseQuotient(size).normalized());
    }
  }
  constexpr std::uint32_t row = round_sides + 1;
  for (std::uint32_t ring = 0; ring < sphere_rings; ++ring) {
    for (std::uint32_t k = 0; k < round_sides; ++k) {
      const std::uint32_t a = ring * row + k, b = a + 1, c = a + row, d = c + 1;
      if (ring > 0) mesh.triangles.push_back({a, b, d});
      if (ring + 1 < sphere_rings) mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

double linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

}  // namespace

double metres(const Model& model) {
  return model.unit == "m" ? 1 : model.unit == "cm" ? 0.01 : model.unit == "in" ? 0.0254 : 0.001;
}

std::string to_glb(const Model& model) {
  gallery::GlbScene scene;
  scene.name = model.name;
  scene.generator = "parsel cad";
  std::map<std::array<double, 4>, int> materials;
  const double unit = metres(model);
  for (const Part& given : model.parts) {
    if (given.role != Role::add) continue;
    Part part = given;
    part.size *= unit;
    part.top *= unit;
    const bool is_coloured = part.colour[3] > 0;
    const std::array<double, 4> colour = is_coloured ? part.colour : std::array{0.79, 0.77, 0.72, 1.0};
    const auto [material, is_new] = materials.emplace(colour, static_cast<int>(scene.materials.size()));
    if (is_new) {
      scene.materials.push_back({"colour " + std::to_string(scene.materials.size() + 1),
                                 {linear(colour[0]), linear(colour[1]), linear(colour[2])}});
    }
    TriangleMesh mesh = part.kind == Kind::cylinder || part.kind == Kind::cone ? round_mesh(part)
                        : part.kind == Kind::sphere                            ? sphere_mesh(part.size)
                                                                               : box_mesh(part.size);
    gallery::GlbNode node;
    node.name = part.id;
    node.label = part.label;
    node.mesh = static_cast<int>(scene.meshes.size());
    const Vec3 centre = part.centre * unit;
    node.translation = (centre * 1e6).array().round() / 1e6;  // as it is written; the rest goes into the vertices
    for (Vec3& p : mesh.positions) p += centre - node.translation;
    scene.meshes.push_back({part.id, {{std::move(mesh), material->second}}});
    scene.nodes.push_back(std::move(node));
  }
  return gallery::write_glb(scene);
}

}  // namespace parsel::cad
