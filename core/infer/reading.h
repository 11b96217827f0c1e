// What seed statements say, in words for people and as a key that replies are counted by.
#pragma once

#include <string>
#include <vector>

#include "core/edit/program.h"

namespace parsel {

/// "widen seat about its centre, left and right; move back up". Directions are those at rest, for a slider moved up.
/// The statements' names must be known to the shape.
std::string reading_words(const Shape& shape, const std::vector<Statement>& statements);

/// Equal for statements that count as the same vote, in any order. ParSEL (supplement §5.4.1) compares operator and
/// operand; we add the feature and the way (axis and sign), since replies that do the opposite, or the same along
/// another axis, do not support each other. Origins and amounts may differ.
std::string reading_signature(const Shape& shape, const std::vector<Statement>& statements);

}  // namespace parsel
