// Statements of a layer, and the steps of its trace that tell of them.
#pragma once

#include <vector>

#include "core/edit/program.h"
#include "core/propagate/constraints.h"
#include "core/propagate/motion.h"
#include "core/propagate/trace.h"

namespace parsel {

/// Appends a keep_fixed of the part. Its index in the layer.
int add_keep_fixed(Layer& layer, const Shape& shape, PartIndex part, Why why);

/// Appends a statement for each step of the part's edit. `sources`: whose points and axes they may name, the nearest
/// first. Their indices in the layer.
std::vector<int> add_steps(Layer& layer, const Shape& shape, PartIndex part, const std::vector<Step>& steps,
                           const std::vector<PartIndex>& sources, const Why& why);

/// What the trace says of a part that stays without having been decided upon, by a hint or as the body of the model.
/// When an edited neighbour pulls at it in vain it gets its keep_fixed, so that the program shows the decision.
TraceStep held_step(Layer& layer, const Graph& graph, const Edits& edits, PartIndex part, bool by_hint);

}  // namespace parsel
