// Volumes of unions of a model's parts on scan lines, for the paper's ranking by intersection over union.
//
// A line along x at (y, z) meets every part in at most one interval, so that unions and intersections along it are exact.
// y and z run over 1 to 4 Gauss points between the coordinates at which something begins or ends: exact for boxes, and for
// round parts as good as the points are many.
#pragma once

#include <vector>

#include "core/cad/model.h"

namespace parsel::family {

/// Volumes of the union of parts that are marked in `present`, for two models, and of what both have in common. Cut and
/// meeting parts count as if they were added.
struct Overlap {
  double a = 0, b = 0, both = 0;
  /// Intersection over union; 1 for two empty models.
  double iou() const { return a + b - both > 0 ? both / (a + b - both) : 1; }
};
Overlap overlap(const std::vector<cad::Part>& a, const std::vector<cad::Part>& b, const std::vector<bool>& present,
                int gauss_points = 4);

}  // namespace parsel::family
