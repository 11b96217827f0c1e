#include "core/infer/task.h"

namespace parsel {

namespace {
constexpr std::array<std::string_view, 4> task_names = {"seed_edit", "type_hints", "relation_validity_reflection",
                                                        "relation_validity_group"};
}  // namespace

std::string_view to_string(Task task) {
  return task_names[static_cast<std::size_t>(task)];
}

std::optional<Task> task_from_string(std::string_view text) {
  for (const Task task : all_tasks) {
    if (to_string(task) == text) return task;
  }
  return std::nullopt;
}

std::optional<Task> validity_task(RelationKind kind) {
  if (kind == RelationKind::reflection) return Task::relation_validity_reflection;
  if (kind == RelationKind::translation || kind == RelationKind::rotation) return Task::relation_validity_group;
  return std::nullopt;
}

bool is_validity(Task task) {
  return task == Task::relation_validity_reflection || task == Task::relation_validity_group;
}

}  // namespace parsel
