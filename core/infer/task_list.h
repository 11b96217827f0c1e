// All tasks that a language model is asked about a shape.
#pragma once

#include <span>
#include <string_view>

#include "core/infer/task.h"

namespace parsel {

/// Every task, in the order in which they are asked.
std::span<const Task* const> all_tasks();

/// Null when there is none.
const Task* find_task(std::string_view name);
/// The task that asks whether a relation of this kind shall be kept; null for attachments, which are never asked.
const Task* task_about(RelationKind kind);

}  // namespace parsel
