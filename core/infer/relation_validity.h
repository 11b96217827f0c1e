// The tasks that ask whether a relation shall be kept: one for reflections, one for groups. ParSEL §6.2.1.
#pragma once

#include <string_view>
#include <vector>

#include "core/infer/task.h"
#include "core/infer/votes.h"

namespace parsel {

/// {"keep": true | false} about the relation.
Result<bool> read_validity_reply(const Shape& shape, RelationIndex relation, std::string_view reply);

RelationVote vote(RelationIndex relation, const std::vector<bool>& keeps);

extern const Task relation_validity_reflection_task, relation_validity_group_task;

}  // namespace parsel
