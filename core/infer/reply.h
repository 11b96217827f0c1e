// What one reply of the language model means: forgiving about form (see json_block.h), strict about meaning. A reply
// can only name parts and relations of the shape and operators of the language. Any bytes give a value or an error.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/infer/task.h"
#include "core/propagate/edit_request.h"

namespace parsel {

/// Either statements (ids of the shape, amounts in x, all that resolve() asks for) or the reason why there are none.
struct SeedReply {
  std::vector<Statement> statements;
  std::string unclear;  ///< the model's words, printable, at most 300 bytes
};

/// {"edits": [statement, …]} or {"unclear": "why"}. A statement is one of `parsel/edit`, or says the same more loosely:
/// directions as "x", "-y", "up", features and origins as "top" or "front left", amounts and origins left out (the
/// amount is then x, for a count 8*x; the origin is the middle of the feature).
Result<SeedReply> read_seed_reply(const Shape& shape, std::string_view reply);

/// {"hints": {"part": type, …}}; empty when no part needs one. Keys are ids of the shape.
Result<std::map<std::string, Hint>> read_hints_reply(const Shape& shape, std::string_view reply);

/// {"keep": true | false} about the relation.
Result<bool> read_validity_reply(const Shape& shape, RelationIndex relation, std::string_view reply);

}  // namespace parsel
