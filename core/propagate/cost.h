// What an edit of a part costs: one number, so that every choice of the search can be pointed at. Terms are sums over
// parts and relations and never negative, so that a partial search only grows dearer.
//
// The unit is an eighth of a joint that comes apart; everything is measured against that. Where each number comes from stands beside it; what the whole is worth, bench_ablation prints.
#pragma once

#include <optional>

#include "core/propagate/candidates.h"
#include "core/propagate/contact.h"

namespace parsel {

/// The prices. A struct, so that the ablation can set one to 0.
struct Prices {
  /// A joint whose parts come apart or enter each other. Below 5 the far legs of a table are left behind rather than
  /// stretched; above 12 everything is dragged along rather than let one joint go.
  double broken_joint = 8;
  /// … on top, for each half-diagonal by which it is off, so that of two edits that break it the nearer is taken.
  double broken_by = 20;
  /// A joint that slides along its face and stays on it. Dearer than a part that follows (a seat's legs go along), cheaper
  /// than a symmetry (legs under a fixed top move in on both sides).
  double slide = 3;
  /// … where one of its parts was asked to move as a whole: a shelf between its walls. Cheaper than
  /// to stretch what it slides along; chosen between the two.
  double asked_slide = 1;
  /// … on top, for the share of the contact that is gone.
  double slide_lost = 4;
  /// A joint that turns about an edge of its contact: what a door or a lid does. Cheaper than to slide, dearer than what
  /// keeps the whole joint; chosen, not measured.
  double hinge = 1.5;
  /// … unless neither of its parts was asked to turn: a side panel that leaves the front of its shelves is seen.
  double unasked_hinge = 5;
  double broken_mirror = 4;
  /// … of a part that was asked to do something: who wants it on one side only says so. Dearer than a joint.
  double broken_asked_mirror = 12;
  /// Mirror images one above the other: what stands on the floor grows away from it, and its upper half is seldom asked
  /// to do the opposite of the lower one.
  double broken_stacked_mirror = 1;
  /// Feet that leave the floor or sink into it; on top what a joint costs that is off by as much.
  double broken_ground = 5;
  /// What stands on the floor and is moved to another place, for its share of the shape's extent there: a leg goes where
  /// its table needs it, a whole cabinet does not follow its door. Chosen between the two, not measured against others.
  double dragged = 6;
  /// A relation that is off by less than its tolerance: for each half-diagonal. The mirror image of a part that was asked
  /// to do something costs more, as it has an edit of its own that is exact: legs get thicker on both sides, however
  /// little.
  double slack = 60, asked_mirror_slack = 240;
  /// A joint that holds at its points while the surfaces part or enter each other: at once, and for each half-diagonal.
  double seen = 0.6, seen_by = 40, seen_most = 4;
  /// A part that nothing follows exactly, off by less than a part at rest may be. Dearer than a translation that fits,
  /// cheaper than a turn: else the pole of a lamp turns with its shade.
  double slightly_off = 0.3;
  /// A slant, or an edge that bends: a last resort, but better than to tear a joint off. At 3 a whole chest slants rather
  /// than let one drawer slide out of it.
  double slant = 5;
  /// An edit of another kind than a hint asks for.
  double against_hint = 30;
  /// Staying at rest in spite of a hint.
  double rest_against_hint = 15;
  /// A rigid motion of everything, or of all that stands on the floor; all of a row doing what was asked of one: no
  /// answer.
  double all_rigid = 40;
};

/// What an edit of this kind costs before anything is known of its relations.
double price_of_kind(const Prices& prices, const Candidate& candidate, bool fills);

/// Change of a part's own shape: every axis by the logarithm of its stretch, a thin one more than the longest, so that
/// legs get longer rather than thicker. `deformed` at an end of the range.
double price_of_strain(const Corners& rest, const Corners& deformed);

/// Whether an edge has become so much longer or shorter that the part is not what it was: legs five times as thick are no
/// legs.
bool is_distorted(const Corners& rest, const Corners& deformed);

/// What is known of a relation beside its points.
struct RelationState {
  std::optional<ContactChange> contact;  ///< of a joint: what became of it
  bool is_asked_to_move = false;         ///< one of its parts is a seed
  bool is_asked_to_turn = false;         ///< one of its parts
  bool is_asked_to_shift = false;        ///< one of its parts, as a whole and without turning
};

/// How far two surfaces may come apart, or enter each other, without anyone seeing it.
inline constexpr double unseen = 0.004;
/// A joint that has lost more than this of its contact has come off.
inline constexpr double most_lost = 0.75;

/// A relation that its points miss by `residual`, allowed `tolerance`.
double price_of_relation(const Prices& prices, const Relation& relation, double residual, double tolerance,
                         const RelationState& state);

}  // namespace parsel
