// What goes wrong with cages and rows where all sliders stand anywhere: what find_range() (range.h) looks at for one slider.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

/// What goes wrong, of what find_range() looks at, where every layer stands at its own of `values`; empty when nothing
/// does. Amounts are looked at in the last layer only. For repeated use: see Together (together.h).
class StackFailure {
 public:
  /// `shape` must live as long; the program has at least one layer and passed validate().
  StackFailure(const Shape& shape, const Program& program);
  std::string operator()(const std::vector<double>& values) const;

 private:
  struct Implementation;
  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace parsel
