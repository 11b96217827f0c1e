#include "core/shape/symmetry_search.h"

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/tolerance.h"

namespace parsel {

Parts SymmetrySearch::free_of(const Parts& parts) const {
  Parts free;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(free), [&](PartIndex p) { return is_free(p); });
  return free;
}

void SymmetrySearch::add_group(SymmetryGroup group) {
  for (const PartIndex p : group.parts) group_of_[p] = found.groups.size();
  found.groups.push_back(std::move(group));
}

bool SymmetrySearch::same_extents(PartIndex a, PartIndex b) const {
  return (congruence.half_extents(a) - congruence.half_extents(b)).cwiseAbs().maxCoeff() <= options.position;
}

bool SymmetrySearch::same_size(PartIndex a, PartIndex b) const {
  Vec3 ea = boxes[a].half_extents(), eb = boxes[b].half_extents();
  std::sort(ea.begin(), ea.end());
  std::sort(eb.begin(), eb.end());
  const double area_a = congruence.area(a), area_b = congruence.area(b);
  return (ea - eb).cwiseAbs().maxCoeff() <= options.position &&
         std::abs(area_a - area_b) <= options.area * std::max(area_a, area_b);
}

bool SymmetrySearch::mirrors(PartIndex a, PartIndex b, int axis, double offset) {
  Vec3 image = centre(a);
  image[axis] = 2 * offset - image[axis];
  return (image - centre(b)).norm() <= options.image && same_extents(a, b) &&
         congruence.carries(a, b, mirror_matrix(axis));
}

Mat3 mirror_matrix(int axis) {
  Mat3 m = Mat3::Identity();
  m(axis, axis) = -1;
  return m;
}

Mat3 turn(const Vec3& axis, std::size_t k, std::size_t n) {
  const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(n);
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace parsel
