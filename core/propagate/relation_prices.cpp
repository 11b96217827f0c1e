// price_of_relations() of proposals.h.
#include "core/base/tolerance.h"
#include "core/propagate/proposals.h"
#include "core/prove/slack.h"

namespace parsel {

double price_of_relations(const Problem& problem, const Edits& edits, PartIndex part,
                          const std::vector<PointConstraint>& constraints, const Motion& motion) {
  const Shape& shape = problem.graph.shape();
  const Prices& prices = problem.options.prices;
  const bool moves = largest_difference(motion, still()) > noise;
  double cost = 0;
  for (const auto& [index, by] : residuals(constraints, motion)) {
    const Relation& relation = shape.relations[index];
    const PartIndex other = problem.graph.other(index, part);
    const double tolerance = tolerance_of(relation, moves, !edits[other]->steps.empty());
    RelationState state;
    state.is_asked_to_move = problem.asked.count(part) > 0 || problem.asked.count(other) > 0;
    state.is_asked_to_shift = problem.shifted.count(part) > 0 || problem.shifted.count(other) > 0;
    state.is_asked_to_turn = problem.turning.count(part) > 0 || problem.turning.count(other) > 0;
    const JointContact& contact = problem.contacts[index];
    const auto change = [&](PartIndex first, const Motion& its, PartIndex second, const Motion& others) {
      return worst_change(contact, shape.parts[first].hexahedron.corners, its, shape.parts[second].hexahedron.corners,
                          others);
    };
    const Motion& of_other = edits[other]->motion;
    state.contact =
        relation.parts[0] == part ? change(part, motion, other, of_other) : change(other, of_other, part, motion);
    cost += price_of_relation(prices, relation, by, tolerance, state);
  }
  if (const auto& footing = problem.footings[part]) cost += price_of_footing(prices, *footing, motion);
  return cost;
}

}  // namespace parsel
