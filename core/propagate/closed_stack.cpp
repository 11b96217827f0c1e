#include "core/propagate/closed_stack.h"

#include <cmath>

#include "core/edit/group_edit.h"
#include "core/propagate/motion.h"

namespace parsel {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

namespace {

constexpr long length_steps = 10'000'000;
constexpr double negligible = 1e-6;

/// Numbers that are no rationals become such, of nine digits.
struct Rational : public GiNaC::map_function {
  ex operator()(const ex& e) override {
    if (!is_a<numeric>(e)) return e.map(*this);
    const numeric& number = ex_to<numeric>(e);
    if (number.is_rational()) return e;
    const double value = number.to_double();
    if (value == 0 || !std::isfinite(value)) return 0;
    const double scale = std::pow(10.0, 9 - std::ceil(std::log10(std::abs(value))));
    if (scale > 1e17) return 0;
    return scale >= 1 ? numeric(std::lround(value * scale)) / numeric(std::lround(scale)) : numeric(std::lround(value));
  }
};

ex rational(const ex& e) {
  Rational map;
  return map(e);
}

ClosedVector closed(const Vec3& v) {
  return {closed_length(v.x()), closed_length(v.y()), closed_length(v.z())};
}

ClosedVector minus(const ClosedVector& a, const ClosedVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

void add(ClosedVector& a, const ex& s, const ClosedVector& b) {
  for (std::size_t c = 0; c < 3; ++c) a[c] += s * b[c];
}

void clean(ClosedVector& v) {
  for (ex& coordinate : v) coordinate = cleaned(coordinate);
}

/// Unit vectors have more decimals than lengths: an axis that is almost along the frame's is not turned into it.
ClosedVector closed_unit(const Vec3& v) {
  ClosedVector unit;
  for (int c = 0; c < 3; ++c) unit[static_cast<std::size_t>(c)] = rational(numeric(v[c]));
  return unit;
}

double coefficient_of(const ex& term) {
  if (is_a<numeric>(term)) return ex_to<numeric>(term).to_double();
  if (!is_a<GiNaC::mul>(term)) return 1;
  for (std::size_t i = 0; i < term.nops(); ++i) {
    if (is_a<numeric>(term.op(i))) return ex_to<numeric>(term.op(i)).to_double();
  }
  return 1;
}

}  // namespace

ex closed_length(double value) {
  return numeric(std::lround(value * static_cast<double>(length_steps)), length_steps);
}

ex cleaned(const ex& e) {
  const ex expanded = e.expand();
  if (!is_a<GiNaC::add>(expanded)) return std::abs(coefficient_of(expanded)) < negligible ? ex(0) : expanded;
  GiNaC::exvector kept;
  for (std::size_t i = 0; i < expanded.nops(); ++i) {
    if (std::abs(coefficient_of(expanded.op(i))) >= negligible) kept.push_back(expanded.op(i));
  }
  return kept.size() == expanded.nops() ? expanded : ex(GiNaC::add(kept));
}

ClosedPart ClosedStack::at_rest(PartIndex p) const {
  const Part& part = shape_.parts[p];
  ClosedPart rest;
  for (std::size_t k = 0; k < 8; ++k)
    rest.corners[k] = closed(part.hexahedron.corners.row(static_cast<int>(k)).transpose());
  if (!part.is_virtual()) return rest;
  const Relation& relation = shape_.relations[*part.group];
  ClosedGroup group;
  if (const auto* line = std::get_if<Translation>(&relation.detail)) {
    group.start = closed(line->start);
    group.end = closed(line->end);
    group.gaps = static_cast<long>(relation.parts.size()) - 1;
  } else if (const auto* ring = std::get_if<Rotation>(&relation.detail)) {
    group.centre = closed(ring->centre);
    group.radius = closed_length(ring->radius);
  }
  rest.group = std::move(group);
  return rest;
}

const ClosedPart* ClosedStack::part(PartIndex p, std::size_t count) {
  const auto found = known_.find({p, count});
  if (found != known_.end()) return found->second ? &*found->second : nullptr;
  std::optional<ClosedPart> state;
  if (count == 0) {
    state = at_rest(p);
  } else if (const ClosedPart* before = part(p, count - 1)) {
    const Part& of = shape_.parts[p];
    std::vector<const Statement*> statements;
    for (const Statement& statement : layers_[count - 1].statements) {
      if (statement.op == Op::keep_fixed) continue;
      const auto target = part_of(shape_, statement);
      const bool by_parent = of.group && !of.is_virtual() && target == parent_of(shape_.relations[*of.group]);
      if (target == p || by_parent) statements.push_back(&statement);
    }
    state = statements.empty() ? *before : after(p, *before, statements, count - 1);
  }
  const auto& kept = known_.emplace(std::pair{p, count}, std::move(state)).first->second;
  return kept ? &*kept : nullptr;
}

std::optional<ClosedVector> ClosedStack::point(const PointReference& reference, std::size_t layer) {
  if (const auto* literal = std::get_if<Vec3>(&reference)) return closed(*literal);
  const auto& named = std::get<PartPoint>(reference);
  const auto p = shape_.find_part(named.part);
  const ClosedPart* state = p ? part(*p, layer) : nullptr;
  if (state == nullptr) return std::nullopt;
  ClosedVector sum = {0, 0, 0};
  long count = 0;
  for (int k = 0; k < 8; ++k) {
    if (!selects(named.at, k)) continue;
    add(sum, 1, state->corners[static_cast<std::size_t>(k)]);
    ++count;
  }
  for (ex& coordinate : sum) coordinate = cleaned(coordinate / count);
  return sum;
}

std::optional<ClosedVector> ClosedStack::unit_axis(PartIndex p, const ClosedCorners& corners, int axis) const {
  ClosedVector along = {0, 0, 0};
  for (int k = 0; k < 8; ++k) add(along, numeric(corner_sign(k, axis), 4), corners[static_cast<std::size_t>(k)]);
  clean(along);
  const Vec3 rest = shape_.parts[p].hexahedron.axes.row(axis).transpose();
  const ClosedVector at_rest = closed_unit(rest);
  bool same = true;  // the axis is stretched, not turned
  for (std::size_t c = 0; c < 3 && same; ++c) {
    const std::size_t d = (c + 1) % 3;
    same = cleaned(along[c] * at_rest[d] - along[d] * at_rest[c]).is_zero();
  }
  if (same) return at_rest;
  const ex square = cleaned((along[0] * along[0] + along[1] * along[1] + along[2] * along[2]));
  const double half = shape_.parts[p].hexahedron.half_extents()[axis];
  // The same length at all settings, though sin² + cos² is not seen to be 1: try two of them.
  for (const double shift : {0.137, -0.211}) {
    ex at = square;
    for (std::size_t l = 0; l < layers_.size(); ++l) {
      at =
          at.subs(parameter_symbol(layers_[l].parameter.name) == numeric(shift * (1.0 + 0.3 * static_cast<double>(l))));
    }
    const ex value = at.evalf();
    if (!is_a<numeric>(value)) return std::nullopt;
    if (std::abs(std::sqrt(std::abs(ex_to<numeric>(value).to_double())) - 2 * half) > 1e-4) return std::nullopt;
  }
  for (ex& coordinate : along) coordinate = cleaned(coordinate / closed_length(2 * half));
  return along;
}

std::optional<ClosedVector> ClosedStack::direction(const DirectionReference& reference, std::size_t layer) {
  if (const auto* literal = std::get_if<Vec3>(&reference)) return closed_unit(literal->normalized());
  const auto& named = std::get<PartAxis>(reference);
  const auto p = shape_.find_part(named.part);
  const ClosedPart* state = p ? part(*p, layer) : nullptr;
  return state == nullptr ? std::nullopt : unit_axis(*p, state->corners, named.axis);
}

/// The rules of core/edit/evaluate.h. False when there is no closed form.
bool ClosedStack::edit_group(PartIndex p, const Statement& statement, ClosedPart& state) const {
  const Part& part = shape_.parts[p];
  if (!part.is_virtual()) return false;
  const Relation& relation = shape_.relations[*part.group];
  ClosedGroup& group = *state.group;
  const ex amount = rational(statement.amount.expression());
  const auto* line = std::get_if<Translation>(&relation.detail);
  if (line == nullptr) {
    if (statement.op == Op::change_count) return true;
    const auto& ring = std::get<Rotation>(relation.detail);
    const ClosedCorners before = state.corners;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == ring.parent_axis) continue;
      const auto along = unit_axis(p, before, axis);
      if (!along) return false;
      for (int k = 0; k < 8; ++k)
        add(state.corners[static_cast<std::size_t>(k)], amount * group.radius * corner_sign(k, axis), *along);
    }
    group.radius = cleaned(group.radius * (1 + amount));
    return true;
  }
  ClosedVector span = minus(group.end, group.start);
  ex growth = amount;  // by how many spans the row grows
  if (statement.op == Op::change_count) {
    const ex more = counted_form(amount);
    if (statement.anchor != Anchor::fit) growth = more / group.gaps;
    group.gaps += more;
    if (statement.anchor == Anchor::fit) return true;
  }
  const ex start_share = statement.anchor == Anchor::start ? ex(0)
                         : statement.anchor == Anchor::end ? 1
                                                           : numeric(1, 2);
  for (int k = 0; k < 8; ++k) {
    const bool first = corner_sign(k, line->axis) == -line->direction;
    add(state.corners[static_cast<std::size_t>(k)], first ? -start_share * growth : (1 - start_share) * growth, span);
  }
  add(group.start, -start_share * growth, span);
  add(group.end, (1 - start_share) * growth, span);
  clean(group.start);
  clean(group.end);
  return true;
}

std::optional<ClosedPart> ClosedStack::after(PartIndex p, const ClosedPart& before,
                                             const std::vector<const Statement*>& statements, std::size_t layer) {
  ClosedPart state = before;
  for (const Statement* statement : statements) {
    if (!is_geometric(statement->op)) {
      if (!edit_group(p, *statement, state)) return std::nullopt;
      for (ClosedVector& corner : state.corners) clean(corner);
      continue;
    }
    const LocalTriple whole{0, 0, 0};
    if (part_of(shape_, *statement) != p && statement->feature != whole) return std::nullopt;
    ClosedVector origin = {0, 0, 0}, along = {0, 0, 0}, normal = {0, 0, 0};
    const auto read = [](ClosedVector& into, std::optional<ClosedVector> found) {
      if (found) into = std::move(*found);
      return found.has_value();
    };
    if (statement->origin && !read(origin, point(*statement->origin, layer))) return std::nullopt;
    if (statement->direction && !read(along, direction(*statement->direction, layer))) return std::nullopt;
    if (statement->normal && !read(normal, direction(*statement->normal, layer))) return std::nullopt;
    const ex amount = rational(statement->amount.expression());
    const Displacement<ex> displacement(statement->op, along, normal, amount);
    ClosedCorners moved;
    for (std::size_t k = 0; k < 8; ++k) {
      moved[k] = {0, 0, 0};
      if (!selects(statement->feature, static_cast<int>(k))) continue;
      moved[k] = displacement(minus(state.corners[k], origin));
      add(state.corners[k], 1, moved[k]);
      clean(state.corners[k]);
    }
    if (!state.group) continue;
    const auto ride = [&](ClosedVector& point, const Vec3& at_rest) {
      if (statement->feature == whole) {
        add(point, 1, displacement(minus(point, origin)));
      } else {
        const Weights weights = trilinear_weights(shape_.parts[p].hexahedron.local(at_rest));
        for (std::size_t k = 0; k < 8; ++k) add(point, closed_length(weights[static_cast<int>(k)]), moved[k]);
      }
      clean(point);
    };
    const Relation& relation = shape_.relations[*shape_.parts[p].group];
    if (const auto* line = std::get_if<Translation>(&relation.detail)) {
      ride(state.group->start, line->start);
      ride(state.group->end, line->end);
    } else {
      ride(state.group->centre, std::get<Rotation>(relation.detail).centre);
      const bool swells = statement->op == Op::scale_2d || statement->op == Op::scale_3d;
      if (swells && statement->feature == whole) state.group->radius = cleaned(state.group->radius * (1 + amount));
    }
  }
  return state;
}

}  // namespace parsel
