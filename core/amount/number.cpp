#include "core/amount/number.h"

#include <array>
#include <cstdio>
#include <cstdlib>

namespace parsel {

std::string shortest_decimal(double value) {
  value += 0.0;  // -0 is 0
  std::array<char, 40> buffer{};
  // Nearly every number of ours has few digits or all of them, so that trying in order costs little.
  for (int digits = 1; digits <= 17; ++digits) {
    std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
    if (std::strtod(buffer.data(), nullptr) == value) break;
  }
  return buffer.data();
}

}  // namespace parsel
