#include "core/edit/operators.h"

#include <algorithm>
#include <array>

#include "core/edit/displacement.h"
#include "core/edit/operator_table.h"

namespace parsel {

namespace {

struct Row {
  std::string_view name;
  bool is_geometric = false;
  AmountUnit amount = AmountUnit::none;
  std::string_view hint;
  bool origin = false, direction = false, axis = false, normal = false;
  int preference = 0;
};

constexpr std::size_t op_count = static_cast<std::size_t>(Op::keep_fixed) + 1;  // the last

/// The table by operator: operators.json, as operators.cmake writes it.
constexpr std::array<Row, op_count> rows = [] {
  std::array<Row, op_count> table;
#define OPERATOR(name, is_geometric, amount, hint, origin, direction, axis, normal, preference)                   \
  table[static_cast<std::size_t>(Op::name)] = {#name, is_geometric, AmountUnit::amount, #hint, origin, direction, \
                                               axis,  normal,       preference};
#include "operator_rows.inc"
#undef OPERATOR
  return table;
}();
static_assert(std::none_of(rows.begin(), rows.end(), [](const Row& row) { return row.name.empty(); }),
              "operators.json has a row for every operator");

const Row& row_of(Op op) {
  return rows[static_cast<std::size_t>(op)];
}

constexpr std::array<std::string_view, 4> anchor_names = {"start", "middle", "end", "fit"};

Triple<double> triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Displacement<double> displacement_of(const ResolvedOperator& op, double amount) {
  return {op.op, triple(op.direction), triple(op.normal), amount};
}

Vec3 moved(const Displacement<double>& displacement, const Vec3& origin, const Vec3& point) {
  const Triple<double> by = displacement(triple(point - origin));
  return point + Vec3(by[0], by[1], by[2]);
}

}  // namespace

std::string_view to_string(Op op) {
  return row_of(op).name;
}

std::optional<Op> op_from_string(std::string_view text) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].name == text) return static_cast<Op>(i);
  }
  return std::nullopt;
}

std::string_view to_string(Anchor anchor) {
  return anchor_names[static_cast<std::size_t>(anchor)];
}

std::optional<Anchor> anchor_from_string(std::string_view text) {
  for (std::size_t i = 0; i < anchor_names.size(); ++i) {
    if (anchor_names[i] == text) return static_cast<Anchor>(i);
  }
  return std::nullopt;
}

bool is_geometric(Op op) {
  return row_of(op).is_geometric;
}

bool needs_origin(Op op) {
  return row_of(op).origin;
}

bool needs_direction(Op op) {
  return row_of(op).direction || row_of(op).axis;
}

bool needs_normal(Op op) {
  return row_of(op).normal;
}

AmountUnit amount_unit(Op op) {
  return row_of(op).amount;
}

std::string listed_operators(std::string_view before_last) {
  std::string text(rows.front().name);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    text += i + 1 < rows.size() ? ", " : before_last;
    text += rows[i].name;
  }
  return text;
}

std::string_view hint_of(Op op) {
  return row_of(op).hint;
}

int preference_of(Op op) {
  return row_of(op).preference;
}

bool selects(const LocalTriple& feature, int corner) {
  for (int i = 0; i < 3; ++i) {
    const int wanted = feature[static_cast<std::size_t>(i)];
    if (wanted != 0 && wanted != corner_sign(corner, i)) return false;
  }
  return true;
}

Vec3 displaced(const ResolvedOperator& op, double amount, const Vec3& point) {
  return moved(displacement_of(op, amount), op.origin, point);
}

void apply_operator(const ResolvedOperator& op, double amount, Corners& corners) {
  const Displacement<double> displacement = displacement_of(op, amount);
  for (int k = 0; k < 8; ++k) {
    if (selects(op.feature, k)) {
      const Vec3 corner = corners.row(k).transpose();
      corners.row(k) = moved(displacement, op.origin, corner).transpose();
    }
  }
}

}  // namespace parsel
