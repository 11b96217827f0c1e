// The one rule for how far a relation may be off. The search, its trace and the proof use it; the independent checker
// has its own copy (core/check/check_scope.h), as a rule that it took from here would check nothing.
#pragma once

#include "core/shape/shape.h"

namespace parsel {

/// How well a relation is kept, best first: off by no more than `exact`, half of delta_one_edited, delta_one_edited,
/// delta_both_edited (base/tolerance.h), or by more than it may.
enum class Slack { tight, half, one, two, broken };

/// How far a coordinate of the relation's constraint may be off: delta_one_edited (0.025/√3: a distance of 0.025 in
/// all) while one of its parts stays where it is, delta_both_edited (0.075/√3) when both move. A part that stays shows
/// a gap at once and leaves its neighbour no say in it; two parts that move share the error of both edits. A part that
/// is kept fixed stays, whatever was decided about it. A group and its parent always move together, so they count as
/// both; the floor never moves. `moves_a`, `moves_b`: whether relation.parts[0] and [1] move; without effect for a group
/// and for the ground.
double tolerance_of(const Relation& relation, bool moves_a, bool moves_b);

/// `residual`: the largest |coordinate| by which the relation is off, normalised, >= 0. `broken` exactly when it
/// exceeds tolerance_of(), so `two` occurs only when both parts move.
Slack slack_of(const Relation& relation, double residual, bool moves_a, bool moves_b);

}  // namespace parsel
