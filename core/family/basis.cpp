#include "core/family/basis.h"

#include <algorithm>
#include <numeric>
#include <set>

namespace parsel::family {

namespace {

double volume(const cad::Part& part) {
  return part.size.prod();
}

SparseRow row_of(const Form& form) {
  SparseRow row;
  for (const Term& term : form) row[term.parameter] = Rational(term.halves, 2);
  return row;
}

/// The sooner, the rather a pivot: centres, then sizes of small parts before those of big ones; of parts alike the later
/// ones stay free last, so that the first leg speaks for all. Tops stay free.
std::vector<std::size_t> preference(const Layout& layout, const cad::Model& model, std::size_t pinned) {
  std::vector<std::size_t> order(layout.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) { return static_cast<int>(layout.parameters[i].quantity); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (rank(a) != rank(b)) return rank(a) < rank(b);
    const std::size_t p = layout.parameters[a].part, q = layout.parameters[b].part;
    if ((p == pinned) != (q == pinned)) return q == pinned;
    const double small = volume(model.parts[p]), big = volume(model.parts[q]);
    if (std::abs(small - big) > 1e-9 * std::max(small, big)) return small < big;
    return p > q;
  });
  std::vector<std::size_t> place(layout.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  return place;
}

}  // namespace

Pins find_pins(const Layout& layout, const cad::Model& model, const std::vector<Constraint>& constraints,
               const std::vector<Evidence>& evidence, const std::vector<Variation>& variations) {
  const auto is_always_there = [&](std::size_t part) {
    return std::all_of(variations.begin(), variations.end(), [&](const Variation& v) { return v.has(part); });
  };
  // Sizes that are equal tie nothing to its place.
  std::vector<std::set<std::size_t>> tied(model.parts.size());
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (!evidence[i].is_kept || constraints[i].kind == ConstraintKind::equal) continue;
    tied[constraints[i].a.part].insert(constraints[i].b.part);
    tied[constraints[i].b.part].insert(constraints[i].a.part);
  }
  Pins pins;
  const auto underside = [&](std::size_t p) { return model.parts[p].centre.y() - model.parts[p].size.y() / 2; };
  bool is_first = true;
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    if (!is_always_there(p) || model.parts[p].role != cad::Role::add) continue;
    const auto key = [&](std::size_t q) { return std::pair(tied[q].size(), volume(model.parts[q])); };
    if (is_first || key(p) > key(pins.part)) pins.part = p;
    if (is_first || underside(p) < underside(pins.lowest) - 1e-12) pins.lowest = p;
    is_first = false;
  }
  pins.forms = {Form{{layout.centre(pins.part, 0), 2}}, Form{{layout.centre(pins.part, 2), 2}},
                plane_form(layout, pins.lowest, 1, -1)};
  return pins;
}

Eigen::VectorXd Basis::free_values(const Values& values) const {
  Eigen::VectorXd made(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    made[static_cast<Eigen::Index>(i)] = values[static_cast<Eigen::Index>(free[i])];
  }
  return made;
}

Result<Basis> find_basis(const Layout& layout, const cad::Model& model, const std::vector<Constraint>& constraints,
                         const std::vector<Evidence>& evidence, const Pins& pins) {
  const std::size_t n = layout.size();
  // The values of the pinned forms are three columns more, never pivots: translations satisfy every constraint.
  std::vector<std::size_t> order = preference(layout, model, pins.part);
  for (std::size_t k = 0; k < 3; ++k) order.push_back(n + k);
  Elimination elimination(std::move(order));
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    if (!evidence[i].is_kept) continue;
    for (const SparseRow& row : constraints[i].rows()) elimination.add(row);
  }
  Basis basis;
  basis.rank = elimination.rank();
  for (std::size_t k = 0; k < 3; ++k) {
    SparseRow row = row_of(pins.forms[k]);
    row[n + k] = Rational(-1);
    elimination.add(row);
  }
  if (elimination.is_lost()) {
    return Error{"family/basis", "", "the constraints' coefficients do not fit 64-bit fractions",
                 "keep fewer constraints"};
  }
  std::vector<std::size_t> index(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    if (elimination.rows().count(i) > 0) continue;
    index[i] = basis.free.size();
    basis.free.push_back(i);
  }
  basis.coefficients.assign(n, std::vector<Rational>(basis.free.size()));
  basis.pinned.assign(n, {});
  for (std::size_t i = 0; i < n; ++i) {
    if (index[i] < n) {
      basis.coefficients[i][index[i]] = Rational(1);
      continue;
    }
    for (const auto& [column, coefficient] : elimination.rows().at(i)) {
      if (column == i) continue;
      (column < n ? basis.coefficients[i][index[column]] : basis.pinned[i][column - n]) = -coefficient;
    }
  }
  const auto rows = static_cast<Eigen::Index>(n), columns = static_cast<Eigen::Index>(basis.free.size());
  basis.matrix.resize(rows, columns);
  basis.pin_matrix.resize(rows, 3);
  for (std::size_t i = 0; i < n; ++i) {
    const auto r = static_cast<Eigen::Index>(i);
    for (std::size_t j = 0; j < basis.free.size(); ++j) {
      basis.matrix(r, static_cast<Eigen::Index>(j)) = basis.coefficients[i][j].value();
    }
    for (std::size_t k = 0; k < 3; ++k) basis.pin_matrix(r, static_cast<Eigen::Index>(k)) = basis.pinned[i][k].value();
  }
  return basis;
}

Eigen::Vector3d pin_values(const Pins& pins, const Values& values) {
  return {value_of(pins.forms[0], values), value_of(pins.forms[1], values), value_of(pins.forms[2], values)};
}

Values pinned_to(const Layout& layout, const Pins& pins, const Eigen::Vector3d& at, Values values) {
  const Eigen::Vector3d off = at - pin_values(pins, values);
  const Eigen::Vector3d by(off[0], off[2], off[1]);
  for (std::size_t p = 0; p < layout.first.size(); ++p) {
    for (int axis = 0; axis < 3; ++axis) values[static_cast<Eigen::Index>(layout.centre(p, axis))] += by[axis];
  }
  return values;
}

}  // namespace parsel::family
