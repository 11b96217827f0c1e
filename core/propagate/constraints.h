// What a part must follow: the relations that tie it to edited parts, as points with prescribed motions. ParSEL §5.2.
//
// Attachments and reflections are both ‖W·d − r(x)‖∞ ≤ δ with W the weights of a point in the part's hexahedron, d the
// displacements of its corners, and r the displacement that the other part prescribes: that of the same point of the
// other hexahedron (attachment), or the mirrored one of the image corner (reflection).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "core/propagate/motion.h"

namespace parsel {

/// The edit of one part.
struct PartEdit {
  std::vector<Step> steps;  ///< empty for keep_fixed
  Motion motion;
};
/// Only edited parts have one, keep_fixed included. Shared, because the states of a search have most of them in common.
using Edits = PartData<std::shared_ptr<const PartEdit>>;

struct PointConstraint {
  RelationIndex relation;
  Weights weights;                      ///< of the point in the part
  std::array<Vec3, sample_count> goal;  ///< its prescribed displacement
  PartIndex other;                      ///< the edited part
  Weights other_weights;
  std::optional<Vec3> mirror;  ///< reflection: unit normal of the plane
};

/// The relations of the graph that count now, and for each part those that it is in.
class Graph {
 public:
  Graph(const Shape& shape, const std::vector<RelationIndex>& dissolved, const std::set<RelationIndex>& disabled);

  const Shape& shape() const { return *shape_; }
  /// In the order of their indices.
  const std::vector<PartIndex>& parts() const { return parts_; }
  /// Reflections and attachments of a part.
  const std::vector<RelationIndex>& relations(PartIndex part) const { return of_part_[part]; }
  /// The part at the other end.
  PartIndex other(RelationIndex relation, PartIndex part) const;

 private:
  const Shape* shape_;
  std::vector<PartIndex> parts_;
  PartData<std::vector<RelationIndex>> of_part_;
};

/// The constraints that one relation to an edited part puts on `part`.
void add_constraints(const Graph& graph, RelationIndex relation, PartIndex part, const Edits& edits,
                     std::vector<PointConstraint>& constraints);

/// Largest |coordinate| by which the motion misses the goal, over all samples.
double residual(const PointConstraint& constraint, const Motion& motion);
/// The same for every relation, in the order of the constraints; those of one relation must follow each other.
using RelationResiduals = std::vector<std::pair<RelationIndex, double>>;
RelationResiduals residuals(const std::vector<PointConstraint>& constraints, const Motion& motion);

/// One coordinate of a goal in closed form. Keeps the closed forms of edited parts for the next call.
class SymbolicGoals {
 public:
  explicit SymbolicGoals(const Graph& graph) : graph_(&graph) {}
  GiNaC::ex operator()(const PointConstraint& constraint, const Edits& edits, std::size_t coordinate);

 private:
  const Graph* graph_;
  std::map<std::shared_ptr<const PartEdit>, SymbolicMotion> known_;
};

}  // namespace parsel
