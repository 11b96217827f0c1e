#include "core/cli/task.h"

#include "core/shape/words.h"

namespace parsel::cli {

Result<AskedTask> asked_task(const Arguments& arguments, const Shape& shape) {
  const std::string name = arguments.option("--task"), id = arguments.option("--relation");
  const auto task = task_from_string(name);
  if (!task) {
    std::string all;
    for (const Task known : all_tasks) all += (all.empty() ? "" : ", ") + std::string(to_string(known));
    return Error{"cli", "--task", "there is no task '" + name + "'", "use one of " + all};
  }
  if (!is_validity(*task)) {
    if (id.empty()) return AskedTask{*task, {}};
    return Error{"cli", "--relation", "the task " + name + " is not about one relation", "leave --relation out"};
  }
  std::string fitting;
  for (const RelationIndex r : active_relations(shape)) {
    if (validity_task(shape.relations[r].kind) != *task) continue;
    if (shape.relations[r].id == id) return AskedTask{*task, r};
    fitting += "\n  " + shape.relations[r].id + ": " + describe(shape, r);
  }
  const std::string cause =
      id.empty() ? "the task " + name + " is about one relation" : "'" + id + "' is no such relation";
  if (fitting.empty()) return Error{"cli", "--relation", cause, "the model has none to ask about: use another task"};
  return Error{"cli", "--relation", cause, "give one of" + fitting};
}

}  // namespace parsel::cli
