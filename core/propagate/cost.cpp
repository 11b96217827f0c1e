#include "core/propagate/cost.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"

namespace parsel {

namespace {

/// A part that is stretched by more than this factor is distorted.
constexpr double largest_stretch = 2.5;
constexpr double distorted = 3;
/// Of an axis as long as the part, and on top for one that is thin beside it: legs get longer before they get thicker. At 2
/// the ends of a box whose sides get longer get thicker, as they run into the sides; at 4 three edits of 240 come apart.
constexpr double strain_along = 0.3, strain_across = 3;
/// Points and axes of another part: dearer than its own of the same kind.
constexpr double price_of_borrowing = 0.5;

double edge_length(const Corners& corners, int axis, int k) {
  return (corners.row(k | (1 << axis)) - corners.row(k)).norm();
}

/// |log| of the largest stretch among the four edges along a local axis.
double largest_change(const Corners& rest, const Corners& deformed, int axis) {
  double most = 0;
  for (int k = 0; k < 8; ++k) {
    if (corner_sign(k, axis) > 0) continue;
    const double before = std::max(edge_length(rest, axis, k), noise);
    const double after = std::max(edge_length(deformed, axis, k), noise);
    most = std::max(most, std::abs(std::log(after / before)));
  }
  return most;
}

}  // namespace

double price_of_kind(const Prices& prices, const Candidate& candidate, bool fills) {
  const bool whole = candidate.what.feature == LocalTriple{0, 0, 0};
  double price = 0.6;
  if (!is_geometric(candidate.what.op)) {
    price = fills ? 1.0 : 0.4;
  } else if (whole && candidate.what.op == Op::translate) {
    price = 0.2;
  } else if (whole && candidate.what.op == Op::rotate) {
    price = 0.4;
  } else if (candidate.symmetry_cost == 1) {
    price = 0.9;
  } else if (candidate.symmetry_cost >= 2) {
    price = prices.slant;
  }
  return price + (candidate.from_neighbour ? price_of_borrowing : 0);
}

double price_of_strain(const Corners& rest, const Corners& deformed) {
  Vec3 lengths;
  for (int axis = 0; axis < 3; ++axis) lengths[axis] = edge_length(rest, axis, 0);
  const double longest = std::max(lengths.maxCoeff(), noise);
  double price = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double change = largest_change(rest, deformed, axis);
    price += change * (strain_along + strain_across * (1 - lengths[axis] / longest));
    if (change > std::log(largest_stretch)) price += distorted;
  }
  return price;
}

bool is_distorted(const Corners& rest, const Corners& deformed) {
  for (int axis = 0; axis < 3; ++axis) {
    if (largest_change(rest, deformed, axis) > std::log(largest_stretch)) return true;
  }
  return false;
}

double price_of_relation(const Prices& prices, const Relation& relation, double residual, double tolerance,
                         const RelationState& state) {
  if (relation.is_symmetry()) {
    if (residual <= exact) return residual;
    const auto* mirror = std::get_if<Reflection>(&relation.detail);
    const bool stacked = mirror != nullptr && std::abs(mirror->normal.y()) > 0.5;
    const double broken = stacked                  ? prices.broken_stacked_mirror
                          : state.is_asked_to_move ? prices.broken_asked_mirror
                                                   : prices.broken_mirror;
    const double slack = state.is_asked_to_move ? prices.asked_mirror_slack : prices.slack;
    return residual <= tolerance ? std::min(broken, slack * residual) : broken;
  }
  const std::optional<ContactChange>& change = state.contact;
  const double off = change ? std::abs(change->apart) : 0;
  const auto price_of_seeing = [&](double by) {
    return by > unseen ? std::min(prices.seen_most, prices.seen + prices.seen_by * (by - unseen)) : 0;
  };
  const double stepped = change ? change->stepped : 0;
  const double seen = price_of_seeing(std::max(off, stepped));
  if (residual <= exact) return residual + seen;
  if (change && off <= unseen && change->lost <= most_lost) {
    const double slides =
        (state.is_asked_to_shift ? prices.asked_slide : prices.slide) + prices.slide_lost * change->lost + seen;
    return residual <= tolerance ? std::min(slides, prices.slack * residual) : slides;
  }
  if (residual <= tolerance) return prices.slack * residual + seen;
  if (change && change->hinged) return state.is_asked_to_turn ? prices.hinge : prices.unasked_hinge;
  return prices.broken_joint + prices.broken_by * std::min(residual, 0.2);
}

}  // namespace parsel
