// How a part moves: the steps of its edit, numerically at a few values of the parameter and in closed form.
//
// The search for edits works on numbers at sample values of the parameter; only what survives becomes algebra. So a
// step carries its amount twice, as an expression and as its samples.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <optional>
#include <vector>

#include "core/edit/operators.h"
#include "core/shape/shape.h"

namespace parsel {

/// Four values a side: both ends, both neighbourhoods of 0, and two between, so that a kink or jump at 0 shows.
inline constexpr std::size_t sample_count = 8;
using Samples = std::array<double, sample_count>;

/// The sample values of a range around 0, ascending: `low` <= 0 <= `high`.
Samples sample_points(double low, double high);

/// One statement of a part's edit. For change_count and change_delta the part is the parent of the group.
struct Step {
  ResolvedOperator what;
  Anchor anchor = Anchor::middle;  ///< change_count and change_delta
  GiNaC::ex amount;                ///< of the parameter
  Samples values{};                ///< amount at the samples
};

/// Characters of an amount. Longer ones come of turns along a chain of turned parts, double with every link, and are
/// refused by every reader beyond 4,096; the chains of the gallery need up to 90.
inline constexpr std::size_t longest_amount = 1'000;
/// Whether an amount among them, written out, is longer than that.
bool is_too_long(const std::vector<Step>& steps);

/// Displacements of the 8 corners, from rest, at every sample.
using Motion = std::array<Corners, sample_count>;
/// That of a part at rest.
Motion still();
/// How far apart a corner is in the two at most, at the ends of the range that the search looks at; of one coordinate.
double largest_difference(const Motion& a, const Motion& b);

/// An operator's displacement field. For an operator that is linear in its amount: displacement of every corner for
/// amount 1. For rotate: the lever (corner − origin) of every corner that turns, zero for the others.
Corners unit_field(const ResolvedOperator& what, const Corners& rest);
/// change_delta: displacement of the parent's corners for amount 1. change_count: for one instance more.
/// See core/edit/evaluate.h. `parent` must be virtual.
Corners group_field(const Shape& shape, PartIndex parent, Op op, Anchor anchor);

/// (R(axis, angle) − I)·lever.
Vec3 turned(const Vec3& lever, const Vec3& axis, double angle);

/// The motion of a part at rest under its steps, in order. Group operators take the field of the group at rest.
Motion motion_of(const Shape& shape, PartIndex part, const std::vector<Step>& steps);

/// Corners in closed form: 8 × 3 displacements from rest as expressions of the parameter.
using SymbolicMotion = std::array<std::array<GiNaC::ex, 3>, 8>;
SymbolicMotion symbolic_motion(const Shape& shape, PartIndex part, const std::vector<Step>& steps);

/// What change_count adds in closed form: the amount rounded down as the evaluator does it (core/edit/evaluate.h),
/// jumps at the same values of the parameter.
GiNaC::ex counted_form(const GiNaC::ex& amount);

/// The closed form of a double: an exact rational when it is a short decimal, 0 when it is noise.
GiNaC::ex number(double value);

}  // namespace parsel
