// The task that asks for the seed edit: what a reply says, and the majority of the replies. ParSEL §6.2.1.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/infer/task.h"
#include "core/propagate/edit_request.h"

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

struct Reading {
  std::vector<Statement> statements;  ///< the form that most of its votes have, the first of them in a tie
  std::string words;
  int votes = 0;
};

struct SeedVote {
  /// decided: more than half of the replies agree. unclear: more say so than support any reading. split: else.
  /// none: there was no reply.
  enum class Outcome { decided, split, unclear, none };
  Outcome outcome = Outcome::none;
  std::vector<Reading> readings;      ///< most votes first, ties by first arrival
  int of = 0;                         ///< replies counted
  std::optional<std::string> reason;  ///< of the first reply that says that the request is unclear
};
std::string_view to_string(SeedVote::Outcome outcome);

/// Replies are equal votes by reading_signature().
SeedVote vote(const Shape& shape, const std::vector<SeedReply>& replies);

extern const Task seed_edit_task;

}  // namespace parsel
