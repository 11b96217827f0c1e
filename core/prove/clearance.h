// What a person sees go wrong between two parts, whatever their relation says: parts that enter each other and did not at
// rest (a door that is opened into its shelves, an arm that runs into a back), and parts that touched and have come
// apart (a rung that has slid beyond the end of its stile).
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

/// Below these nobody sees anything; half-diagonals.
inline constexpr double seen_depth = 0.008, seen_gap = 0.014;
/// Of two parts that were apart, neither is anything seen while they have less in common than a cube of 0.027; two legs
/// whose whole sides meet have more, however little deep. Half-diagonals, cubed.
inline constexpr double seen_volume = 2e-5;

/// Parts are seen as their hexahedra, the instances of a group one by one. Two that overlap at rest, by more than half
/// of the thinner one's thickness or by delta_both_edited, are not looked at, as the box of a whole cabinet holds its
/// shelves; nor are two instances of one group, nor instances whose number the layer has changed. Parts that touched are
/// those that a joint ties; they are apart when their boxes are, or, across it, the patch in which their surfaces met.
///
/// The depth of an overlap is the smallest along the boxes' face normals and the cross products of their edges, and so is
/// a gap, but for the sign (Gottschalk, Lin and Manocha 1996, OBBTree, §5): depths are exact for boxes, gaps no larger
/// than they are; for sheared hexahedra, of which the mean edges count, a little more than the least.
class Clearance {
 public:
  /// `program` passed validate() for `shape`, which must live as long. Layers up to `layer` are applied, those before
  /// it at their values. `disabled`: relations that need not hold, as is_disabled() reads them (scope.h).
  Clearance(const Shape& shape, const Program& program, std::size_t layer, const std::set<std::string>& disabled);

  /// The first thing that is wrong where the layer's parameter is x, a clause for people; empty when nothing is:
  ///   * two parts, at least one of them edited, overlap deeper than at 0 by more than seen_depth, or, if they were apart
  ///     by seen_gap at 0, by more than seen_volume;
  ///   * two parts that are joined, at least one of them edited, are apart by seen_gap more than at 0, but for those whose
  ///     joint is disabled, and those that go with such two: a door's handle leaves the frame that the door leaves.
  /// Time grows with n log n of n parts and with the pairs whose bounding boxes overlap.
  std::string fault(double x) const;

  /// What is wrong at x is meant so, or was so from the start: those pairs are not looked at any more.
  void accept(double x);
  /// The same of parts that come apart. Whether there are others, which run into each other.
  bool accept_gaps(double x);

 private:
  struct Body {
    PartIndex part;
    RelationIndex group;  ///< of the shape's relations; their number when it is no instance
    Corners corners;
    Vec3 low, high;
  };
  struct Fault {
    PartIndex a, b;
    bool apart;
  };
  std::set<RelationIndex> meant_to_part(const std::set<std::string>& disabled) const;
  std::vector<Body> bodies(const State& state) const;
  State state_at(double x) const;
  bool is_instance(PartIndex part) const;
  bool has_changed_count(PartIndex part, const State& state) const;
  void find_overlaps(const std::vector<Body>& now, std::vector<Fault>& found) const;
  void find_gaps(const State& state, std::vector<Fault>& found) const;
  std::vector<Fault> faults(double x) const;

  const Shape& shape_;
  std::size_t layer_;
  Evaluator evaluator_;
  std::vector<double> values_;
  std::set<PartIndex> edited_;
  std::set<std::pair<PartIndex, PartIndex>> accepted_;
  std::vector<RelationIndex> dissolved_;
  State at_rest_;
  std::set<RelationIndex> meant_to_part_;  ///< joints
};

}  // namespace parsel
