// What goes wrong with cages and rows where all sliders stand anywhere: what find_range() (range.h) looks at for one slider.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/shape/shape.h"

namespace parsel {

/// What goes wrong, of what find_range() looks at, where every layer stands at its own of `values`; empty when nothing
/// does. For repeated use: see Together (together.h).
class StackFailure {
 public:
  /// `shape` must live as long; the program has at least one layer and passed validate().
  StackFailure(const Shape& shape, const Program& program);
  /// `state`: what the program gives at `values`.
  std::string operator()(const std::vector<double>& values, const State& state) const;

 private:
  struct Implementation;
  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace parsel
