#include "core/split/form.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace parsel::split {
namespace {

/// A panel is thinner than this share of its second side; a bar's section is below this share of its length.
constexpr double thin = 0.3, slim = 0.4;
/// A direction is along the vertical when its cosine with it is above `along` (25°), level when below `across` (25°).
constexpr double along = 0.906, across = 0.423;

/// Axes of the box with their full lengths, longest first.
std::array<int, 3> longest_first(const Vec3& half) {
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return half[a] > half[b] * (1 + 1e-6); });
  return order;
}

}  // namespace

std::string form_name(const Hexahedron& box) {
  const Vec3 half = box.half_extents();
  const std::array<int, 3> order = longest_first(half);
  const double rise_of_longest = std::abs(box.axes(order[0], 1)), rise_of_normal = std::abs(box.axes(order[2], 1));
  if (half[order[1]] < slim * half[order[0]]) {
    return rise_of_longest > along ? "post" : rise_of_longest < across ? "rail" : "slanted bar";
  }
  if (half[order[2]] < thin * half[order[1]]) {
    return rise_of_normal > along ? "board" : rise_of_normal < across ? "upright panel" : "slanted panel";
  }
  return "block";
}

bool same_size(const Hexahedron& a, const Hexahedron& b) {
  Vec3 p = a.half_extents(), q = b.half_extents();
  std::sort(p.begin(), p.end());
  std::sort(q.begin(), q.end());
  return ((p - q).cwiseAbs().array() <= 0.02 * p.cwiseMax(q).array()).all();
}

}  // namespace parsel::split
