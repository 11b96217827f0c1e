// What the readers of programs (JSON and text) and validate() share.
#pragma once

#include <string>
#include <string_view>

#include "core/edit/program.h"

namespace parsel {

/// A name from outside as messages show it: printable, cut, in quotes.
std::string shown(std::string_view name);
/// A key from outside as one step of a JSON pointer: printable, cut, with `~` and `/` escaped.
std::string pointer_token(std::string_view key);

/// What is wrong with it as an id or a name, empty when nothing is: UTF-8, 1 … name_bytes bytes.
std::string name_fault(std::string_view text);
/// The same for a shape's name, which may be empty, and a request.
std::string prose_fault(std::string_view text, std::size_t limit);
std::string sha256_fault(std::string_view text);
std::string parameter_name_fault(std::string_view text);
std::string point_fault(const Vec3& point);
std::string direction_fault(const Vec3& direction);

/// The name of the field that holds Statement::direction: "axis" for rotate.
std::string_view direction_field(Op op);

/// How a field may be left out or must not be there.
enum class Presence { refused, optional, required };
/// For "part", "relation", "feature", "origin", "direction", "axis", "normal", "anchor", "amount", "why", "op"; unknown
/// fields are refused.
Presence presence(Op op, std::string_view field);

}  // namespace parsel
