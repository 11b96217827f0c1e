// Changes models and edits at random, so that most of them still mean something: the JSON as JSON, numbers to numbers
// that are hard, vertices to other places, and now and then single bytes.
#pragma once

#include <string>

#include "core/base/random.h"

namespace parsel::fuzz {

struct Input {
  std::string glb;
  std::string edit;  ///< JSON text
};

/// The same input for the same state of `random`.
Input mutated(const Input& seed, Random& random);

}  // namespace parsel::fuzz
