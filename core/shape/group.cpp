#include "core/shape/group.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/shape/oriented_box.h"

namespace parsel {
namespace {

/// Rows with row `kept` equal to `direction`, the others as near as possible to what they were.
Mat3 turned_onto(const Mat3& axes, int kept, const Vec3& direction) {
  const int second = (kept + 1) % 3, third = (kept + 2) % 3;
  Mat3 out;
  out.row(kept) = direction.transpose();
  const Vec3 across = axes.row(second).transpose() - direction.dot(axes.row(second).transpose()) * direction;
  out.row(second) = across.normalized().transpose();
  out.row(third) = out.row(kept).cross(out.row(second));
  return out;
}

}  // namespace

Hexahedron group_box(const SymmetryGroup& group, const PartData<Hexahedron>& boxes) {
  const bool is_rotation = group.kind == SymmetryGroup::Kind::rotation;
  Mat3 axes = is_rotation ? Mat3::Identity() : boxes[group.parts.front()].axes;
  Vec3 direction = is_rotation ? group.axis : group.delta.normalized();
  int along = 0;
  (axes * direction).cwiseAbs().maxCoeff(&along);
  if (axes.row(along).dot(direction) < 0) direction = -direction;
  axes = near_global(turned_onto(axes, along, direction));
  (axes * direction).cwiseAbs().maxCoeff(&along);

  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const PartIndex p : group.parts) {
    for (int k = 0; k < 8; ++k) {
      const Vec3 q = axes * boxes[p].corners.row(k).transpose();
      low = low.cwiseMin(q);
      high = high.cwiseMax(q);
    }
  }
  if (is_rotation) {
    const Vec3 centre = axes * group.centre;
    double across = 0;
    for (int i = 0; i < 3; ++i) {
      if (i != along) across = std::max({across, high[i] - centre[i], centre[i] - low[i]});
    }
    for (int i = 0; i < 3; ++i) {
      if (i != along) low[i] = centre[i] - across, high[i] = centre[i] + across;
    }
  }
  return make_box(axes.transpose() * ((low + high) / 2), axes, (high - low) / 2);
}

std::optional<MirrorPair> mirrors_between(const SymmetryGroup& of, const SymmetryGroup& image,
                                          const std::vector<MirrorPair>& mirrors) {
  const auto in = [](const SymmetryGroup& group, PartIndex p) {
    return std::find(group.parts.begin(), group.parts.end(), p) != group.parts.end();
  };
  // Planes are found set by set, so the pairs of two groups share theirs; two groups may mirror about several axes.
  for (const MirrorPair& first : mirrors) {
    const auto links = [&](const MirrorPair& m) {
      return m.axis == first.axis && m.offset == first.offset &&
             ((in(of, m.a) && in(image, m.b)) || (in(of, m.b) && in(image, m.a)));
    };
    if (!links(first)) continue;
    const auto count = static_cast<std::size_t>(std::count_if(mirrors.begin(), mirrors.end(), links));
    if (count == of.parts.size() && count == image.parts.size()) return first;
  }
  return std::nullopt;
}

}  // namespace parsel
