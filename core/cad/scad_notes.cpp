#include "core/cad/scad_notes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/text.h"

namespace parsel::cad {

std::string label_from_note(std::string_view note) {
  constexpr std::size_t longest = 32, most_words = 4;
  if (note.empty() || note.size() > longest) return "";
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' || c == '_' ||
           c == '-' || static_cast<unsigned char>(c) >= 0x80;
  };
  if (!std::all_of(note.begin(), note.end(), is_plain)) return "";
  if (static_cast<std::size_t>(std::count(note.begin(), note.end(), ' ')) >= most_words) return "";
  const std::string label = printable(note);
  return is_blank(label) ? "" : label;
}

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
