// What the language model is asked: ParSEL §6.2.1, supplement §5.2. Each task has a template (prompts/<task>.md) and a
// schema of its reply (prompts/<task>.schema.json), both compiled in.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "core/shape/shape.h"

namespace parsel {

enum class Task { seed_edit, type_hints, relation_validity_reflection, relation_validity_group };
inline constexpr std::array all_tasks = {Task::seed_edit, Task::type_hints, Task::relation_validity_reflection,
                                         Task::relation_validity_group};

std::string_view to_string(Task task);
std::optional<Task> task_from_string(std::string_view text);

/// The task that asks whether a relation of this kind shall be kept; nothing for attachments, which are never asked.
std::optional<Task> validity_task(RelationKind kind);
/// Whether the task is asked about one relation.
bool is_validity(Task task);

}  // namespace parsel
