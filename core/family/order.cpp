#include "core/family/order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace parsel::family {

namespace {

double plane(const Layout& layout, const Values& values, std::size_t part, int axis, int side) {
  return values[static_cast<Eigen::Index>(layout.centre(part, axis))] +
         side * values[static_cast<Eigen::Index>(layout.extent(part, axis))] / 2;
}

double gap(const Layout& layout, const Values& values, const Order& order) {
  return plane(layout, values, order.high_part, order.axis, order.high_side) -
         plane(layout, values, order.low_part, order.axis, order.low_side);
}

}  // namespace

Orders find_orders(const Layout& layout, const cad::Model& model, const Values& base,
                   const std::vector<Variation>& variations, double tolerance) {
  Orders found;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t p = 0; p < model.parts.size(); ++p) {
      for (std::size_t q = p + 1; q < model.parts.size(); ++q) {
        for (const int i : {-1, 1}) {
          for (const int j : {-1, 1}) {
            Order order{axis, p, q, i, j};
            const double apart = gap(layout, base, order);
            if (std::abs(apart) <= tolerance) continue;
            if (apart < 0) order = {axis, q, p, j, i};
            ++found.in_base;
            const bool is_kept = std::all_of(variations.begin(), variations.end(), [&](const Variation& v) {
              return !v.has(p) || !v.has(q) || gap(layout, v.values, order) >= -tolerance;
            });
            if (is_kept) found.kept.push_back(order);
          }
        }
      }
    }
  }
  return found;
}

std::vector<Bound> find_bounds(const Layout& layout, const Orders& orders, const Basis& basis,
                               const Eigen::Vector3d& pins, const Values& base,
                               const std::vector<Variation>& variations, double tolerance) {
  std::vector<Bound> bounds;
  std::map<std::vector<double>, std::size_t> known;  // to the index of the bound
  const auto add = [&](const Form& form, double at_least, Stop stop, std::size_t p, std::size_t q) {
    Bound bound;
    bound.form = Eigen::VectorXd::Zero(basis.matrix.cols());
    bound.constant = -at_least;
    for (const Term& term : form) {
      const auto row = static_cast<Eigen::Index>(term.parameter);
      bound.form += term.halves / 2.0 * basis.matrix.row(row).transpose();
      bound.constant += term.halves / 2.0 * basis.pin_matrix.row(row).dot(pins);
    }
    if (bound.form.cwiseAbs().maxCoeff() < 1e-12) return;
    std::vector<double> key(bound.form.data(), bound.form.data() + bound.form.size());
    key.push_back(bound.constant);
    for (double& entry : key) entry = std::round(entry / 1e-9);
    bound.stop = std::move(stop);
    const auto [entry, is_new] = known.emplace(std::move(key), bounds.size());
    if (is_new) bounds.push_back(std::move(bound));
    bounds[entry->second].parts.push_back({p, q});
  };
  if (basis.free.empty()) return bounds;
  for (const Order& order : orders.kept) {
    Form form = plane_form(layout, order.high_part, order.axis, order.high_side);
    for (const Term& term : plane_form(layout, order.low_part, order.axis, order.low_side)) {
      form.push_back({term.parameter, -term.halves});
    }
    add(form, 0, {order, 0}, order.low_part, order.high_part);
  }
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (layout.parameters[i].quantity == Quantity::centre) continue;
    double least = base[static_cast<Eigen::Index>(i)];
    for (const Variation& variation : variations) {
      if (variation.has(layout.parameters[i].part))
        least = std::min(least, variation.values[static_cast<Eigen::Index>(i)]);
    }
    const std::size_t part = layout.parameters[i].part;
    add({{i, 2}}, std::max(least / 100, tolerance), {std::nullopt, i}, part, part);
  }
  return bounds;
}

bool Bound::counts(const std::vector<bool>& present) const {
  return present.empty() || std::any_of(parts.begin(), parts.end(),
                                        [&](const auto& pair) { return present[pair[0]] && present[pair[1]]; });
}

Interval interval(const std::vector<Bound>& bounds, const Eigen::VectorXd& free_values, std::size_t slider,
                  const std::vector<bool>& present) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Interval made{-infinite, infinite, {}, {}};
  const auto s = static_cast<Eigen::Index>(slider);
  for (const Bound& bound : bounds) {
    const double slope = bound.form[s];
    if (std::abs(slope) < 1e-12 || !bound.counts(present)) continue;
    const double rest = bound.form.dot(free_values) - slope * free_values[s] + bound.constant;
    const double at = -rest / slope;
    if (slope > 0 && at > made.low) {
      made.low = at;
      made.low_stop = bound.stop;
    }
    if (slope < 0 && at < made.high) {
      made.high = at;
      made.high_stop = bound.stop;
    }
  }
  return made;
}

}  // namespace parsel::family
