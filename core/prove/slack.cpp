#include "core/prove/slack.h"

#include "core/base/tolerance.h"

namespace parsel {

double tolerance_of(const Relation& relation, bool moves_a, bool moves_b) {
  if (relation.kind == RelationKind::ground) return delta_one_edited;
  return relation.is_group() || (moves_a && moves_b) ? delta_both_edited : delta_one_edited;
}

Slack slack_of(const Relation& relation, double residual, bool moves_a, bool moves_b) {
  // Not `residual > …`: what is no number is broken.
  if (!(residual <= tolerance_of(relation, moves_a, moves_b))) return Slack::broken;
  if (residual <= exact) return Slack::tight;
  if (residual <= delta_one_edited / 2) return Slack::half;
  return residual <= delta_one_edited ? Slack::one : Slack::two;
}

}  // namespace parsel
