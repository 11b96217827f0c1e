// Edits carried over to other parts, and their way into statements.
#pragma once

#include <optional>
#include <vector>

#include "core/edit/program.h"
#include "core/propagate/constraints.h"

namespace parsel {

/// E* = T(E): the edit of the part at the other end of a reflection that restores it, given the edit of `from`.
/// ParSEL §5.3. Nothing when the edit has no mirror image there: a group operator where there is no like group.
std::optional<std::vector<Step>> reflected(const Shape& shape, const Relation& reflection, PartIndex from,
                                           const std::vector<Step>& steps);

/// A step of `part` as a statement. Points and axes are written as features of the first of `sources` that has them,
/// else as numbers. Directions are written with positive sign where the amount can take it.
Statement to_statement(const Shape& shape, PartIndex part, const Step& step, const std::vector<PartIndex>& sources);

/// Resolves a statement's references on the shape at rest. The statement's parts must be known.
Step to_step(const Shape& shape, const Statement& statement);

}  // namespace parsel
