// How near a program is to the true one: the three measures of ParSEL, supplement §5.3.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

struct Score {
  /// J(prog), §5.3.1: Jaccard similarity of the sets of (operator, operand) over all layers, 0 … 1. The operand is the
  /// part's or group's id; feature and amount do not count. Two programs without statements are alike: 1.
  double programmatic = 1;
  /// D(geo), §5.3.2: the distance between the corners under both programs, as 24-vectors, summed over the real parts,
  /// with every parameter at 0.35 or, where a range ends before that, at the smaller end of the two programs' ranges
  /// (layer by layer). Normalised lengths. Where the number of instances differs, the missing ones count as the last
  /// one.
  double geometric = 0;
  /// %Rel, §5.3.3: of the relations that touch a part edited by either program, the share in the same state under both:
  /// kept or broken over the whole range (in any layer), whether disabled or not, or without effect because the group
  /// was taken apart. 0 … 1; 1 when there are none.
  double structural = 1;
  int relations = 0;  ///< that structural speaks of
};

/// Both programs passed validate() for `shape`.
Score score_program(const Shape& shape, const Program& truth, const Program& program);

nlohmann::json to_json(const Score& score);

}  // namespace parsel
