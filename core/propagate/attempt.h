// One way to answer a request: the edits that a search found, and the program that it makes of them.
#pragma once

#include "core/propagate/constraints.h"
#include "core/propagate/propagate.h"

namespace parsel {

class Attempt {
 public:
  virtual ~Attempt() = default;
  /// Of every part that was decided upon, seeds and held parts included.
  virtual const Edits& edits() const = 0;
  /// The program with its range and proof. Once.
  virtual Propagation finish() = 0;
};

/// Notes for the trace: hints for parts that are seeds or not in the graph.
std::vector<std::string> unused_hints(const Graph& graph, const ResolvedRequest& request);

/// Why a search with these edits was over, a sentence.
std::string why_it_stopped(const Graph& graph, const Edits& edits);

/// The program of a layer: its range found, its relations proved, the trace completed.
Propagation finished(const Shape& shape, const ResolvedRequest& request, const PropagateOptions& options,
                     const Samples& at, Layer layer, Trace trace, const Progress& progress);

}  // namespace parsel
