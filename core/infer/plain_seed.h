// What a clause of a plain request means for a shape: seed statements, hints, relations that give way. ParSEL §6.2.1 asks
// a language model for these; here simple rules answer, and say when they cannot.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/infer/plain_clause.h"
#include "core/infer/plain_facts.h"
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

/// The edit as the rest of the core takes it; nothing when resolve() refuses it.
std::optional<EditRequest> request_of(const Shape& shape, const PlainEdit& edit);

/// `clause` has its change and, where it inherits them from another one, its nouns. `pointed`: what "it" is.
Meant mean(const ShapeFacts& facts, const Clause& clause, const std::vector<PartIndex>& pointed);

/// Adds to an edit what a clause with `keeps` says. Answers a fault, or nothing.
std::string keep(const ShapeFacts& facts, const Clause& clause, PlainEdit& edit);

/// The parts that a noun means, its sides looked at; empty when the sides tell no part.
std::vector<PartIndex> chosen(const ShapeFacts& facts, const Noun& noun);

}  // namespace parsel
