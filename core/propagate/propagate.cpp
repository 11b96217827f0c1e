#include "core/propagate/propagate.h"

#include "core/edit/readable.h"
#include "core/propagate/alternatives.h"
#include "core/propagate/greedy.h"

namespace parsel {

Result<Propagation> propagate(const Shape& shape, const EditRequest& request, const PropagateOptions& options,
                              const Progress& progress) {
  const auto resolved = resolve(request, shape);
  if (!resolved.ok()) return resolved.error();
  auto first = search_greedily(shape, *resolved, options, progress);
  if (!first.ok()) return first.error();
  std::unique_ptr<Attempt> best = std::move(first.value());
  if (options.alternatives) {
    if (auto other = better_alternative(shape, *resolved, options, best->edits(), progress)) best = std::move(other);
  }
  Propagation result = best->finish();
  if (Status status = readable(result.program, shape); !status.ok()) return status.error();
  return result;
}

}  // namespace parsel
