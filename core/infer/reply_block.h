// What reading a reply has in common for all tasks: forgiving about form (see json_block.h), strict about meaning.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/infer/json_block.h"

namespace parsel {

/// An Error of this stage.
Error reply_refused(std::string place, std::string cause, std::string fix);

/// The first member with one of the names, null when there is none.
const nlohmann::json& member(const nlohmann::json& block, std::initializer_list<const char*> names);

/// ASCII letters in lower case.
std::string lower_case(std::string text);

/// The first block, from the last, that has a meaning; else what is wrong with the last one.
template <class T, class Read>
Result<T> first_meaning(std::string_view reply, const Read& read) {
  if (reply.size() > ReplyLimits::text_bytes) {
    return reply_refused("", "the reply is longer than 1 MiB", "ask again, or ask another model");
  }
  std::optional<Error> last;
  for (const nlohmann::json& block : json_blocks(reply)) {
    Result<T> meaning = read(block);
    if (meaning.ok()) return meaning;
    if (!last) last = meaning.error();
  }
  if (last) return *last;
  return reply_refused("", "the reply holds no whole JSON block", "ask again, perhaps with room for a longer reply");
}

}  // namespace parsel
