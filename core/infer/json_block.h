// Finds the JSON in a language model's reply, which thinks in free text first. Forgives how models slip in form:
// comments, trailing commas, Python's True, False and None, line ends in strings, a fence that is missing or not
// closed.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace parsel {

struct ReplyLimits {
  static constexpr std::size_t text_bytes = 1'048'576;
  static constexpr std::size_t block_bytes = 65'536;
  static constexpr int nesting = 16;
  static constexpr std::size_t blocks = 32;  ///< looked at, from the end
};

/// What the reply may mean, the likeliest first: the fenced blocks from the last to the first, then objects (and lists
/// of them) that stand in the text without a fence, from the last. Empty when there is none, and when the reply breaks
/// off inside its last block: half a block may mean something else than the whole. Takes any bytes; linear time.
std::vector<nlohmann::json> json_blocks(std::string_view reply);

}  // namespace parsel
