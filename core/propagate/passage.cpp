#include "core/propagate/passage.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/shape/attachment.h"
#include "core/shape/hexahedron.h"
#include "core/shape/hexahedron_extent.h"

namespace parsel {

namespace {

/// What they have in common ends where the inner box does, but along the passage where the outer one does.
std::optional<Passage> passage_through(const Corners& inner, const Corners& outer) {
  const std::optional<int> axis = passage_axis(inner, outer, contact_distance);
  if (!axis) return std::nullopt;
  Passage passage;
  passage.outer_axis = *axis;
  const std::array<Vec3, 3> normals = axes_of(outer).normals, edges = axes_of(inner).edges;
  const Vec3& along = normals[static_cast<std::size_t>(*axis)];
  const auto steeper = [&](const Vec3& a, const Vec3& b) { return std::abs(a.dot(along)) < std::abs(b.dot(along)); };
  passage.axis = static_cast<int>(std::max_element(edges.begin(), edges.end(), steeper) - edges.begin());
  Mat3 rows;
  for (int i = 0; i < 3; ++i) rows.row(i) = normals[static_cast<std::size_t>(i)].transpose();
  const Eigen::FullPivLU<Mat3> solve(rows);
  for (int k = 0; k < 8; ++k) {
    Vec3 levels;
    for (int i = 0; i < 3; ++i) {
      const Extent extent = extent_along(i == *axis ? outer : inner, normals[static_cast<std::size_t>(i)]);
      levels[i] = corner_sign(k, i) > 0 ? extent.high : extent.low;
    }
    const Vec3 point = solve.solve(levels);
    passage.inner[static_cast<std::size_t>(k)] = weights_in(inner, point);
    passage.outer[static_cast<std::size_t>(k)] = weights_in(outer, point);
  }
  return passage;
}

}  // namespace

std::optional<Passage> passage_of(const Corners& first, const Corners& second) {
  if (auto passage = passage_through(first, second)) return passage;
  auto passage = passage_through(second, first);
  if (passage) passage->first_passes = false;
  return passage;
}

PassageChange change_of(const Passage& passage, const Corners& first, const Corners& second) {
  const Corners &inner = passage.first_passes ? first : second, &outer = passage.first_passes ? second : first;
  const Vec3 along = axes_of(inner).edges[static_cast<std::size_t>(passage.axis)];
  PassageChange change;
  for (std::size_t k = 0; k < 8; ++k) {
    const Vec3 moved = interpolate(passage.outer[k], outer) - interpolate(passage.inner[k], inner);
    change.apart = std::max(change.apart, (moved - moved.dot(along) * along).norm());
  }
  const Vec3 through = axes_of(outer).normals[static_cast<std::size_t>(passage.outer_axis)];
  const Extent own = extent_along(outer, through);
  const double length = std::max(own.length(), distinct_points);
  change.lost = std::clamp(1 - common(own, extent_along(inner, through)) / length, 0.0, 1.0);
  return change;
}

}  // namespace parsel
