// A program's sliders as morph targets of the model (apply_morph.h), and how exact they are.
//
// A weight runs from 0, the edited model with the values given, to 1, the end of the slider's range. Where the range
// reaches to both sides of the value there are two targets, "name" for the maximum and "name −" for the minimum, also
// when the program is linear: Unity clamps weights to 0 … 1, Blender's sliders begin at 0, so one target with negative
// weights would hide half of the range from most people. Of a linear slider weight w of one target equals weight
// −w·(max − value)/(value − min) of the other, for viewers that do not clamp.
//
// Vertices are linear in the corners of their hexahedron. So a target is exact for a program that is linear in the
// slider, and the error of any other is that of the corners. Where a straight line is off by more than
// slider_tolerance, further targets stand for poses on the way ("name 50%", at most three a side): each is the pose in
// itself, and between two neighbours one weight falls as the other rises. Several sliders at once add up their
// displacements; what two of them do together beyond that is measured, not corrected.
//
// A morph target moves what is there. Layers whose slider changes how many instances there are get none.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/export/apply.h"

namespace parsel {

/// Largest distance of a vertex from where the program has it that nobody is told of: 0.2 % of the half-diagonal.
inline constexpr double slider_tolerance = 0.002;

/// One slider of the exported model. Distances are largest ones of a vertex inside of its hexahedron, in metres.
struct Slider {
  std::string parameter;             ///< of the layer
  std::vector<std::string> targets;  ///< names: of the maximum, of poses on the way there; the same of the minimum
  bool linear = true;                ///< within 1e-6 of the half-diagonal at 20 positions a side
  double straight = 0;               ///< error when only the targets of the ends are used
  double error = 0;                  ///< error when those on the way are used as well
};

struct SlidersApplied {
  Applied applied;
  std::vector<Slider> sliders;  ///< in the order of the layers; those that move nothing are left out, with a warning
  /// Error when two sliders are at weight 1, at the maximum where there is one, others at 0: of the worst pair.
  double together = 0;
  std::vector<std::string> worst_pair;  ///< their first targets; empty without two sliders
};

/// Applies the program at `values`, one a layer, and adds the targets of every layer. `program` must have passed
/// validate() for `shape`; `options` without sweep and poses. A target is called by the layer's request, cut to 40
/// bytes, or by the parameter where that is blank; a number makes it unique. Error: as apply_state(), a number of
/// values that is not that of the layers, or no layer left because all that move something change counts.
Result<SlidersApplied> apply_sliders(std::string_view file, const Shape& shape, const Program& program,
                                     const std::vector<double>& values, ApplyOptions options = {});

/// {"sliders": [{"parameter", "targets": [names], "linear", "error_m", "ends_error_m"}],
///  "together": {"targets": the worst pair, "error_m"}}, distances in metres.
nlohmann::json to_json(const SlidersApplied& model);

}  // namespace parsel
