#include "core/propagate/propagate.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"
#include "core/edit/readable.h"
#include "core/propagate/alternatives.h"
#include "core/propagate/greedy.h"
#include "core/propagate/slider_span.h"
#include "core/propagate/transfer.h"

namespace parsel {

namespace {

/// What leans is looked at up to here, in radians: at 0.35 a leg that gets shorter under a leaning seat misses it by more
/// than a joint may, so that it is turned through the floor; at 0.15 all that hardly moves is left where it is. A door,
/// whose axis is nearer to the vertical than 45°, is looked at as far as anything.
constexpr double most_lean = 0.2;
/// Amounts that grow this much faster than the parameter are looked at closely; what is still faster may be refused.
constexpr double fastest = 4;

/// How far the search looks: ±limit where the amounts of what was asked are the parameter itself, and nearer where they
/// grow faster. "Twice as x" is the same edit as "x", so that the same parts follow; how far it goes is found later.
double limit_of(const Shape& shape, const ResolvedRequest& request, double limit) {
  constexpr int halvings = 30;
  double most = limit;
  for (const Statement& seed : request.seed) {
    if (!is_geometric(seed.op) || seed.op == Op::keep_fixed) continue;
    const bool is_lean = seed.op == Op::rotate && std::abs(to_step(shape, seed).what.direction.y()) <= upright_axis;
    const double allowed = is_lean ? std::min(limit, most_lean) : limit;
    const CompiledAmount amount = seed.amount.compile({edit_parameter});
    const auto is_within = [&](double x) {
      const double minus = -x;
      return !(std::max(std::abs(amount(&x)), std::abs(amount(&minus))) > allowed * (1 + exact));
    };
    if (is_within(most)) continue;
    double low = 0, high = most;
    for (int i = 0; i < halvings; ++i) {
      const double middle = (low + high) / 2;
      (is_within(middle) ? low : high) = middle;
    }
    most = std::max(low, limit / fastest);
  }
  return most;
}

}  // namespace

Result<Propagation> propagate(const Shape& shape, const EditRequest& request, const PropagateOptions& wanted,
                              const Progress& progress) {
  const auto resolved = resolve(request, shape);
  if (!resolved.ok()) return resolved.error();
  PropagateOptions options = wanted;
  options.limit = limit_of(shape, *resolved, wanted.limit);
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
