// Which relations a program keeps over the whole range of a layer's parameter, and how surely. ParSEL §5.2, equation 1.
//
// The paper checks ‖C(x)‖∞ < δ at random values of x. Here the closed form is bounded over the whole range, no point
// left out: Taylor jets of intervals (jet.h) for every coordinate of C, on pieces of the range that are halved where
// the bound is loose. Jumps and kinks (floor, abs, min, max, a count that changes) are bracketed first, to a width of
// 1e-8; the pieces between are bounded one by one, and the brackets once for each case that is possible in them (see
// Casework).
//
// What the bound speaks of: amounts as compiled to doubles, M_a and M_b as the doubles they are, all else exact.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

/// One report for every relation of scope_of(), in the shape's order; but none for a relation of instances that do not
/// exist (deviation.h) while the layer's parameter is 0, because an earlier layer has changed their number.
///
/// Layers 0 … `layer` are applied, later ones are not; the layer's own parameter runs over [min, max], those before it
/// stand at their `value`. So a report holds for those values: after a change of an earlier slider it must be made
/// anew.
///
///   status  held when `worst` is within the tolerance of the relation (slack.h), else broken; disabled as `disabled` says.
///   worst   largest deviation of a coordinate over the range (see deviation.h), for disabled relations too.
///   proof   certified: `worst` is a proven upper bound over the whole range, which either keeps the tolerance or
///           exceeds a value that really occurs by at most 1 % and 1e-6; of a broken one that value exceeds the
///           tolerance. sampled: no such bound was found (see Enclosure for when); `worst` is the largest of `samples`
///           values of the parameter: 257 evenly spaced ones, ends included, both sides of every jump, and the middles
///           of the pieces on which the bound stayed loose.
///
/// `program` passed validate() for `shape`; the parameter's range contains 0. Deterministic.
/// Measured (native, -O3): see tests/bench/bench_prove.cpp.
std::vector<RelationReport> prove_relations(const Shape& shape, const Program& program, std::size_t layer,
                                            const std::set<std::string>& disabled);

}  // namespace parsel
