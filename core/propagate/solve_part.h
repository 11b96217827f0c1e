// The analytical edit solver: finds the edit of one part that follows its edited neighbours. ParSEL §5.3 and §5.3.1.
//
// Screen with numbers, solve with algebra: every candidate is fitted numerically at the samples (screen.h); survivors
// are ranked (select.h), and in that order brought into closed form (closed_form.h) until one succeeds. The first of
// these searches that finds an edit ends it ("own" includes what the neighbours do, done to this part):
//    1. own translations, within `exact`; then a part that is off by no more than delta_one_edited is left alone
//    2. own rigid edits (translate, rotate, change of spacing) within `exact`, translations within half
//    delta_one_edited
//    3. a group that does not fill its extent: a translation with a change of spacing, within `exact`
//    4. own candidates without shear and bent edges, then neighbour candidates, then pairs of operators, within `exact`
//    5. the first of these within delta_one_edited
//    6. shear and bent edges, own and of neighbours, within `exact`
//    7. everything within delta_one_edited, then delta_both_edited
//    8. breaking: fewest relations lost
// Exact before slack: a wrong operator that errs by less than delta would otherwise win on deformation energy (2 % off
// on 8 of 10 known shapes; 0.2 % so). For the same reason only what misses by little more than the best fit is ranked
// where nothing fits exactly. But a part is deformed only where moving it leaves more than a part may be off:
// else the pole of a lamp is thickened with its shade, or a post with the bench that it is bolted to. Pairs of
// operators on one part go beyond the paper: a chair's back whose seat is widened and raised at once, or a table's
// apron between two legs that move by different amounts.
#pragma once

#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/propagate/closed_form.h"
#include "core/propagate/select.h"
#include "core/propagate/trace.h"

namespace parsel {

struct SolveOptions {
  bool neighbour_edits = true;
  bool breaking_edits = true;
  double exact = 0.002;         ///< base/tolerance.h
  double one_edited = 0.0144;   ///< base/tolerance.h
  double both_edited = 0.0433;  ///< base/tolerance.h
};

/// What the loop has found so far.
struct Scene {
  const Graph& graph;
  const Edits& edits;
  SymbolicGoals& goals;
  std::string parameter;
  Samples at;
  SolveOptions options;
};

enum class Outcome { solved, left_alone, keep_fixed };

struct Solution {
  Outcome outcome = Outcome::keep_fixed;
  WhyKind kind = WhyKind::attachment;
  std::vector<Step> steps;  ///< empty unless solved
};

/// `constraints` holds every relation of the part to an edited part, those of one relation together, none rejected.
/// Fills the search's numbers, ranks, runners-up and reasons into `trace`.
Solution solve_part(const Scene& scene, PartIndex part, const std::optional<Hint>& hint,
                    const std::vector<PointConstraint>& constraints, TraceStep& trace);

}  // namespace parsel
