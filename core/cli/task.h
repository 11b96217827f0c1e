// The options --task and --relation.
#pragma once

#include <optional>

#include "core/cli/command.h"
#include "core/infer/task.h"

namespace parsel::cli {

struct AskedTask {
  const Task* task = nullptr;
  AboutRelation relation;
};

/// Refuses unknown tasks and relations, and a validity task without a relation of its kind: the fix lists them.
Result<AskedTask> asked_task(const Arguments& arguments, const Shape& shape);

}  // namespace parsel::cli
