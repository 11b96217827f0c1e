// The two tasks that propose requests: what a model could have sliders for (ParSEL §8.1, automatic proxydural modelling),
// and what else a request may mean (§8.2, shape variation families). Each proposal is then read like any request.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/infer/task.h"
#include "core/infer/votes.h"

namespace parsel {

inline constexpr int most_proposals = 12;
/// Characters that a proposed request may have.
inline constexpr std::size_t longest_proposal = 300;

/// {"requests": [{"request", "changes": [parts], "keeps": [parts]}, …]}; a reply that proposes nothing is refused. Dropped,
/// each with its reason: what is no request or too long, names parts that the shape does not have or none, says the same as
/// one before it, comes after the twelfth, and where `amounts` is false what holds a number. Tags and emphasis are taken
/// out of the texts.
Result<Proposals> read_proposals_reply(const Shape& shape, std::string_view reply, bool amounts);

/// Those of all replies, each once, in the order in which they came.
Proposals merge(const std::vector<Proposals>& replies);

extern const Task procedural_requests_task, request_variations_task;

}  // namespace parsel
