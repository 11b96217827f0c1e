// What an edited model is written with, besides its state: an animation, morph targets, a choice of parts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/edit/state.h"
#include "core/gltf/document.h"
#include "core/shape/shape.h"

namespace parsel {

/// The parameter's sweep from its minimum to its maximum, to be written as an animation there and back.
struct Sweep {
  std::string name;            ///< of the animation
  std::vector<State> samples;  ///< at equal steps of the parameter, both ends included; at least 2
  double seconds = 2;          ///< from one end to the other
};

/// What the model shows when the morph target of that name has weight 1.
struct Pose {
  std::string name;  ///< UTF-8, unique among the poses
  State state;       ///< with as many instances in every group as the edited state
};

struct ApplyOptions {
  std::optional<Sweep> sweep;
  /// Morph targets to be added, in this order; not together with a sweep. See apply_morph.h.
  std::vector<Pose> poses;
  /// When not empty, everything else with a mesh is taken out of the scene (its data stays in the file). A virtual part
  /// stands for its instances.
  std::vector<PartIndex> only_parts;
  /// Of apply_program(): whether what the program pulls apart is closed, as close_gaps() does it; not together with a
  /// sweep or poses.
  bool repair = false;
  /// Buffers and images that a .gltf names, by URI.
  ExternalBuffers external;
};

}  // namespace parsel
