// The checker's own idea of which relations a program must report, and of how far they may be off; see
// core/prove/scope.h and slack.h for the rules. Internal to the checker, which shares neither: a rule taken from what
// it checks would check nothing.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/check/replay.h"
#include "core/check/tie.h"

namespace parsel::replay {

struct Ties {
  std::set<PartIndex> moved;
  std::set<RelationIndex> dissolved;  ///< groups
  std::set<RelationIndex> due;        ///< relations that must be reported
};

/// After the first `layers` layers; `disabled`: relations.
Ties ties_of(const Replay& replay, std::size_t layers, const std::set<RelationIndex>& disabled);

/// Relations that a layer's reports call disabled; unknown ids are left out.
std::set<RelationIndex> disabled_in(const Replay& replay, const Layer& layer);

/// Whether a part counts as itself while `dissolved` groups are taken apart: a group's parent while the group stands,
/// an instance while it does not.
bool counts(const Part& part, const std::set<RelationIndex>& dissolved);
/// Whether the search must follow a relation: a group that stands, or one of parts that count.
bool counts(const Shape& shape, RelationIndex relation, const std::set<RelationIndex>& dissolved);

/// 0.025/√3 or 0.075/√3.
double tolerance(const Relation& relation, const std::set<PartIndex>& moved);

/// Parameter values of a layer at which the checker looks: 201 even ones, ends included, and 40 random ones.
std::vector<double> looked_at(const Parameter& parameter, std::size_t layer);

/// Every layer's parameter at its value.
Values values_of(const Program& program);

}  // namespace parsel::replay
