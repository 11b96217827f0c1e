#include "tests/eval/measure.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace parsel::eval {
namespace {

constexpr int n = cells_per_axis;
constexpr std::size_t most_pairs = 5;

std::size_t cell_index(int i, int j, int k) {
  return static_cast<std::size_t>((k * n + j) * n + i);
}

Vec3 cell_centre(std::size_t cell) {
  const int c = static_cast<int>(cell);
  return (Vec3(c % n, c / n % n, c / (n * n)).array() + 0.5) * (2.0 / n) - 1;
}

/// The cell of a local point, none outside the box.
std::optional<std::size_t> cell_of(const Vec3& local) {
  if ((local.array().abs() > 1).any() || !local.allFinite()) return std::nullopt;
  std::array<int, 3> at{};
  for (int axis = 0; axis < 3; ++axis) {
    at[static_cast<std::size_t>(axis)] = std::min(n - 1, static_cast<int>((local[axis] + 1) / 2 * n));
  }
  return cell_index(at[0], at[1], at[2]);
}

/// Local coordinates in a hexahedron, without Newton's method where it is a parallelepiped.
class Locator {
 public:
  explicit Locator(const Corners& corners) : corners_(corners) {
    centre_ = corners.colwise().mean().transpose();
    Mat3 edges = Mat3::Zero();
    for (int k = 0; k < 8; ++k) {
      for (int axis = 0; axis < 3; ++axis) edges.col(axis) += corner_sign(k, axis) * corners.row(k).transpose() / 8;
    }
    inverse_ = edges.inverse();
    for (int k = 0; k < 8; ++k) {
      const Vec3 signs(corner_sign(k, 0), corner_sign(k, 1), corner_sign(k, 2));
      affine_ = affine_ && (centre_ + edges * signs - corners.row(k).transpose()).norm() < 1e-9;
    }
    affine_ = affine_ && inverse_.allFinite();
  }
  Vec3 operator()(const Vec3& point) const {
    return affine_ ? Vec3(inverse_ * (point - centre_)) : local_coordinates(corners_, point);
  }

 private:
  const Corners& corners_;
  Vec3 centre_ = Vec3::Zero();
  Mat3 inverse_ = Mat3::Zero();
  bool affine_ = true;
};

double volume(const Corners& corners) {
  double sum = 0;  // the Jacobian's determinant at the eight Gauss points
  for (int g = 0; g < 8; ++g) {
    Mat3 jacobian = Mat3::Zero();
    const double at = 1 / std::sqrt(3.0);
    for (int k = 0; k < 8; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        double weight = corner_sign(k, axis) / 2.0;
        for (int other = 0; other < 3; ++other) {
          if (other != axis) weight *= (1 + corner_sign(k, other) * corner_sign(g, other) * at) / 2;
        }
        jacobian.col(axis) += weight * corners.row(k).transpose();
      }
    }
    sum += std::abs(jacobian.determinant());
  }
  return sum;
}

/// Cells that the surface passes through, and those that cannot be reached from outside without passing it.
std::bitset<cell_count> solid_cells(const PartMesh& mesh, const Hexahedron& box) {
  std::bitset<cell_count> surface;
  for (const Vec3& point : sample_surface(mesh, 6000)) {
    if (const auto cell = cell_of(box.local(point).cwiseMax(-1).cwiseMin(1))) surface.set(*cell);
  }
  std::bitset<cell_count> outside;
  std::vector<std::array<int, 3>> open;
  const auto visit = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || k < 0 || i >= n || j >= n || k >= n) return;
    const std::size_t cell = cell_index(i, j, k);
    if (surface[cell] || outside[cell]) return;
    outside.set(cell);
    open.push_back({i, j, k});
  };
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) {
      for (const int side : {0, n - 1}) {
        visit(side, a, b);
        visit(a, side, b);
        visit(a, b, side);
      }
    }
  }
  while (!open.empty()) {
    const auto [i, j, k] = open.back();
    open.pop_back();
    for (const int step : {-1, 1}) {
      visit(i + step, j, k);
      visit(i, j + step, k);
      visit(i, j, k + step);
    }
  }
  return ~outside;
}

/// Points of a surface that show where it touches: samples, and vertices, for contacts may be small.
std::vector<Vec3> surface_points(const PartMesh& mesh) {
  std::vector<Vec3> points = sample_surface(mesh, 500);
  const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / 500);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += step) {
    for (const std::uint32_t v : mesh.triangles[t]) points.push_back(mesh.positions[v]);
  }
  return points;
}

double distance(const std::vector<Vec3>& points, const PartMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    for (const Vec3& p : points) {
      // The box first: it is nearer than what is in it.
      if ((p - p.cwiseMax(low).cwiseMin(high)).norm() < least)
        least = std::min(least, distance_to_triangle(p, a, b, c));
    }
  }
  return least;
}

bool boxes_meet(const Corners& a, const Corners& b, double distance) {
  return (a.colwise().minCoeff().array() <= b.colwise().maxCoeff().array() + distance).all() &&
         (b.colwise().minCoeff().array() <= a.colwise().maxCoeff().array() + distance).all();
}

void keep_worst(std::vector<PairOfParts>& pairs) {
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const PairOfParts& a, const PairOfParts& b) { return a.amount > b.amount; });
  if (pairs.size() > most_pairs) pairs.resize(most_pairs);
}

}  // namespace

Gauge::Gauge(const Abstraction& abstraction) : abstraction_(abstraction) {
  const auto& parts = abstraction.shape.parts;
  const auto& meshes = abstraction.meshes;
  for (const PartIndex p : meshes.indices()) {
    const Corners& corners = parts[p].hexahedron.corners;
    solids_.push_back({solid_cells(meshes[p], parts[p].hexahedron), corners.colwise().minCoeff().transpose(),
                       corners.colwise().maxCoeff().transpose()});
  }
  std::vector<std::vector<Vec3>> points;
  std::vector<SurfaceGrid> grids;
  grids.reserve(meshes.size());
  for (const PartMesh& mesh : meshes) {
    points.push_back(surface_points(mesh));
    grids.emplace_back(mesh, touching);
  }
  const auto contact_of = [&](PartIndex a, PartIndex b) {
    Contact contact{a, b, {}, 0};
    std::vector<Vec3> near;
    for (const Vec3& point : points[a.value()]) {
      if (grids[b.value()].near(point)) near.push_back(point);
    }
    const std::size_t step = std::max<std::size_t>(1, near.size() / 64);
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < near.size(); i += step) kept.push_back(near[i]);
    if (kept.empty()) return contact;
    contact.distance = distance(kept, meshes[b]);
    for (const Vec3& point : kept) contact.points.push_back(parts[a].hexahedron.local(point));
    return contact;
  };
  for (const PartIndex a : meshes.indices()) {
    for (const PartIndex b : meshes.indices()) {
      if (a >= b || !boxes_meet(parts[a].hexahedron.corners, parts[b].hexahedron.corners, touching)) continue;
      // Seen from the smaller part, or from the instance of a group: that is what may be copied.
      const double extent_a = (solids_[a].high - solids_[a].low).norm();
      const double extent_b = (solids_[b].high - solids_[b].low).norm();
      const bool a_first =
          parts[a].group.has_value() != parts[b].group.has_value() ? parts[a].group.has_value() : extent_a <= extent_b;
      Contact contact = a_first ? contact_of(a, b) : contact_of(b, a);
      if (contact.points.empty()) contact = a_first ? contact_of(b, a) : contact_of(a, b);
      if (!contact.points.empty()) contacts_.push_back(std::move(contact));
    }
  }
}

std::vector<Gauge::Thing> Gauge::things(const State& state) const {
  const Shape& shape = abstraction_.shape;
  std::vector<Thing> all;
  const auto changed_group = [&](PartIndex p) -> const GroupState* {
    const auto group = shape.parts[p].group;
    return group && state.groups[*group].count_changed ? &state.groups[*group] : nullptr;
  };
  for (const PartIndex p : abstraction_.meshes.indices()) {
    if (const GroupState* group = changed_group(p)) {
      const auto& members = shape.relations[*shape.parts[p].group].parts;
      if (members[static_cast<std::size_t>(std::max(0, group->source))] != p) continue;
      for (const Corners& corners : group->instances) all.push_back({p, corners, true, true});
    } else {
      const Corners& corners = state.parts[p];
      const bool moved = (corners - shape.parts[p].hexahedron.corners).cwiseAbs().maxCoeff() > 1e-9;
      all.push_back({p, corners, false, moved});
    }
  }
  return all;
}

double Gauge::new_overlap(const Thing& a, const Thing& b) const {
  const Solid& solid_a = solids_[a.part];
  const Solid& solid_b = solids_[b.part];
  const Locator now(b.corners);
  const Hexahedron& rest_a = abstraction_.shape.parts[a.part].hexahedron;
  const Hexahedron& rest_b = abstraction_.shape.parts[b.part].hexahedron;
  const auto hits = [&](const Vec3& local) {
    const auto cell = cell_of(local);
    return cell && solid_b.cells[*cell];
  };
  int count = 0;
  for (std::size_t cell = 0; cell < cell_count; ++cell) {
    if (!solid_a.cells[cell]) continue;
    const Vec3 centre = cell_centre(cell);
    if (!hits(now(interpolate(trilinear_weights(centre), a.corners)))) continue;
    if (a.part == b.part || !hits(rest_b.local(rest_a.point(centre)))) ++count;
  }
  return count == 0 ? 0 : count * volume(a.corners) / cell_count;
}

PartMesh Gauge::deformed(const Thing& thing) const {
  PartMesh mesh = abstraction_.meshes[thing.part];
  const Hexahedron& rest = abstraction_.shape.parts[thing.part].hexahedron;
  for (Vec3& point : mesh.positions) {
    if (point.allFinite()) point = interpolate(trilinear_weights(rest.local(point)), thing.corners);
  }
  return mesh;
}

double Gauge::gap(const Contact& contact, const Thing& a, const Thing& b) const {
  std::vector<Vec3> points;
  for (const Vec3& local : contact.points) points.push_back(interpolate(trilinear_weights(local), a.corners));
  const PartMesh mesh = deformed(b);
  // Most still touch: one that does is enough.
  const SurfaceGrid grid(mesh, contact.distance + 1e-3);
  if (std::any_of(points.begin(), points.end(), [&](const Vec3& p) { return grid.near(p); })) return 0;
  return std::max(0.0, distance(points, mesh) - contact.distance);
}

bool Gauge::shared_by_group(const Contact& contact) const {
  const Shape& shape = abstraction_.shape;
  const auto& members = shape.relations[*shape.parts[contact.a].group].parts;
  return std::all_of(members.begin(), members.end(), [&](PartIndex member) {
    return std::any_of(contacts_.begin(), contacts_.end(),
                       [&](const Contact& other) { return other.a == member && other.b == contact.b; });
  });
}

Damage Gauge::measure(const State& state) const {
  const Shape& shape = abstraction_.shape;
  Damage damage;
  const std::vector<Thing> all = things(state);
  for (const Thing& thing : all) damage.finite = damage.finite && thing.corners.allFinite();
  if (!damage.finite) return damage;
  for (const Thing& thing : all) {
    const double least = relative_jacobians(thing.corners, shape.parts[thing.part].hexahedron.corners).minCoeff();
    if (least >= damage.least_jacobian) continue;
    damage.least_jacobian = least;
    damage.least_jacobian_of = shape.parts[thing.part].id;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((!all[i].moved && !all[j].moved) || !boxes_meet(all[i].corners, all[j].corners, 0)) continue;
      const double shared = std::min(new_overlap(all[i], all[j]), new_overlap(all[j], all[i]));
      if (shared <= 0) continue;
      damage.overlap += shared;
      damage.overlaps.push_back({shape.parts[all[i].part].id, shape.parts[all[j].part].id, shared});
    }
  }
  for (const Contact& contact : contacts_) {
    for (const Thing& a : all) {
      if (a.part != contact.a || (a.copied && !shared_by_group(contact))) continue;
      double least = std::numeric_limits<double>::infinity();  // from the nearest copy of b, if there are several
      for (const Thing& b : all) {
        if (b.part == contact.b) least = std::min(least, a.moved || b.moved ? gap(contact, a, b) : 0);
      }
      if (!std::isfinite(least) || least <= 0) continue;  // the other is an instance that went away
      damage.gap = std::max(damage.gap, least);
      damage.gaps.push_back({shape.parts[contact.a].id, shape.parts[contact.b].id, least});
    }
  }
  keep_worst(damage.overlaps);
  keep_worst(damage.gaps);
  return damage;
}

}  // namespace parsel::eval
