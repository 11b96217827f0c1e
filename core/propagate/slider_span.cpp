#include "core/propagate/slider_span.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/tolerance.h"
#include "core/edit/operator_table.h"
#include "core/propagate/transfer.h"

namespace parsel {

namespace {

constexpr double half = -0.5, twice = 1;  ///< amounts of a scale
/// A change of this many half-diagonals is seen: a few per cent of a picture's height.
constexpr double visible = 0.1;
/// A thin part becomes no thicker than by this factor less one: what a candidate's amount may be (core/prove/range.h),
/// with room to spare.
constexpr double most_scale = 4;
constexpr double open = 110 * pi / 180;
constexpr double lean = 30 * pi / 180;
/// A part that stands up from its axis within 60° of the vertical.
constexpr double standing = 0.5;
/// A part whose centre is nearer to its axis than this share of its reach spins about itself.
constexpr double spinning = 0.1;
/// Values of the parameter are sought up to this multiple of the least span.
constexpr double farthest = 64;
constexpr int halvings = 30;
constexpr double decimals = 1e4;

/// Amounts between which a seed is worth having.
struct AmountSpan {
  double low = 0, high = 0;
};

AmountSpan both_ways(double most) {
  return {-most, most};
}

double extent_along(const Corners& corners, const Vec3& direction, const LocalTriple& feature = {0, 0, 0}) {
  double low = 0, high = 0;
  bool any = false;
  for (int k = 0; k < 8; ++k) {
    if (!selects(feature, k)) continue;
    const double along = corners.row(k) * direction;
    low = any ? std::min(low, along) : along;
    high = any ? std::max(high, along) : along;
    any = true;
  }
  return high - low;
}

double extent_of_model(const Shape& shape, const Vec3& direction) {
  double low = 0, high = 0;
  for (const Part& part : shape.parts) {
    const Eigen::Matrix<double, 8, 1> along = part.hexahedron.corners * direction;
    low = std::min(low, along.minCoeff());
    high = std::max(high, along.maxCoeff());
  }
  return high - low;
}

AmountSpan scaled(double extent) {
  return {half, std::clamp(visible / std::max(extent, noise), twice, most_scale)};
}

/// Whether everything that the layer moves turns.
bool only_turns(const Layer& layer) {
  return std::all_of(layer.statements.begin(), layer.statements.end(),
                     [](const Statement& s) { return s.op == Op::rotate || s.op == Op::keep_fixed; });
}

bool is_on_floor(const Shape& shape, PartIndex part) {
  const std::vector<PartIndex>& members = shape.parts[part].members;
  return std::any_of(shape.relations.begin(), shape.relations.end(), [&](const Relation& relation) {
    return relation.kind == RelationKind::ground &&
           (relation.parts[0] == part || std::count(members.begin(), members.end(), relation.parts[0]) > 0);
  });
}

/// Whether a turned part stands up from its axis, or stands on the floor, so that a turn lets it lean.
bool leans(const Shape& shape, PartIndex part, const ResolvedOperator& turn) {
  if (std::abs(turn.direction.y()) > upright_axis) return false;
  if (is_on_floor(shape, part)) return true;
  const Corners& corners = shape.parts[part].hexahedron.corners;
  const auto from_axis = [&](const Vec3& point) {
    const Vec3 lever = point - turn.origin;
    return Vec3(lever - lever.dot(turn.direction) * turn.direction);
  };
  double reach = 0;
  for (int k = 0; k < 8; ++k) reach = std::max(reach, from_axis(corners.row(k).transpose()).norm());
  const Vec3 centre = from_axis(corners.colwise().mean().transpose());
  if (centre.norm() <= spinning * reach) return false;
  return centre.y() > standing * centre.norm();
}

/// Unit directions in which a scale lets a part grow: along its direction, across its normal, else everywhere.
std::vector<Vec3> ways_of_growth(const ResolvedOperator& scale) {
  if (needs_direction(scale.op)) return {scale.direction};
  std::vector<Vec3> ways;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 unit = Vec3::Unit(axis);
    const Vec3 across = needs_normal(scale.op) ? Vec3(unit - scale.normal[axis] * scale.normal) : unit;
    if (across.norm() > noise) ways.push_back(across.normalized());
  }
  return ways;
}

/// Nothing for keep_fixed.
std::optional<AmountSpan> worth_having(const Shape& shape, const Layer& layer, const Statement& seed) {
  const auto target = part_of(shape, seed);
  if (!target) return std::nullopt;
  const ResolvedOperator what = to_step(shape, seed).what;
  const Corners& corners = shape.parts[*target].hexahedron.corners;
  switch (amount_unit(seed.op)) {
    case AmountUnit::length: {
      const double own = extent_along(corners, what.direction);
      if (what.feature == LocalTriple{0, 0, 0})
        return both_ways(std::max(own, extent_of_model(shape, what.direction) / 2));
      const Hexahedron& box = shape.parts[*target].hexahedron;
      const Vec3 local(what.feature[0], what.feature[1], what.feature[2]);
      const double side = (box.point(local) - box.point(Vec3::Zero())).dot(what.direction);
      if (std::abs(side) < noise) return both_ways(own);
      const double longer = std::max(own, visible), shorter = own / 2;
      return side > 0 ? AmountSpan{-shorter, longer} : AmountSpan{-longer, shorter};
    }
    case AmountUnit::angle:
      return both_ways(only_turns(layer) && !leans(shape, *target, what) ? open : lean);
    case AmountUnit::ratio: {
      double widest = 0;
      for (const Vec3& way : ways_of_growth(what)) widest = std::max(widest, extent_along(corners, way, what.feature));
      return scaled(widest);
    }
    case AmountUnit::slope:
      return both_ways(std::tan(lean));
    case AmountUnit::count: {
      const auto relation = shape.find_relation(seed.relation);
      const double count = relation ? static_cast<double>(shape.relations[*relation].parts.size()) : 0;
      // Rounded down: a little more than twice, so that twice is reached.
      return AmountSpan{-std::floor(count / 2), count + 0.5};
    }
    case AmountUnit::spacing:
      return AmountSpan{half, twice};
    case AmountUnit::none:
      return std::nullopt;
  }
  return std::nullopt;
}

/// The farthest value from `least` outwards to the side of `sign` up to which the amount is within the span.
double reach_of(const CompiledAmount& amount, const AmountSpan& span, double least, double sign) {
  const auto is_within = [&](double distance) {
    const double x = sign * distance;
    const double value = amount(&x);
    return value >= span.low && value <= span.high;  // not so when undefined
  };
  double good = least;
  if (!is_within(good)) return least;
  double bad = 2 * good;
  for (; is_within(bad); bad *= 2) {
    // It ends nowhere: a sine, say, whose slider needs no more than the least span.
    if (bad > farthest * least) return least;
    good = bad;
  }
  for (int i = 0; i < halvings; ++i) {
    const double middle = (good + bad) / 2;
    (is_within(middle) ? good : bad) = middle;
  }
  // Half of what rounding may take away is given back, as ends are often short decimals.
  return std::max(least, std::floor(good * decimals + 1e-3) / decimals);
}

}  // namespace

SliderSpan span_of_seeds(const Shape& shape, const Layer& layer, double least) {
  PARSEL_ASSERT(least > 0, "the span has an inside");
  std::optional<SliderSpan> span;
  for (const Statement& statement : layer.statements) {
    if (!statement.why || statement.why->kind != WhyKind::seed) continue;
    const auto worth = worth_having(shape, layer, statement);
    if (!worth) continue;
    const CompiledAmount amount = statement.amount.compile({layer.parameter.name});
    const SliderSpan own{-reach_of(amount, *worth, least, -1), reach_of(amount, *worth, least, 1)};
    span = span ? SliderSpan{std::max(span->low, own.low), std::min(span->high, own.high)} : own;
  }
  return span.value_or(SliderSpan{-least, least});
}

}  // namespace parsel
