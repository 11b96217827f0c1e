// What a careful person would have done instead: asked when the edits that the greedy search found leave feet in the air,
// joints apart, or everything moved as one. A beam with one cost (search.h), started several times: free, with feet that
// stay where they are, with all that stands on the floor at rest, and with the body of the model at rest, beyond the seeds
// or beyond their neighbours, so that only what hangs on them follows.
#pragma once

#include <memory>

#include "core/propagate/attempt.h"

namespace parsel {

/// Nothing unless it is clearly better than `incumbent` (cost.h). Deterministic.
std::unique_ptr<Attempt> better_alternative(const Shape& shape, const ResolvedRequest& request,
                                            const PropagateOptions& options, const Edits& incumbent,
                                            const Progress& progress);

}  // namespace parsel
