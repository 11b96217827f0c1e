// The whole way of an edit in one process: inspect → propagate → check → apply, on a model and an edit that may be
// anything.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace parsel::fuzz {

/// How far an input came, for the count at the end of a campaign.
enum class Reached { nothing, shape, edit, program, model };

struct Walk {
  Reached reached = Reached::nothing;
  /// What one step accepted or wrote and the next refused: "propagate, then validate: <message>". Nothing when all is
  /// well; a refusal of the input by the step that reads it is well.
  std::optional<std::string> fault;
};

/// `glb`: any bytes; `edit`: the text of an edit (format parsel/edit), any bytes.
Walk walk(std::string_view glb, std::string_view edit);

}  // namespace parsel::fuzz
