// Solves one scalar equation in closed form. ParSEL §5.3, algorithm 3 (`cas_solve`).
//
// Handled: polynomials of degree 1 and 2 in the unknown, and a·cos Y + b·sin Y = c. GiNaC's `expand` and `coeff` do the
// work; its general `lsolve` took 29 µs a linear equation where these take 8.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

namespace parsel {

struct Solutions {
  std::vector<GiNaC::ex> roots;  ///< expressions of the other symbols; may be undefined for some of their values
  std::string unsolved;          ///< when there is no root: why, for the trace; empty otherwise
};

/// All closed-form Y with equation = 0. An equation without Y has no root, whether it holds or not.
Solutions solve_for(const GiNaC::ex& equation, const GiNaC::symbol& unknown);

}  // namespace parsel
