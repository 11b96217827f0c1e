// What rounding is forgiven in amounts, by the evaluator and by the judge alike; core/amount/amount.h has the same.

/** floor(a) is ⌊a + this⌋ in amounts and for counts: 0.15/0.05 is a hair below 3 in doubles and means 3. */
export const countingSlack = 1e-9;
/**
 * Expanded closed forms end a hair below 0 where they should touch it: such arguments of a root count as 0. Beside the
 * cut of atan2, where it jumps by 2π, y may come out below 0 by this share of |x|: it counts as above.
 */
export const noise = 1e-12;
