// Whether parts enter each other that do not at rest: a door that is opened into its shelves, an arm that runs into a
// back. Relations say nothing of parts that are not joined, and of joined ones only what becomes of the joint's points.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

/// Parts are seen as their hexahedra, the instances of a group one by one. Two that overlap at rest, by more than half
/// of the thinner one's thickness or by delta_both_edited, are not looked at, as the box of a whole cabinet holds its
/// shelves; nor are two instances of one group, nor instances whose number the layer has changed.
///
/// The depth of an overlap is the smallest along the boxes' face normals and the cross products of their edges
/// (Gottschalk, Lin and Manocha 1996, OBBTree, §5): exact for boxes; for sheared hexahedra, of which the mean edges
/// count, a little more than the least.
class Clearance {
 public:
  /// `program` passed validate() for `shape`, which must live as long. Layers up to `layer` are applied, those before
  /// it at their values.
  Clearance(const Shape& shape, const Program& program, std::size_t layer);

  /// Which part has entered which where the layer's parameter is x, a clause for people; empty when none has: no two
  /// parts, at least one of them edited, overlap deeper than at 0 by more than the thickness said above. Time grows
  /// with n log n of n parts and with the pairs whose bounding boxes overlap.
  std::string fault(double x) const;

 private:
  struct Body {
    PartIndex part;
    RelationIndex group;  ///< of the shape's relations; their number when it is no instance
    Corners corners;
    Vec3 low, high;
  };
  std::vector<Body> bodies(const State& state) const;
  State state_at(double x) const;

  const Shape& shape_;
  std::size_t layer_;
  Evaluator evaluator_;
  std::vector<double> values_;
  std::set<PartIndex> edited_;
  std::vector<RelationIndex> dissolved_;
  State at_rest_;
};

}  // namespace parsel
