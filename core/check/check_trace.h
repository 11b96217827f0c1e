// Replays the claims of a propagation's trace (format parsel/trace v1, see trace.h). Internal to the checker.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/check/report.h"
#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel::replay {

/// Adds to `report.findings` what the trace says of layer `layer` and is not so, and counts the claims replayed:
///   * parameter and tolerances are those of the program and of the project; dissolved and disabled groups and
///     relations are those that the layer's statements and reports imply;
///   * every part that counts has at most one step that edits it, seeds first; every statement belongs to exactly one
///     step, that of its own part, and has the step's kind;
///   * every step edits a part that something pulls at; which of those came first is not judged;
///   * `pulled_by` and `result` are what the samples give before and after the step's statements, and name every
///     relation to an edited part that is off; `left_broken` follows from `result`;
///   * no number of candidates or cost is negative, and what was solved had been screened;
///   * the reason for stopping is true: nothing is left to follow.
/// Energies are not computed anew, and candidates are not generated anew.
void check_trace(const Shape& shape, const Program& program, std::size_t layer, const nlohmann::json& trace,
                 CheckReport& report);

}  // namespace parsel::replay
