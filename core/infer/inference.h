// All replies to one request, read, counted and put together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/infer/task.h"
#include "core/infer/votes.h"

namespace parsel {

/// The replies to one prompt: one text for each vote that arrived.
struct Replies {
  const Task* task = nullptr;
  AboutRelation relation;  ///< of the kind that the task asks about
  std::vector<std::string> texts;
};

/// A reply that could not be read; it does not count.
struct RefusedReply {
  const Task* task;
  AboutRelation relation;
  std::size_t vote;  ///< index into Replies::texts
  Error error;
};

/// What all replies mean: one member for what the replies to a task mean, counted.
struct Inference {
  SeedVote seed;
  std::vector<HintVote> hints;
  std::vector<RelationVote> relations;
  Proposals proposals;
  NamesVote names;
  std::vector<RefusedReply> refused;
  std::optional<EditRequest> edit;  ///< of the first reading; nothing when there is none
};

Inference infer(const Shape& shape, const std::vector<Replies>& replies);

}  // namespace parsel
