// The edits that one part could get, and what each would cost: ParSEL §5.3 and §5.3.1 with one cost instead of an order
// of attempts.
//
// Proposals come from sources: staying at rest, the mirror image of a mirrored neighbour's edit, the part's own
// operators and what its neighbours do (candidates.h), those with the points and axes of neighbours, pairs of operators.
// The amount of each is fitted numerically (screen.h) to what ties the part to edited parts: to all of it, and where
// that cannot be met to all but the floor, to the joints alone, and to single relations, so that a part that cannot keep
// everything keeps what is dear (minimally breaking edits, §5.3.1). Only the cheapest reach the algebra (closed_form.h).
//
// Sources are asked in the order of what their proposals cost at least, and no further than the cheapest so far.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/propagate/closed_form.h"
#include "core/propagate/cost.h"
#include "core/propagate/footing.h"
#include "core/propagate/select.h"
#include "core/propagate/trace.h"

namespace parsel {

struct ProposalOptions {
  bool neighbour_edits = true;  ///< off for the ablation of ParSEL §7.3
  bool breaking_edits = true;   ///< likewise: amounts that only some of the relations ask for
  Prices prices;
  std::size_t proposals = 3;  ///< how many are brought into closed form
};

/// What the search knows.
struct Problem {
  const Graph& graph;
  SymbolicGoals& goals;
  std::string parameter;
  Samples at;
  ProposalOptions options;
  RelationData<JointContact> contacts;        ///< of the joints
  PartData<std::optional<Footing>> footings;  ///< of the parts that stand on the floor
  std::set<PartIndex> asked;                  ///< parts that were asked to do something, and their mirror images
  std::set<PartIndex> turning;                ///< … to turn, by a seed or a hint
  std::set<PartIndex> shifted;                ///< … to move as a whole
  /// Candidates fitted so far, each once for every set of constraints: what the search costs, about a million a second.
  mutable std::size_t work = 0;
};

struct Proposal {
  WhyKind kind = WhyKind::attachment;
  bool rest = false;        ///< stays as it is; no steps
  std::vector<Step> steps;  ///< in closed form
  Motion motion;
  double cost = 0;
  std::string why;     ///< a sentence
  std::string source;  ///< "mirror", "own", …, for the trace
};

/// What the part's relations to edited parts and the floor cost when it moves so. `constraints`: those of one relation
/// together.
double price_of_relations(const Problem& problem, const Edits& edits, PartIndex part,
                          const std::vector<PointConstraint>& constraints, const Motion& motion);

/// The cheapest edits of the part, cheapest first, at most ProposalOptions::proposals; staying at rest is among those that
/// compete. `constraints` holds every relation of the part to an edited part, those of one relation together. Fills the
/// search's numbers into `trace`.
std::vector<Proposal> propose(const Problem& problem, const Edits& edits, PartIndex part,
                              const std::optional<Hint>& hint, const std::vector<PointConstraint>& constraints,
                              TraceStep& trace);

}  // namespace parsel
