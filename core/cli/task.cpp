#include "core/cli/task.h"

#include "core/infer/cad_task.h"
#include "core/infer/task_list.h"
#include "core/shape/words.h"

namespace parsel::cli {

Result<AskedTask> asked_task(const Arguments& arguments, const Shape& shape) {
  const std::string name = arguments.option("--task"), id = arguments.option("--relation");
  const Task* task = find_task(name);
  if (task == nullptr) {
    std::string all;
    for (const Task* known : all_tasks()) all += (all.empty() ? "" : ", ") + std::string(known->name);
    for (const CadTask* known : all_cad_tasks()) all += ", " + std::string(known->name) + " (of a CAD program)";
    return Error{"cli", "--task", "there is no task '" + name + "'", "use one of " + all};
  }
  if (!task->asks_about) {
    if (id.empty()) return AskedTask{task, {}};
    return Error{"cli", "--relation", "the task " + name + " is not about one relation", "leave --relation out"};
  }
  std::string fitting;
  for (const RelationIndex r : active_relations(shape)) {
    if (!task->asks_about(shape.relations[r].kind)) continue;
    if (shape.relations[r].id == id) return AskedTask{task, r};
    fitting += "\n  " + shape.relations[r].id + ": " + describe(shape, r);
  }
  const std::string cause =
      id.empty() ? "the task " + name + " is about one relation" : "'" + id + "' is no such relation";
  if (fitting.empty()) return Error{"cli", "--relation", cause, "the model has none to ask about: use another task"};
  return Error{"cli", "--relation", cause, "give one of" + fitting};
}

}  // namespace parsel::cli
