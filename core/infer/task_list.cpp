#include "core/infer/task_list.h"

#include <algorithm>
#include <array>

#include "core/infer/part_names.h"
#include "core/infer/proposals.h"
#include "core/infer/relation_validity.h"
#include "core/infer/seed_edit.h"
#include "core/infer/type_hints.h"

namespace parsel {

std::span<const Task* const> all_tasks() {
  static constexpr std::array all = {&seed_edit_task,
                                     &type_hints_task,
                                     &relation_validity_reflection_task,
                                     &relation_validity_group_task,
                                     &procedural_requests_task,
                                     &request_variations_task,
                                     &part_names_task};
  return all;
}

const Task* find_task(std::string_view name) {
  const auto tasks = all_tasks();
  const auto found = std::find_if(tasks.begin(), tasks.end(), [&](const Task* task) { return task->name == name; });
  return found == tasks.end() ? nullptr : *found;
}

const Task* task_about(RelationKind kind) {
  const auto tasks = all_tasks();
  const auto found = std::find_if(tasks.begin(), tasks.end(),
                                  [&](const Task* task) { return task->asks_about && task->asks_about(kind); });
  return found == tasks.end() ? nullptr : *found;
}

}  // namespace parsel
