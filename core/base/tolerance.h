// Tolerances of the whole system, in the normalised frame (half-diagonal 1). One place, so that they can be compared.
#pragma once

#include <numbers>

namespace parsel {

inline constexpr double pi = std::numbers::pi;

/// Upper end of a parameter's range before inversion and collapse narrow it. ParSEL, supplement §5.3.2.
inline constexpr double tau = 0.35;

/// A relation counts as held when no coordinate is off by more than this: with one of its parts edited, and with both.
inline constexpr double delta_one_edited = 0.0144;
inline constexpr double delta_both_edited = 0.0433;

/// Candidates this exact are accepted first; only when there is none does delta apply. A wrong operator that errs by
/// less than delta would otherwise win on deformation energy.
inline constexpr double exact = 0.002;

/// Numerical noise of evaluation in doubles: what should be equal is equal to this.
inline constexpr double noise = 1e-9;

}  // namespace parsel
