// All replies to one request, read, counted and put together.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/infer/edit_assembly.h"
#include "core/infer/part_names.h"
#include "core/infer/proposals.h"
#include "core/infer/seed_edit.h"

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

/// [{"task", "relation": id or null, "texts": [...]}] → replies. Error place is a JSON pointer: "/0/relation".
Result<std::vector<Replies>> replies_from_json(const Shape& shape, const nlohmann::json& json);

/// {"seed": {"outcome", "readings": [{"statements", "words", "votes"}], "of", "reason"}, "hints": [{"part", "hint",
/// "votes", "of"}], "relations": [{"relation", "keep", "votes", "of", "words"}], "proposals": {"requests":
/// [{"request", "changes": [ids], "keeps": [ids]}], "dropped": [{"request", "reason"}]}, "names": {"category", "category_votes", "front", "front_votes", "of", "parts":
/// [{"part", "label", "votes"}]}, "refused": [{"task", "relation",
/// "vote", "error"}], "edit": parsel/edit v1 or null}
nlohmann::json to_json(const Shape& shape, const Inference& inference);

}  // namespace parsel
