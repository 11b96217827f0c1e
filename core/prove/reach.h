// How far a layer's slider goes, and what is proved of the relations over all of it.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/prove/range.h"
#include "core/shape/shape.h"

namespace parsel {

/// Beyond the range that the search looked at, a relation may be off by this, or by as much as it is within that range:
/// an inexact edit stays as good as it is, and an exact one may begin to drift, but not so that one sees it.
/// Half-diagonals.
inline constexpr double clean_drift = 0.005;

struct SliderReach {
  Range range;                            ///< with the reasons of its ends
  std::vector<RelationReport> relations;  ///< over the range, as prove_relations() gives them
};

/// The widest range of the layer's parameter that find_range() finds within [low, high], in which no parts are seen to run
/// into each other or to come apart (clearance.h; parts that come apart within ±0.1 already end nothing; where parts run
/// into each other so early on both sides, both go on to ±`least`), and on which, beyond ±`least`,
///   * every relation that holds within ±`least` is off by no more than there or clean_drift, and holds, certified if
///     it is there.
/// The joints of instances of a group, which slide along their neighbours where the row spreads, may use all of their
/// tolerance. So no relation is held, or certified, in ±`least` alone. What is broken there, or disabled, ends nothing.
/// Ends that are found, by 24 steps a side and bisection, are rounded towards 0 to four decimals; when a proof then finds
/// more between the steps, or none, the part beyond ±`least` is halved, three times at most, and then given up.
///
/// `program` passed validate() for `shape`, but for the layer's range, which counts for nothing; low <= -least < 0 <
/// least <= high.
SliderReach reach_of_layer(const Shape& shape, const Program& program, std::size_t layer,
                           const std::set<std::string>& disabled, double least, double low, double high);

}  // namespace parsel
