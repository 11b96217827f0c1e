// What all replies to a task mean, counted: a type for each task, which is a member of Inference.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/edit/program.h"
#include "core/propagate/edit_request.h"
#include "core/shape/shape.h"

namespace parsel {

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

struct ProposedRequest {
  std::string request;               ///< one that can be asked: not blank, no markup
  std::vector<std::string> changes;  ///< ids of the parts that it is about, at least one
  std::vector<std::string> keeps;    ///< ids of the parts of which it says that they stay
};

struct DroppedProposal {
  std::string request;  ///< as far as it can be shown
  std::string reason;   ///< a clause without a full stop
};

struct Proposals {
  std::vector<ProposedRequest> requests;
  std::vector<DroppedProposal> dropped;
};

struct LabelVote {
  PartIndex part;
  std::string label;  ///< "" when no reply names it
  int votes = 0;      ///< replies that say so
};

/// Counted over all replies.
struct NamesVote {
  std::string category;
  int category_votes = 0;
  std::string front;
  int front_votes = 0;
  int of = 0;  ///< replies
  std::vector<LabelVote> parts;
};

}  // namespace parsel
