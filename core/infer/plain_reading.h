// Reads plain requests at once, without a language model: "raise the back", "two more shelves", "make the legs 10 cm
// longer". What it answers is what a language model's replies are counted as, so that all that follows is the same.
//
// Words are looked up in lists (core/infer/words), names in the shape; every way to take them is parsed into clauses
// (plain_clause.h) and put into statements (plain_seed.h). It is sure only when every word that says something was used
// and all ways to take them come to one edit. Else it says what it did not understand, with the nearest readings.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/infer/inference.h"
#include "core/infer/plain_seed.h"
#include "core/infer/prompt.h"

namespace parsel {

struct PlainReading {
  bool sure = false;
  std::string language;
  /// The nearest first; one when sure. Each passes resolve().
  std::vector<PlainEdit> edits;
  std::vector<std::string> words;   ///< of each edit, as reading_words(), with what was said of its amount
  std::vector<std::string> unused;  ///< words of the request that were not understood, as written
  std::string reason;               ///< why it is not sure, a clause without a full stop; empty when sure
};

/// Fails like make_prompt() for a wish that is blank, too long or mentions parts that are not there.
Result<PlainReading> read_plainly(const Shape& shape, const EditWish& wish);

/// One vote by nobody: the outcome is decided when sure, split when there are readings, unclear when there are none.
Inference as_inference(const Shape& shape, const PlainReading& reading);

/// What to_json(Inference) gives, and "plain": {"sure", "language", "unused": [words], "reason": text or null, "readings":
/// [{"edit": parsel/edit v1, "words", "target": null or {"part": id or null, "what", "by" | "to" | "times": number, "x"}}]}.
/// Lengths in metres, angles in radians; x is the slider's value as far as the seed alone tells.
nlohmann::json to_json(const Shape& shape, const PlainReading& reading);

}  // namespace parsel
