// Orders of parallel planes that the base has and no variation turns round: the inequalities that ReparamCAD's families lack
// (§3.5: "we do not have bounds on this space"). They stop a slider before the shelf meets the floor, and say so.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/family/basis.h"

namespace parsel::family {

/// Face `low` of one part lies below face `high` of another along the axis.
struct Order {
  int axis = 0;
  std::size_t low_part = 0, high_part = 0;
  int low_side = -1, high_side = -1;
};

struct Orders {
  std::size_t in_base = 0;  ///< pairs of planes of different parts that lie strictly apart in the base
  std::vector<Order> kept;  ///< those that no variation which has both parts turns round; the planes may meet in one
};

/// All six planes of every part count, those that bound round parts as well.
Orders find_orders(const Layout& layout, const cad::Model& model, const Values& base,
                   const std::vector<Variation>& variations, double tolerance);

/// What keeps a slider from going on: an order, or a size that would fall below its least.
struct Stop {
  std::optional<Order> order;
  std::size_t parameter = 0;  ///< the size, where there is no order
};

/// One linear inequality on the free parameters: form · free + constant ≥ 0.
struct Bound {
  Eigen::VectorXd form;
  double constant = 0;
  Stop stop;
  /// The pairs of parts that it speaks of (a size: the part twice): without one of each it says nothing.
  std::vector<std::array<std::size_t, 2>> parts;

  /// Whether it counts when these parts are there; empty: all.
  bool counts(const std::vector<bool>& present) const;
};

/// The orders and the least sizes (a hundredth of the smallest value in the base and the variations) in terms of the
/// free parameters; equal ones once, and none that no slider changes.
std::vector<Bound> find_bounds(const Layout& layout, const Orders& orders, const Basis& basis,
                               const Eigen::Vector3d& pins, const Values& base,
                               const std::vector<Variation>& variations, double tolerance);

/// How far a free parameter may go with the others as they are and the parts that are there (empty: all). Infinite where
/// nothing stops it; empty (low > high)
/// where a bound is broken whatever it does.
struct Interval {
  double low = 0, high = 0;
  std::optional<Stop> low_stop, high_stop;
};
Interval interval(const std::vector<Bound>& bounds, const Eigen::VectorXd& free_values, std::size_t slider,
                  const std::vector<bool>& present = {});

}  // namespace parsel::family
