// Ranges in which nothing comes apart: cut to them, or stretched as far as they go.
#pragma once

#include "core/propagate/propagate.h"

namespace parsel {

/// Cuts the range of a layer to the widest one around 0 in which every relation that prove_relations() judges, but for
/// those that the layer's reports call disabled, keeps its tolerance, and proves the relations anew. Ends that are cut
/// are rounded towards 0 to four decimals. [0, 0] when nothing else is clean. `program` passed validate() for `shape`.
void cut_to_clean(const Shape& shape, Program& program, std::size_t layer);

/// A range is stretched no further than this.
inline constexpr double farthest_range = 16;

/// Stretches the range of a layer to contain `to` (finite), or as far towards it as find_range() goes, no relation breaks
/// that the layer's reports call held, and the program stays one that validate() accepts; then proves the relations
/// anew. The other end stays. Nothing changes when the range contains `to` or cannot be stretched.
void extend_range(const Shape& shape, Program& program, std::size_t layer, double to);

/// propagate(), cut_to_clean(). Fails also when what is left does nothing worth a slider: no end of it reaches
/// `least_clean` of the range sought, or no corner moves by `least_move`, normalised, and no count changes.
Result<Propagation> propagate_cleanly(const Shape& shape, const EditRequest& request,
                                      const PropagateOptions& options = {}, const Progress& progress = {});
inline constexpr double least_clean = 0.2;
inline constexpr double least_move = 0.01;

}  // namespace parsel
