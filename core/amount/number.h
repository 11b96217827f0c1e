// Decimal text of doubles, the same on every machine.
#pragma once

#include <string>

namespace parsel {

/// The shortest of the forms %.1g … %.17g that reads back as the same double: "0.1", "1e-09", "-3.5". `value` is
/// finite.
std::string shortest_decimal(double value);

}  // namespace parsel
