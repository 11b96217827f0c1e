// Analytical edit propagation: from seed edits to a whole editing program. ParSEL §5, supplement §4, algorithm 2.
//
// The loop: apply the seed edits; as long as a relation between an edited and an unedited part is broken, take the part
// with the most of them (ties by id; parts with a broken symmetry come first, unless it is of one above the other),
// find its edit and add it. Symmetry first: the mirror image of a mirrored neighbour's edit, if that keeps all
// relations to edited parts; then attachments, by solve_part(). Where neither keeps all, what breaks fewer is taken,
// and of equals what keeps the joints: two handles, one above the other, that are mirror images go up with their door
// rather than apart from it. A relation that an edit leaves broken is recorded and not chased.
//
// A second look, beyond the paper: when relations stay broken, or parts are kept in them by being distorted, single
// parts near them are made to stretch where they were moved, or the other way round, and the whole is searched again;
// what breaks fewest, then distorts fewest, is kept. The paper's loop never looks back, so that the side of a bed that
// was moved with its foot end tears off the head end, or its legs grow five times as thick to reach a panel that could
// be wider.
//
// What the departures from the paper are worth, on 2288 edits of 537 models of furniture: with mirror images first
// wherever they can be, parts that touched come apart by 60 half-diagonals in all; with joints first among equals by
// 38; with parts taken and distorted parts looked at as said above by 32, and 99.0 instead of 98.6 % of the relations
// are held.
//
// Alternatives, beyond the paper as well (alternatives.h): a rigid motion of everything holds every relation and is no
// answer, nor are feet in the air or a joint torn for want of sliding. Where the result is like that, a beam with one
// cost looks for a better one.
//
// Groups. The virtual parent of a translation or rotation group stands for its instances, until a seed on one of them,
// or "disabled", dissolves the group. Its extent follows its neighbours like that of any part; where it must spread
// along the row (or outwards) the spacing changes and the instances stay as they are: change_delta moves them rigidly,
// so it costs no deformation. The count follows only when a hint asks for it (change_count): a slider under which slats
// jump in and out is a surprise. Then change_delta is followed by a change_count that keeps the extent and brings the
// spacing nearest to what it was.
#pragma once

#include "core/base/progress.h"
#include "core/base/tolerance.h"
#include "core/edit/program.h"
#include "core/propagate/edit_request.h"
#include "core/propagate/trace.h"

namespace parsel {

struct PropagateOptions {
  std::string request;           ///< in words, for the program's layer
  std::string parameter = "x1";  ///< name of the program's parameter, which x in the request becomes
  double limit = tau;            ///< the search looks at ±limit; the range goes on from there (core/prove/reach.h)
  bool neighbour_edits = true;   ///< off for the ablation of ParSEL §7.3
  bool breaking_edits = true;    ///< likewise
  bool revisions = true;         ///< likewise: a second look at parts near relations that stay broken
  bool alternatives = true;      ///< likewise: what a careful person would have done instead
};

struct Propagation {
  Program program;  ///< one layer
  Trace trace;
};

/// Deterministic. Fails when the request does not fit the shape (see resolve()), when a seed's amount is undefined at
/// or near 0, or inverts its own part at once, or when the
/// program would be larger than its readers take (core/edit/readable.h). A shape without relations gives the seed alone, and a trace that says
/// why.
Result<Propagation> propagate(const Shape& shape, const EditRequest& request, const PropagateOptions& options = {},
                              const Progress& progress = {});

}  // namespace parsel
