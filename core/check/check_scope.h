// The checker's own idea of which relations a program must report; see scope.h for the rules. Internal to the checker.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel::replay {

struct Ties {
  std::set<std::string> moved;      ///< part ids
  std::set<std::string> dissolved;  ///< group ids
  std::set<std::string> due;        ///< relation ids that must be reported
};

/// After the first `layers` layers; `disabled`: relation ids.
Ties ties_of(const Shape& shape, const Program& program, std::size_t layers, const std::set<std::string>& disabled);

/// Whether a relation other than a group, or a group, counts while `dissolved` groups are taken apart.
bool counts(const Shape& shape, const Relation& relation, const std::set<std::string>& dissolved);

/// 0.025/√3 or 0.075/√3.
double tolerance(const Shape& shape, const Relation& relation, const std::set<std::string>& moved);

}  // namespace parsel::replay
