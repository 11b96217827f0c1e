// The search for the edits of all parts: a beam over partial assignments with one cost (cost.h). ParSEL §5.2, algorithm
// 2, whose loop is the beam of width 1.
//
// A state holds the edits found so far. Every round takes, in each state, the unedited part with the most broken
// relations (one with a broken mirror image side by side first, then one that has a hint; ties by id), and continues the
// state by the cheapest proposals for it (solve_part.h). The cheapest states are kept. Costs only grow, so what is
// dearer than a finished state is dropped.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "core/base/progress.h"
#include "core/propagate/edit_request.h"
#include "core/propagate/proposals.h"

namespace parsel {

/// One part decided upon.
struct Decision {
  std::shared_ptr<const Decision> before;
  PartIndex part;
  Proposal chosen;
  bool left_alone = false;  ///< at rest, off by less than a part may be: looked at again when more pulls at it
  TraceStep trace;
};

struct SearchState {
  Edits edits;
  double cost = 0;  ///< of all decisions
  double loss = 0;  ///< of it, what relations and the floor are off by
  std::shared_ptr<const Decision> last;
};

/// What a search may not change.
struct Restriction {
  std::set<PartIndex> held;  ///< parts that stay as they are
  bool feet_stay = false;    ///< feet do not even slide on the floor
};

/// Problem::work of a whole search: about a third of a second natively. With more, models of a hundred parts keep people
/// waiting for seconds.
inline constexpr std::size_t most_work = 300'000;

struct SearchOptions {
  std::size_t width = 4;  ///< states kept in a round
  /// How many parts may be looked at in all, over all states: wide beams on large models become narrow.
  std::size_t looks = 120;
  /// Problem::work at which the search gives up. Work, not time: the same input gives the same program everywhere.
  std::size_t work = most_work;
};

/// The cheapest state found from `seeds`, the edits of the seed parts; nothing when all are dearer than `limit`, or when the work is used up.
/// Deterministic. Progress names the part looked at.
std::optional<SearchState> search(const Problem& problem, const Edits& seeds, const std::map<PartIndex, Hint>& hints,
                                  const Restriction& restriction, const SearchOptions& options, double limit,
                                  const Progress& progress);

}  // namespace parsel
