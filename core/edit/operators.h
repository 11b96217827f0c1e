// The edit operators and what they do to 8 corners. ParSEL §4.2, supplement table 2.
//
// Notation: H the corners before, H' after; o origin, n unit direction/axis/normal, d unit direction, a amount.
//   translate   H' = H + a·n                          scale_3d  H' = H + a·(H − o)
//   rotate      H' = o + R(n, a)(H − o)               shear     H' = H + a·(n·(H − o))·d
//   scale_1d    H' = H + a·(n·(H − o))·n              keep_fixed H' = H
//   scale_2d    H' = H + a·P(H − o), P = I − n nᵀ
// A geometric operator acts on the corners that its feature selects: corner k belongs to feature f when f[i] is 0 or
// corner_sign(k, i) for i = 0, 1, 2.
#pragma once

#include <optional>
#include <string_view>

#include "core/base/geometry.h"
#include "core/base/result.h"

namespace parsel {

enum class Op { translate, rotate, scale_1d, scale_2d, scale_3d, shear, change_count, change_delta, keep_fixed };

/// Where change_count and change_delta hold a group: which instance stays, or that its extent stays.
enum class Anchor { start, middle, end, fit };

/// An operator with its references resolved to numbers.
struct ResolvedOperator {
  Op op = Op::keep_fixed;
  LocalTriple feature{0, 0, 0};
  Vec3 origin = Vec3::Zero();     ///< rotate, scale_*, shear
  Vec3 direction = Vec3::Zero();  ///< unit: translate's and scale_1d's direction, rotate's axis, shear's direction
  Vec3 normal = Vec3::Zero();     ///< unit: scale_2d's and shear's normal
};

std::string_view to_string(Op op);
std::optional<Op> op_from_string(std::string_view text);
std::string_view to_string(Anchor anchor);
std::optional<Anchor> anchor_from_string(std::string_view text);

/// translate … shear and keep_fixed; false for the two group operators.
bool is_geometric(Op op);
bool needs_origin(Op op);
bool needs_direction(Op op);
bool needs_normal(Op op);

bool selects(const LocalTriple& feature, int corner);

/// Where a geometric operator takes one point; the feature is not looked at. `amount` as in apply_operator().
Vec3 displaced(const ResolvedOperator& op, double amount, const Vec3& point);

/// Applies a geometric operator in place. `amount` in normalised lengths (translate), radians (rotate) or a ratio.
void apply_operator(const ResolvedOperator& op, double amount, Corners& corners);

}  // namespace parsel
