// Replies and what they mean as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/infer/inference.h"

namespace parsel {

/// [{"task", "relation": id or null, "texts": [...]}] → replies. Error place is a JSON pointer: "/0/relation".
Result<std::vector<Replies>> replies_from_json(const Shape& shape, const nlohmann::json& json);

/// {"seed": {"outcome", "readings": [{"statements", "words", "votes"}], "of", "reason"}, "hints": [{"part", "hint",
/// "votes", "of"}], "relations": [{"relation", "keep", "votes", "of", "words"}], "proposals": {"requests":
/// [{"request", "changes": [ids], "keeps": [ids]}], "dropped": [{"request", "reason"}]}, "names": {"category", "category_votes", "front", "front_votes", "of", "parts":
/// [{"part", "label", "votes"}]}, "refused": [{"task", "relation",
/// "vote", "error"}], "edit": parsel/edit v1 or null}
nlohmann::json to_json(const Shape& shape, const Inference& inference);

}  // namespace parsel
