// What a clause of a plain request means for a shape: seed statements, hints, relations that give way. ParSEL §6.2.1 asks
// a language model for these; here simple rules answer, and say when they cannot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/infer/plain_clause.h"
#include "core/infer/plain_edit.h"
#include "core/infer/plain_facts.h"

namespace parsel {

/// The edit as the rest of the core takes it; nothing when resolve() refuses it.
std::optional<EditRequest> request_of(const Shape& shape, const PlainEdit& edit);

/// `clause` has its change and, where it inherits them from another one, its nouns. `pointed`: what "it" is.
Meant mean(const ShapeFacts& facts, const Clause& clause, const std::vector<PartIndex>& pointed);

/// Adds to an edit what a clause with `keeps` says. Answers a fault, or nothing.
std::string keep(const ShapeFacts& facts, const Clause& clause, PlainEdit& edit);

/// The parts that a noun means, its sides looked at; empty when the sides tell no part.
std::vector<PartIndex> chosen(const ShapeFacts& facts, const Noun& noun);

}  // namespace parsel
