// The loop of ParSEL §5, algorithm 2: one part after the other, the one with the most broken relations first, with the
// first edit that a ladder of attempts finds for it (solve_part.h); then a second look. Its result stands unless
// something is wrong with it that a careful person would not accept (propagate.cpp), and is what others must beat.
#pragma once

#include <memory>

#include "core/propagate/attempt.h"

namespace parsel {

/// Fails when a seed's amount is undefined at or near 0, or inverts its own part at once.
Result<std::unique_ptr<Attempt>> search_greedily(const Shape& shape, const ResolvedRequest& request,
                                                 const PropagateOptions& options, const Progress& progress);

}  // namespace parsel
