#include "core/shape/attachment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/result.h"

namespace parsel {
namespace {

/// A box by centre, axes and half extents, which is what clipping needs.
struct Box {
  explicit Box(const Hexahedron& h)
      : centre(h.corners.colwise().mean().transpose()), axes(h.axes), half(h.half_extents()) {}
  Vec3 to_local(const Vec3& p) const { return axes * (p - centre); }
  Vec3 to_world(const Vec3& q) const { return centre + axes.transpose() * q; }
  /// Half extents of the axis-aligned box around it, inflated.
  Vec3 reach(double inflation) const { return axes.transpose().cwiseAbs() * (half.array() + inflation).matrix(); }
  Vec3 centre;
  Mat3 axes;
  Vec3 half;
};

/// A convex polygon: a triangle gains at most one corner at each of six planes.
struct Polygon {
  std::array<Vec3, 9> corners;
  std::size_t size = 0;
};

/// Keeps the part of the polygon with sign · coordinate[axis] ≤ limit (Sutherland, Hodgman 1974).
void clip(Polygon& polygon, int axis, double sign, double limit) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Vec3 &a = polygon.corners[i], &b = polygon.corners[(i + 1) % polygon.size];
    const double da = limit - sign * a[axis], db = limit - sign * b[axis];
    if (da >= 0) out.corners[out.size++] = a;
    if ((da >= 0) != (db >= 0) && out.size < out.corners.size()) out.corners[out.size++] = a + da / (da - db) * (b - a);
  }
  polygon = out;
}

/// Adds what of the mesh lies in the inflated box, put onto the box itself.
void clip_surface(const PartMesh& mesh, const Box& box, double distance, ContactRegion& region) {
  const Vec3 reach = box.reach(distance);
  const Vec3 low = box.centre - reach, high = box.centre + reach;
  const Vec3 limit = (box.half.array() + distance).matrix();
  for (const Triangle& t : mesh.triangles) {
    const Vec3 &p0 = mesh.positions[t[0]], &p1 = mesh.positions[t[1]], &p2 = mesh.positions[t[2]];
    if ((p0.cwiseMin(p1).cwiseMin(p2).array() > high.array()).any()) continue;
    if ((p0.cwiseMax(p1).cwiseMax(p2).array() < low.array()).any()) continue;
    Polygon polygon;
    polygon.corners[0] = box.to_local(p0);
    polygon.corners[1] = box.to_local(p1);
    polygon.corners[2] = box.to_local(p2);
    polygon.size = 3;
    const Vec3 &q0 = polygon.corners[0], &q1 = polygon.corners[1], &q2 = polygon.corners[2];
    const Vec3 furthest = q0.cwiseAbs().cwiseMax(q1.cwiseAbs()).cwiseMax(q2.cwiseAbs());
    const bool is_inside = (furthest.array() <= limit.array()).all();
    for (int axis = 0; axis < 3 && polygon.size > 0 && !is_inside; ++axis) {
      clip(polygon, axis, 1, limit[axis]);
      clip(polygon, axis, -1, limit[axis]);
    }
    if (polygon.size == 0) continue;
    for (std::size_t i = 0; i < polygon.size; ++i) {
      polygon.corners[i] = box.to_world(polygon.corners[i].cwiseMin(box.half).cwiseMax(-box.half));
      region.add(polygon.corners[i]);
    }
    for (std::size_t i = 1; i + 1 < polygon.size; ++i) {
      const Vec3 &a = polygon.corners[0], &b = polygon.corners[i], &c = polygon.corners[i + 1];
      const double area = (b - a).cross(c - a).norm() / 2;
      region.area += area;
      region.moment += area * (a + b + c) / 3;
    }
  }
}

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double middle() const { return (low + high) / 2; }
  double half() const { return (high - low) / 2; }
};

/// The region along each axis of a box, relative to its centre.
std::array<Interval, 3> extents(const ContactRegion& region, const Box& box) {
  std::array<Interval, 3> out;
  for (const Vec3& v : region.vertices) {
    const Vec3 q = box.to_local(v);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out[axis].low = std::min(out[axis].low, q[static_cast<int>(axis)]);
      out[axis].high = std::max(out[axis].high, q[static_cast<int>(axis)]);
    }
  }
  return out;
}

double snap_tolerance(double half_extent) {
  return std::min(snap_distance, half_extent / 4);
}

/// The axes of the box about whose middle planes the region is symmetric: its ends are, and so is its mean.
std::array<bool, 3> symmetric_axes(const ContactRegion& region, const Box& box) {
  const std::array<Interval, 3> along = extents(region, box);
  const Vec3 mean = box.to_local(region.mean());
  std::array<bool, 3> symmetric{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int i = static_cast<int>(axis);
    symmetric[axis] = std::abs(along[axis].middle()) <= snap_tolerance(box.half[i]) &&
                      std::abs(mean[i]) <= 0.25 * along[axis].half() + snap_tolerance(box.half[i]);
  }
  return symmetric;
}

/// Local coordinates in [-1,1]-units, put onto -1, 0 or 1 where they are near.
Vec3 snapped_local(const Box& box, const Vec3& point) {
  const Vec3 metric = box.to_local(point);
  Vec3 local;
  for (int axis = 0; axis < 3; ++axis) {
    local[axis] = metric[axis] / box.half[axis];
    for (const double target : {-1.0, 0.0, 1.0}) {
      if (std::abs(metric[axis] - target * box.half[axis]) <= snap_tolerance(box.half[axis])) local[axis] = target;
    }
  }
  return local;
}

constexpr double parallel = 0.985;  ///< cos 10°
/// A region that covers this share of both boxes along an axis ties its ends, symmetric or not; cushions lean. A little
/// more than half: half of a post is what modellers like, and rounding must not decide.
constexpr double covering = 0.501;
constexpr double leaning = 0.866;  ///< cos 30°
/// Of two parts that run into each other the one that is longer by this much is the one whose length changes.
constexpr double plainly_longer = 1.5;

/// Where two parts are tied along an axis of one of them that none of their shared planes has: in the middle of the
/// region, but where they run into each other, each ending within the other, at the end of the one that is plainly
/// longer. Tied further in, a leg that ends within its top would run deeper into it the longer it gets.
double tied_at(const Interval& region, int axis, const Box& frame, const Box& other) {
  for (int j = 0; j < 3; ++j) {
    const Vec3 normal = frame.axes.row(axis).transpose();
    if (std::abs(other.axes.row(j).dot(normal)) <= parallel) continue;
    const double half = frame.half[axis], half_other = other.half[j];
    const double centre = (other.centre - frame.centre).dot(normal);
    const double sign = centre > 0 ? 1 : -1;
    const double end = sign * half, end_other = centre - sign * half_other;
    const double low = std::min(end, end_other), high = std::max(end, end_other);
    const double tolerance = snap_tolerance(std::min(half, half_other));
    const auto near = [&](double a, double b) { return std::abs(a - b) <= tolerance; };
    const bool run_through = near(-end, end_other) || near(end, centre + sign * half_other);
    if (run_through || !near(region.low, low) || !near(region.high, high)) break;
    if (half > plainly_longer * half_other) return end;
    if (half_other > plainly_longer * half) return end_other;
    break;
  }
  return region.middle();
}

}  // namespace

void ContactRegion::add(const Vec3& vertex) {
  vertices.push_back(vertex);
  vertex_sum += vertex;
  ++vertex_count;
}

void ContactRegion::add(const ContactRegion& other) {
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  vertex_sum += other.vertex_sum;
  vertex_count += other.vertex_count;
  moment += other.moment;
  area += other.area;
}

Vec3 ContactRegion::mean() const {
  PARSEL_ASSERT(!vertices.empty(), "an empty region has no mean");
  if (area > 1e-12) return moment / area;
  return vertex_sum / static_cast<double>(vertex_count);  // an edge or a corner
}

void ContactRegion::reduce(const std::vector<Mat3>& axes) {
  std::vector<std::size_t> kept;
  for (const Mat3& rows : axes) {
    for (int i = 0; i < 3; ++i) {
      const auto along = [&](const Vec3& a, const Vec3& b) { return rows.row(i).dot(a) < rows.row(i).dot(b); };
      const auto [low, high] = std::minmax_element(vertices.begin(), vertices.end(), along);
      kept.push_back(static_cast<std::size_t>(low - vertices.begin()));
      kept.push_back(static_cast<std::size_t>(high - vertices.begin()));
    }
  }
  if (vertices.empty()) return;
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  std::vector<Vec3> furthest;
  for (const std::size_t i : kept) furthest.push_back(vertices[i]);
  vertices = std::move(furthest);
}

ContactRegion contact_region(const PartMesh& a, const Hexahedron& box_a, const PartMesh& b, const Hexahedron& box_b,
                             double distance) {
  const Box first(box_a), second(box_b);
  ContactRegion region;
  const Vec3 gap = (first.centre - second.centre).cwiseAbs() - first.reach(distance) - second.reach(distance);
  if (gap.maxCoeff() > 0) return region;
  clip_surface(a, second, distance, region);
  clip_surface(b, first, distance, region);
  return region;
}

bool contains(const Hexahedron& outer, const Hexahedron& inner) {
  const Box box(outer);
  const Vec3 middle = box.to_local(inner.corners.colwise().mean().transpose());
  if ((middle.cwiseAbs().array() > box.half.array()).any()) return false;
  for (int k = 0; k < 8; ++k) {
    const Vec3 q = box.to_local(inner.corners.row(k).transpose());
    if ((q.cwiseAbs().array() > box.half.array() + contact_distance).any()) return false;
  }
  return true;
}

namespace {

/// The rectangle in which two parts touch, `along` the axes of one of them: across the axis in which the region is as
/// thin as a contact or, where parts run into each other, through the least of the box.
ContactPatch patch_of(const std::array<Interval, 3>& along, const Box& frame, const Box& a, const Box& b) {
  int thinnest = 0, shallowest = 0;
  for (int i = 1; i < 3; ++i) {
    const auto half = [&](int axis) { return along[static_cast<std::size_t>(axis)].half(); };
    if (half(i) < half(thinnest)) thinnest = i;
    if (half(i) / frame.half[i] < half(shallowest) / frame.half[shallowest]) shallowest = i;
  }
  const bool is_flat = along[static_cast<std::size_t>(thinnest)].half() <= contact_distance / 2;
  const int across = is_flat ? thinnest : shallowest;
  Vec3 middle;
  for (int i = 0; i < 3; ++i) middle[i] = along[static_cast<std::size_t>(i)].middle();
  ContactPatch patch;
  patch.centre = frame.to_world(middle);
  patch.normal = frame.axes.row(across).transpose();
  if ((b.centre - a.centre).dot(patch.normal) < 0) patch.normal = -patch.normal;
  std::size_t side = 0;
  for (int i = 0; i < 3; ++i) {
    if (i == across) continue;
    patch.half_sides[side++] = along[static_cast<std::size_t>(i)].half() * frame.axes.row(i).transpose();
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 corner = patch.centre + corner_sign(static_cast<int>(k), 0) * patch.half_sides[0] +
                        corner_sign(static_cast<int>(k), 1) * patch.half_sides[1];
    patch.local_a[k] = snapped_local(a, corner);
    patch.local_b[k] = snapped_local(b, corner);
  }
  return patch;
}

}  // namespace

FoundAttachment attach(const Hexahedron& a, const Hexahedron& b, const ContactRegion& region, bool a_in_b,
                       bool b_in_a) {
  const Box box_a(a), box_b(b);
  const bool a_smaller = a_in_b || (!b_in_a && box_a.half.norm() <= box_b.half.norm());
  const Box& frame = a_smaller ? box_a : box_b;
  const Box& other = a_smaller ? box_b : box_a;

  std::array<Interval, 3> along;
  std::array<bool, 3> shared{};
  FoundAttachment found{0, {}};
  if (a_in_b || b_in_a) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      shared[axis] = true;
      along[axis] = {-frame.half[static_cast<int>(axis)], frame.half[static_cast<int>(axis)]};
    }
  } else {
    PARSEL_ASSERT(!region.empty(), "parts that meet have a region");
    along = extents(region, frame);
    found.attachment.patch = patch_of(along, frame, box_a, box_b);
    const std::array<Interval, 3> along_other = extents(region, other);
    const std::array<bool, 3> own = symmetric_axes(region, frame), others = symmetric_axes(region, other);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const auto axis = static_cast<std::size_t>(i), theirs = static_cast<std::size_t>(j);
        const double alike = std::abs(frame.axes.row(i).dot(other.axes.row(j)));
        const bool symmetric = alike > parallel && own[axis] && others[theirs];
        const bool covers = alike > leaning && along[axis].half() > covering * frame.half[i] &&
                            along_other[theirs].half() > covering * other.half[j];
        if ((symmetric || covers) && along[axis].half() > distinct_points / 2) shared[axis] = true;
      }
    }
  }

  found.order = static_cast<int>(std::count(shared.begin(), shared.end(), true));
  // Every combination of low and high along the shared normals; the middle along the other axes.
  for (int k = 0; k < 8; ++k) {
    Vec3 point;
    bool wanted = true;
    for (int i = 0; i < 3; ++i) {
      const Interval& interval = along[static_cast<std::size_t>(i)];
      const bool high = corner_sign(k, i) > 0;
      if (shared[static_cast<std::size_t>(i)]) {
        point[i] = high ? interval.high : interval.low;
      } else {
        point[i] = tied_at(interval, i, frame, other);
        wanted = wanted && !high;
      }
    }
    if (!wanted) continue;
    const Vec3 world = frame.to_world(point);
    found.attachment.points.push_back(world);
    found.attachment.local_a.push_back(snapped_local(box_a, world));
    found.attachment.local_b.push_back(snapped_local(box_b, world));
  }
  return found;
}

Vec3 local_on_features(const Hexahedron& box, const Vec3& point) {
  return snapped_local(Box(box), point);
}

RelationKind attachment_kind(int order) {
  constexpr std::array<RelationKind, 4> kinds = {RelationKind::point, RelationKind::line, RelationKind::face,
                                                 RelationKind::volume};
  PARSEL_ASSERT(order >= 0 && order <= 3, "an attachment's order is 0 to 3");
  return kinds[static_cast<std::size_t>(order)];
}

}  // namespace parsel
