// What propagation starts from: seed edits, relations that shall not count, and hints. Format `parsel/edit` v1:
//   {"seed": [statements, amounts in x], "disabled": ["r1", "kind:reflection"], "hints": {"part id": "translate"}}
// "disabled" and "hints" may be left out, as may "format": "parsel/edit" with "version": 1. A part is named by its id
// or by node:<glTF node index>.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/propagate/candidates.h"

namespace parsel {

/// The parameter in the amounts of an edit request.
inline constexpr const char* edit_parameter = "x";

/// Well-formed, but not checked against any shape.
struct EditRequest {
  std::vector<Statement> seed;  ///< at least one
  std::vector<std::string> disabled;
  std::map<std::string, Hint> hints;
};

/// Untrusted JSON → request. Unknown keys are refused by name. Error place is a JSON pointer: "/seed/0/amount".
Result<EditRequest> edit_request_from_json(const nlohmann::json& json);
nlohmann::json to_json(const EditRequest& request);

/// A request with its names looked up in a shape.
struct ResolvedRequest {
  std::vector<Statement> seed;        ///< node:… replaced by ids
  std::vector<PartIndex> seed_parts;  ///< whose corners seed[i] moves; the parent for group operators
  /// How many of the seeds were asked for. The others change rows whose instances hang on those of a row that one of
  /// these changes, one on one, as handles on drawers: they change with it.
  std::size_t asked = 0;
  /// Reflections, attachments and grounds, with those of instances whose group's own attachment or ground is disabled,
  /// and the group relations that are dissolved.
  std::set<RelationIndex> disabled;
  std::set<RelationIndex> disabled_by_name;  ///< of these, the ones that the request itself disables
  /// Groups that a seed on an instance, or "disabled", takes apart, with those whose instances hang on theirs.
  std::vector<RelationIndex> dissolved;
  std::map<PartIndex, Hint> hints;
};

/// Refuses unknown parts and relations, kinds and nodes, operators without the fields they need, amounts without the
/// parameter, two different hints for one part, and seeds that treat a group both as one and as single instances.
Result<ResolvedRequest> resolve(const EditRequest& request, const Shape& shape);

}  // namespace parsel
