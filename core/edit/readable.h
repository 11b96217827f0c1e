// The gate of what is written here: no program leaves that its own readers refuse.
#pragma once

#include "core/base/result.h"
#include "core/edit/program.h"

namespace parsel {

/// Whether a program that was made here passes every gate of one that comes from outside: its JSON is read again, and
/// the result validated for the shape. Whoever makes programs returns none that is not.
Status readable(const Program& program, const Shape& shape);

}  // namespace parsel
