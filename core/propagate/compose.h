// Layers on layers (ParSEL §8.1): what a later layer does is worked out on the state that the layers before it leave, for
// all values of their parameters.
//
// propagate() finds a layer on the shape at rest. Behind others its amounts are off: a leg that follows the rim of a
// seat by 0.3·x2 lags behind once x1 has widened the seat. So each statement that follows a part is solved again, with
// the earlier parameters as symbols: the leg's becomes 0.3·x2·(1 + x1). Only where relations that each layer keeps alone
// do not hold together as they stand: which are solved is seen at samples, and what is solved is taken only when it
// holds more there. Where all earlier parameters are 0 a composed layer is what it was alone, to the last digit. Hence
// switching a layer off is its slider at 0; and when an earlier layer goes or changes, the later ones are composed again
// and nothing is propagated: alone() gives back what each was by itself.
//
// Measured: tests/eval/pairs.cpp.
#pragma once

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

/// Whether propagation found the statement. What a person or another tool wrote, and a seed edit, stays as it is.
bool is_derived(const Statement& statement);

/// The layer as it is where all other parameters of its program are 0, but for statements that are not derived.
Layer alone(const Layer& layer);

/// The program with every layer from `first` on composed onto those before it, which stay as they are. Each is first
/// taken alone(). Ranges, values and reports stay: a report speaks of the layer alone. Deterministic. `program` passed
/// validate() for `shape`, and so does the result.
Program compose(const Shape& shape, const Program& program, std::size_t first = 1);

/// The layers of several programs as one program, under parameter names of their own (x1, x2, …), composed from the
/// second on. Error: they were made for other files, or do not pass validate() together.
Result<Program> stack_programs(const Shape& shape, const std::vector<Program>& programs);

}  // namespace parsel
