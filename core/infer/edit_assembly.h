// From the counted votes to what propagation starts from. ParSEL §6.2.
#pragma once

#include <vector>

#include "core/infer/votes.h"

namespace parsel {

/// `seed` as it is; relations that shall not be kept are disabled, but for groups that the seed edits as one; hints go
/// to the part that stands for the named one (a group's virtual part while the group stands). Left out are hints about
/// parts that the seed edits itself, about what a dissolved group no longer has, and of two that meet on one part the
/// one with fewer votes. resolve() accepts the result when it accepts the seed.
EditRequest assemble(const Shape& shape, const std::vector<Statement>& seed, const std::vector<HintVote>& hints,
                     const std::vector<RelationVote>& relations);

}  // namespace parsel
