// Edits that keep every relation and are no answer.
#pragma once

#include "core/propagate/footing.h"

namespace parsel {

/// Whether the edits do nothing but
///   * move the model to another place: all that stands on the floor moves by one rigid motion, or, where nothing stands,
///     every part; or
///   * do to all of a row what was asked of one: who names one drawer does not mean all.
/// Not where all parts that do so have a hint or are seeds: then it was asked for. `feet` as find_feet() gives them.
bool is_pointless(const Graph& graph, const ResolvedRequest& request, const Edits& seeds, const Feet& feet,
                  const Edits& edits);

}  // namespace parsel
