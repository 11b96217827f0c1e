#include "core/cad/customizer.h"

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/base/text.h"

namespace parsel::cad {

namespace {

/// The numbers between the colons of "[1 : 2 : 3]", two or three of them, or none.
std::vector<double> numbers_in(std::string_view remark) {
  if (remark.size() < 3 || remark.front() != '[' || remark.back() != ']') return {};
  remark = remark.substr(1, remark.size() - 2);
  std::vector<double> numbers;
  while (numbers.size() < 4) {
    while (!remark.empty() && remark.front() == ' ') remark.remove_prefix(1);
    const std::string rest(remark.substr(0, 40));
    char* end = nullptr;
    const double number = std::strtod(rest.c_str(), &end);
    if (end == rest.c_str() || !(std::abs(number) <= Limits::coordinate)) return {};
    numbers.push_back(number);
    remark.remove_prefix(static_cast<std::size_t>(end - rest.c_str()));
    while (!remark.empty() && remark.front() == ' ') remark.remove_prefix(1);
    if (remark.empty()) return numbers.size() >= 2 && numbers.size() <= 3 ? numbers : std::vector<double>{};
    if (remark.front() != ':') return {};
    remark.remove_prefix(1);
  }
  return {};
}

}  // namespace

std::vector<CustomizerRange> customizer_ranges(const Statements& program) {
  std::vector<CustomizerRange> ranges;
  for (const Statement& statement : program) {
    if (statement.kind != Statement::Kind::assignment || statement.value->kind != Expression::Kind::number) continue;
    const std::vector<double> numbers = numbers_in(statement.remark);
    if (numbers.empty() || statement.section == "Hidden") continue;
    ranges.push_back({printable(statement.name), statement.section, statement.value->number, numbers.front(),
                      numbers.size() == 3 ? numbers[1] : 0, numbers.back(), statement.place});
  }
  return ranges;
}

}  // namespace parsel::cad
