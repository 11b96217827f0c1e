#include "core/propagate/contact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/shape/hexahedron.h"
#include "core/shape/hexahedron_extent.h"

namespace parsel {

namespace {

/// Boxes that overlap by more than this share of the thinner one's extent along every axis lie in each other: a seat on
/// its legs overlaps less, a shelf in the one box of a whole cabinet more.
constexpr double deep = 0.6;

using Frame3 = std::array<Vec3, 3>;

Frame3 face_normals(const Corners& corners) {
  return axes_of(corners).normals;
}

Mat3 as_columns(const Frame3& normals) {
  Mat3 columns;
  for (int axis = 0; axis < 3; ++axis) columns.col(axis) = normals[static_cast<std::size_t>(axis)];
  return columns;
}

/// Fills in the rectangle that the boxes have in common across the contact's normal.
void add_rectangle(Contact& contact, const Corners& first, const Corners& second) {
  const Frame3 normals = face_normals(contact.of_first ? first : second);
  const auto along = [&](int i) { return static_cast<std::size_t>((contact.axis + i) % 3); };
  std::array<Extent, 2> shared;
  for (int i = 0; i < 2; ++i) {
    const Vec3& tangent = normals[along(1 + i)];
    const Extent of_first = extent_along(first, tangent), of_second = extent_along(second, tangent);
    shared[static_cast<std::size_t>(i)] = {std::max(of_first.low, of_second.low),
                                           std::min(of_first.high, of_second.high)};
  }
  const Vec3& normal = normals[along(0)];
  const Extent a = extent_along(first, normal), b = extent_along(second, normal);
  const double level = contact.side > 0 ? (a.high + b.low) / 2 : (a.low + b.high) / 2;
  Mat3 rows;
  for (int i = 0; i < 3; ++i) rows.row(i) = normals[along(i)].transpose();
  const Eigen::FullPivLU<Mat3> solve(rows);
  for (std::size_t k = 0; k < 4; ++k) {
    const bool far_0 = k == 1 || k == 2, far_1 = k >= 2;  // around the rectangle
    const Vec3 point =
        solve.solve(Vec3(level, far_0 ? shared[0].high : shared[0].low, far_1 ? shared[1].high : shared[1].low));
    contact.rectangle_first[k] = weights_in(first, point);
    contact.rectangle_second[k] = weights_in(second, point);
  }
  contact.thickness = std::min(thickness(first), thickness(second));
  contact.normals_first = as_columns(face_normals(first));
  contact.normals_second = as_columns(face_normals(second));
}

/// A turn by less than this, in radians, is none.
constexpr double least_turn = 1e-3;

/// Whether the boxes have turned about an edge of what they had in common.
bool is_hinged(const Contact& contact, const Corners& first, const Corners& second) {
  const Mat3 turn_first = as_columns(face_normals(first)) * contact.normals_first.transpose();
  const Mat3 turn_second = as_columns(face_normals(second)) * contact.normals_second.transpose();
  const double cosine = ((turn_first.transpose() * turn_second).trace() - 1) / 2;
  const double turn = std::acos(std::clamp(cosine, -1.0, 1.0));
  if (turn < least_turn) return false;
  // A point at a distance r of the axis has moved by 2 r sin(turn/2).
  const double most = 2 * std::sin(turn / 2) * contact.thickness;
  std::array<bool, 4> stays{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 apart =
        interpolate(contact.rectangle_first[k], first) - interpolate(contact.rectangle_second[k], second);
    stays[k] = apart.norm() <= most;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    if (stays[k] && stays[(k + 1) % 4]) return true;
  }
  return false;
}

}  // namespace

std::optional<Contact> contact_of(const Corners& first, const Corners& second) {
  std::optional<Contact> best;
  double least = 0;
  for (const bool of_first : {true, false}) {
    const Frame3 normals = face_normals(of_first ? first : second);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3& normal = normals[static_cast<std::size_t>(axis)];
      const Extent a = extent_along(first, normal), b = extent_along(second, normal);
      const double overlap = common(a, b);
      if (overlap > deep * std::min(a.length(), b.length())) continue;
      if (best && overlap >= least - 1e-9) continue;
      least = overlap;
      best.emplace();
      best->of_first = of_first;
      best->axis = axis;
      best->side = b.middle() >= a.middle() ? 1 : -1;
      best->distance = -overlap;
      for (int i = 0; i < 2; ++i) {
        const Vec3& tangent = normals[static_cast<std::size_t>((axis + 1 + i) % 3)];
        best->cover[static_cast<std::size_t>(i)] =
            std::max(0.0, common(extent_along(first, tangent), extent_along(second, tangent)));
      }
    }
  }
  if (best) add_rectangle(*best, first, second);
  return best;
}

ContactChange change_of(const Contact& contact, const Corners& first, const Corners& second) {
  const Frame3 normals = face_normals(contact.of_first ? first : second);
  const Vec3& normal = normals[static_cast<std::size_t>(contact.axis)];
  const Extent a = extent_along(first, normal), b = extent_along(second, normal);
  const double distance = contact.side > 0 ? b.low - a.high : a.low - b.high;
  ContactChange change{distance - contact.distance, 0, is_hinged(contact, first, second)};
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3& tangent = normals[(static_cast<std::size_t>(contact.axis) + 1 + i) % 3];
    const Extent along_a = extent_along(first, tangent), along_b = extent_along(second, tangent);
    // A smaller part that is narrowed covers less and has lost nothing.
    const double possible = std::min({contact.cover[i], along_a.length(), along_b.length()});
    if (possible < 1e-9) continue;
    const double now = std::clamp(common(along_a, along_b), 0.0, possible);
    change.lost = std::max(change.lost, 1 - now / possible);
  }
  return change;
}

JointContact contact_of_joint(const Shape& shape, const Relation& attachment) {
  const Hexahedron &first = shape.parts[attachment.parts[0]].hexahedron,
                   &second = shape.parts[attachment.parts[1]].hexahedron;
  JointContact contact{contact_of(first.corners, second.corners), std::nullopt, std::nullopt};
  const auto& points = std::get<Attachment>(attachment.detail).contact_points;
  if (!points.empty()) contact.surfaces.emplace(points, first, second);
  if (!contact.boxes) contact.passage = passage_of(first.corners, second.corners);
  return contact;
}

namespace {

std::optional<ContactChange> change_of(const JointContact& contact, const Corners& first, const Corners& second) {
  const bool is_known = contact.boxes || contact.passage || (contact.surfaces && contact.surfaces->lie_against());
  if (!is_known) return std::nullopt;
  ContactChange change;
  if (contact.boxes) change = change_of(*contact.boxes, first, second);
  if (contact.passage) {
    const PassageChange through = change_of(*contact.passage, first, second);
    change.apart = through.apart;
    change.lost = through.lost;
  }
  if (contact.surfaces) {
    const ContactShift shift = contact.surfaces->shift(first, second);
    if (contact.surfaces->lie_against()) change.apart = shift.apart;
    if (!contact.boxes && !contact.passage) change.lost = shift.lost;
    change.stepped = shift.stepped;
  }
  return change;
}

}  // namespace

std::optional<ContactChange> worst_change(const JointContact& contact, const Corners& first, const Motion& of_first,
                                          const Corners& second, const Motion& of_second) {
  auto worst = change_of(contact, first + of_first.front(), second + of_second.front());
  const auto other = change_of(contact, first + of_first.back(), second + of_second.back());
  if (!worst || !other) return std::nullopt;
  if (std::abs(other->apart) > std::abs(worst->apart)) worst->apart = other->apart;
  worst->stepped = std::max(worst->stepped, other->stepped);
  worst->lost = std::min(worst->lost, other->lost);
  worst->hinged = worst->hinged && other->hinged;
  return worst;
}

}  // namespace parsel
