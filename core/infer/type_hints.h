// The task that asks for type hints: how parts beyond the seed should change. ParSEL §6.2.1.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/infer/task.h"
#include "core/infer/votes.h"

namespace parsel {

/// {"hints": {"part": type, …}}; empty when no part needs one. Keys are ids of the shape.
Result<std::map<std::string, Hint>> read_hints_reply(const Shape& shape, std::string_view reply);

/// Type hints are kept when at least this share of the replies gives them.
inline constexpr double hint_share = 0.6;

/// The hints kept, by part.
std::vector<HintVote> vote(const std::vector<std::map<std::string, Hint>>& replies);

extern const Task type_hints_task;

}  // namespace parsel
