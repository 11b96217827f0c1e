// What a plain request comes to: edits that may be meant, or why there is none.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/infer/plain_clause.h"
#include "core/propagate/edit_request.h"

namespace parsel {

/// What the slider shall be set to.
struct PlainTarget {
  std::string part;  ///< an id; empty for the whole
  std::string what;  ///< "width", "height", "depth", "distance", "angle", "count", "spacing", "size"
  HowMuch how_much;  ///< in metres, radians, pieces or as a ratio; `by` has its sign
  double x = 0;      ///< the slider's value as far as the seed alone tells
};

struct PlainEdit {
  std::vector<Statement> statements;
  std::map<std::string, Hint> hints;
  std::set<RelationIndex> loose;
  std::optional<PlainTarget> target;
};

/// One edit, or several that may be meant, or none and why.
struct Meant {
  std::vector<PlainEdit> edits;
  std::string fault;  ///< a clause without a full stop; with edits: why none of them is certain
};

}  // namespace parsel
