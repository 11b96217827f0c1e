// What the parts of a model without names are called, what it is and where its front is, as a language model says that
// is given sizes, places and relations only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/infer/task.h"
#include "core/infer/votes.h"

namespace parsel {

/// What one reply says. Parts are those of named_parts(), in its order.
struct SuggestedNames {
  std::string category;
  std::string front;                ///< "+z", "-z", "+x" or "-x"
  std::vector<std::string> labels;  ///< "" for a part that the reply leaves out
};

/// The parts that are asked for: each real one, but for the instances of groups of more than eight, which their virtual
/// part stands for; what is said of it holds for all of them.
std::vector<PartIndex> named_parts(const Shape& shape);

/// The shape in words with part_1, part_2, … for the names of named_parts(): size and place of each, mirror images,
/// rows and rings, joints.
std::string describe_nameless(const Shape& shape);

/// {"category", "front", "parts": {"part_1": name}}. Refused: no name at all, a part that is not in the list, a front
/// that is none of the four, a name or category that is blank or longer than 60 characters. What says nothing of a part
/// ("part", "object", a number, a direction alone) counts as left out.
Result<SuggestedNames> read_names_reply(const Shape& shape, std::string_view reply);

/// For each part the label that most replies give, whose grouping keys count as one; where that is even, the one of the
/// reply that agrees with the others most.
NamesVote count_names(const Shape& shape, const std::vector<SuggestedNames>& replies);

extern const Task part_names_task;

}  // namespace parsel
