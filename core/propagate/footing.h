// What the floor asks of the parts that stand on it: a term of the cost (cost.h).
#pragma once

#include <map>
#include <vector>

#include "core/propagate/constraints.h"
#include "core/propagate/cost.h"
#include "core/propagate/edit_request.h"

namespace parsel {

/// What the floor asks of a part that stands on it.
struct Footing {
  std::vector<Weights> points;  ///< its lowest, by their weights in its hexahedron
  Vec3 mask = Vec3::UnitY();    ///< the directions in which they stay
  double share = 0;             ///< of the shape's extent on the floor, as areas
};
using Feet = std::map<PartIndex, Footing>;

/// Parts that stand on the floor, by the ground relations that count. Of a shape that has none, as it hangs or leans,
/// what is lowest: without an end that stays, the rod of a ceiling fan is left behind by what hangs on it. None where
/// a seed itself takes a part off the floor or through it: then the request has no floor, and the parts that follow
/// are not to blame. `seeds`: the edits of the seed parts alone.
Feet find_feet(const Graph& graph, const ResolvedRequest& request, const Edits& seeds);

/// Leaving the floor or sinking into it, and being moved to another place on it.
double price_of_footing(const Prices& prices, const Footing& footing, const Motion& motion);

}  // namespace parsel
