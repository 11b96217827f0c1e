// Majority voting over the replies to one prompt. ParSEL §6.2.1.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/infer/reply.h"

namespace parsel {

/// Type hints are kept when at least this share of the replies gives them.
inline constexpr double hint_share = 0.6;

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

struct HintVote {
  std::string part;
  Hint hint = Hint::translate;
  int votes = 0, of = 0;
};

struct RelationVote {
  RelationIndex relation;
  bool keep = true;  ///< a tie keeps, as the shape is
  int votes = 0;     ///< for `keep`
  int of = 0;
};

/// Replies are equal votes by reading_signature().
SeedVote vote(const Shape& shape, const std::vector<SeedReply>& replies);
/// The hints kept, by part.
std::vector<HintVote> vote(const std::vector<std::map<std::string, Hint>>& replies);
RelationVote vote(RelationIndex relation, const std::vector<bool>& keeps);

}  // namespace parsel
