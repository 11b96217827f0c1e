// The edits asked for, as the start of a search.
#pragma once

#include <string>
#include <vector>

#include "core/propagate/constraints.h"
#include "core/propagate/propagate.h"

namespace parsel {

struct Seeds {
  Samples at{};  ///< where the search looks: within the range in which the seeds make sense
  Edits edits;
  std::vector<Statement> statements;  ///< with their reason
  std::vector<TraceStep> trace;
  std::vector<std::string> notes;
};

/// Fails when a seed's amount is undefined at or near 0, or inverts its own part at once.
Result<Seeds> apply_seeds(const Graph& graph, const ResolvedRequest& request, const PropagateOptions& options);

}  // namespace parsel
