// From the decisions of a search to the statements of a layer and its trace.
#pragma once

#include "core/edit/program.h"
#include "core/propagate/search.h"

namespace parsel {

/// Appends to `layer` and `trace`, which hold those of the seeds. `seeds`: the edits of the seed parts alone.
void write_decisions(const Graph& graph, const ResolvedRequest& request, const Edits& seeds, const SearchState& state,
                     Layer& layer, Trace& trace);

}  // namespace parsel
