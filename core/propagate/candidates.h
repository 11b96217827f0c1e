// The candidate edits of one part: operators whose parameters come from features of hexahedra. ParSEL §5.3, supplement
// §4.2 and §4.2.1. Only the amount is open.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/propagate/constraints.h"

namespace parsel {

/// What a person or the language model asks of a part's edit.
enum class Hint { translate, rotate, scale, shear, change_count, change_delta, keep_fixed };
std::optional<Hint> hint_from_string(std::string_view text);
std::string_view to_string(Hint hint);

/// Whether an edit is of the kind that a hint asks for: `translate` moves the part as it is; `rotate` and `shear` tilt it,
/// by a turn, a slant, or an end that moves sideways; `scale` stretches it, from one side as well. `symmetry_cost` as in
/// Candidate.
bool allows(const std::optional<Hint>& hint, const ResolvedOperator& what, int symmetry_cost);

struct Candidate {
  ResolvedOperator what;
  Anchor anchor = Anchor::middle;  ///< change_delta
  Corners field;                   ///< unit_field() or group_field()
  /// How many intrinsic symmetry planes of a box the edit gives up (supplement §4.2.2): 0 translate, rotate, scales of
  /// the part, moving a face along its normal, group operators; 1 scaling a face; 2 shear and what bends edges.
  int symmetry_cost = 0;
  bool from_neighbour = false;  ///< its parameters are features of another part
};

/// Whether a group that must grow along its row (or outwards) should stretch its instances rather than part them: they
/// fill the row like drawers, covering more than 3/4 of their spacing, or reach inwards like spokes, over more than
/// half of the radius to either side. What fills a space goes on filling it.
bool fills_its_extent(const Shape& shape, PartIndex parent);

/// Operators × the 27 points of the part × its own and the global axes × features, one for each displacement field.
/// A virtual part offers change_delta as well. `hint` filters by operator; change_count admits change_delta, whose
/// count then follows (see propagate.h).
std::vector<Candidate> own_candidates(const Shape& shape, PartIndex part, const std::optional<Hint>& hint);

/// What the edited neighbours do, done to the part as a whole.
std::vector<Candidate> transplants(const Shape& shape, PartIndex part, const std::optional<Hint>& hint,
                                   const std::vector<PointConstraint>& constraints, const Edits& edits);

/// For want of a solution among these: whole-part operators with the points and axes of the edited neighbours, and
/// translations along the line that joins the two parts or along the motion asked for.
std::vector<Candidate> neighbour_candidates(const Shape& shape, PartIndex part, const std::optional<Hint>& hint,
                                            const std::vector<PointConstraint>& constraints, const Edits& edits);

}  // namespace parsel
