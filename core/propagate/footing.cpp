#include "core/propagate/footing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/tolerance.h"
#include "core/shape/hexahedron.h"

namespace parsel {

namespace {

/// A seed that takes a part through the floor, or a foot off it, by more than this has no use for the floor; and what
/// is this near the lowest of a shape that could not stand is its foot. Half-diagonals: the distance within which parts
/// touch.
constexpr double floor_distance = 0.01;
/// What a ground relation asks of its part.
Footing footing_of(const Ground& ground) {
  Footing footing;
  for (const Vec3& local : ground.local) footing.points.push_back(trilinear_weights(local));
  return footing;
}

/// The part's lowest corners.
Footing footing_of(const Corners& corners) {
  const double lowest = corners.col(1).minCoeff();
  Footing footing;
  for (int k = 0; k < 8; ++k) {
    if (corners(k, 1) > lowest + floor_distance) continue;
    Weights weights = Weights::Zero();
    weights[k] = 1;
    footing.points.push_back(weights);
  }
  return footing;
}

double area_on_floor(const Vec3& low, const Vec3& high) {
  return (high.x() - low.x()) * (high.z() - low.z());
}

}  // namespace

Feet find_feet(const Graph& graph, const ResolvedRequest& request, const Edits& seeds) {
  const Shape& shape = graph.shape();
  Feet feet;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Part& part : shape.parts) {
    low = low.cwiseMin(part.hexahedron.corners.colwise().minCoeff().transpose());
    high = high.cwiseMax(part.hexahedron.corners.colwise().maxCoeff().transpose());
  }
  const double floor = low.y();
  bool could_stand = false;
  for (const RelationIndex r : shape.relations.indices()) {
    const auto* ground = std::get_if<Ground>(&shape.relations[r].detail);
    if (ground == nullptr) continue;
    could_stand = true;
    const bool counts = request.disabled.count(r) == 0 && is_active(shape, r, request.dissolved);
    if (counts) feet.emplace(shape.relations[r].parts[0], footing_of(*ground));
  }
  for (const PartIndex part : graph.parts()) {
    const Corners& corners = shape.parts[part].hexahedron.corners;
    if (!could_stand && corners.col(1).minCoeff() <= floor + floor_distance) feet.emplace(part, footing_of(corners));
  }
  const double extent = std::max(area_on_floor(low, high), noise);
  for (auto& [part, footing] : feet) {
    const Corners& corners = shape.parts[part].hexahedron.corners;
    footing.share = area_on_floor(corners.colwise().minCoeff(), corners.colwise().maxCoeff()) / extent;
  }
  for (const PartIndex part : graph.parts()) {
    if (!seeds[part]) continue;
    const Corners& rest = shape.parts[part].hexahedron.corners;
    for (const Corners& motion : {seeds[part]->motion.front(), seeds[part]->motion.back()}) {
      const double bottom = (rest + motion).col(1).minCoeff();
      if (bottom < floor - floor_distance || (feet.count(part) > 0 && bottom > floor + floor_distance)) return {};
    }
  }
  return feet;
}

double price_of_footing(const Prices& prices, const Footing& footing, const Motion& motion) {
  double off = 0;
  bool dragged = false;
  for (const std::size_t s : {std::size_t{0}, sample_count - 1}) {
    Vec3 mean = Vec3::Zero();
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Weights& point : footing.points) {
      Vec3 moved = interpolate(point, motion[s]);
      off = std::max(off, moved.cwiseProduct(footing.mask).cwiseAbs().maxCoeff());
      moved.y() = 0;
      least = std::min(least, moved.norm());
      most = std::max(most, moved.norm());
      mean += moved / static_cast<double>(footing.points.size());
    }
    // What stretches to both sides, or away from where it stands, is not dragged, also when no point of it stays quite
    // where it was.
    dragged = dragged || (most > exact && std::min(least, mean.norm()) >= most / 2);
  }
  return (off > exact ? prices.broken_ground + prices.broken_by * std::min(off, 0.2) : 0) +
         (dragged ? prices.dragged * footing.share : 0);
}

}  // namespace parsel
