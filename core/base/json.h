// The one gate for JSON that comes from outside: edits, programs, replies, manifests, shapes, models, calls of the page.
//
// The library parses and destroys any nesting, but whoever copies, compares or prints a value recurses into it, and a
// value takes many times the memory of its text. So size and nesting are looked at before a parser sees the text.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace parsel {

struct JsonLimits {
  /// With less, the shape of the largest model that opens could not be read again; with more, text and value together
  /// pass 1 GiB.
  std::size_t bytes = std::size_t{256} << 20;
  std::size_t values = 8'000'000;  ///< likewise; counted as commas, colons and opening brackets outside strings
  /// Our formats nest to 8 and glTF's extras seldom beyond 20; a thread's stack in the page ends at some thousand.
  std::size_t depth = 64;
};

struct JsonFault {
  std::size_t at = 0;  ///< byte of the text
  std::string cause;   ///< a clause, as in Error
};

/// What is wrong with the text's size or nesting; nothing when a parser may see it. Linear time, no memory.
std::optional<JsonFault> json_limits_fault(std::string_view text, const JsonLimits& limits = {});

/// Any bytes → a value within the limits, or an Error of the stage whose place is "line L, column C" (from 1, columns
/// in characters) and whose cause says what is not JSON there, or which limit is passed.
Result<nlohmann::json> json_from_text(std::string_view text, const std::string& stage, const JsonLimits& limits = {});

}  // namespace parsel
