// The task that asks for the seed edit: what a reply says, and the majority of the replies. ParSEL §6.2.1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/infer/task.h"
#include "core/infer/votes.h"

namespace parsel {

/// Either statements (ids of the shape, amounts in x, all that resolve() asks for) or the reason why there are none.
struct SeedReply {
  std::vector<Statement> statements;
  std::string unclear;  ///< the model's words, printable, at most 300 bytes
};

/// {"edits": [statement, …]} or {"unclear": "why"}. A statement is one of `parsel/edit`, or says the same more loosely:
/// directions as "x", "-y", "up", features and origins as "top" or "front left", amounts and origins left out (the
/// amount is then x, for a count 8*x; the origin is the middle of the feature).
Result<SeedReply> read_seed_reply(const Shape& shape, std::string_view reply);

/// Replies are equal votes by reading_signature().
SeedVote vote(const Shape& shape, const std::vector<SeedReply>& replies);

extern const Task seed_edit_task;

}  // namespace parsel
