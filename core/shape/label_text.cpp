#include "core/shape/label_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace parsel {
namespace {

bool is_hex(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

constexpr std::string_view opening = "([{<", closing = ")]}>";

/// Length of the UUID that starts at `from`, 0 when there is none.
std::size_t uuid_length(std::string_view text, std::size_t from) {
  constexpr std::array<std::size_t, 5> groups = {8, 4, 4, 4, 12};
  std::size_t at = from;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (g > 0 && at < text.size() && is_separator(text[at])) ++at;
    for (std::size_t i = 0; i < groups[g]; ++i, ++at) {
      if (at >= text.size() || !is_hex(text[at])) return 0;
    }
  }
  return at < text.size() && is_hex(text[at]) ? 0 : at - from;
}

}  // namespace

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || is_upper(c);
}
bool is_separator(char c) {
  return std::string_view(" _-.#:/|,;+*$@&=~'\"\\").find(c) != std::string_view::npos ||
         opening.find(c) != std::string_view::npos || closing.find(c) != std::string_view::npos;
}

std::string small_letters(std::string_view text) {
  std::string out(text);
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (is_upper(out[i])) out[i] = static_cast<char>(out[i] - 'A' + 'a');
    // U+00C0…U+00DE but for the sign ×, in two bytes.
    const auto second = i > 0 ? static_cast<unsigned char>(out[i]) : 0u;
    if (i > 0 && out[i - 1] == '\xc3' && second >= 0x80 && second <= 0x9e && second != 0x97) {
      out[i] = static_cast<char>(second + 0x20);
    }
  }
  return out;
}

bool is_hexadecimal(std::string_view text) {
  constexpr std::size_t shortest = 8;
  return text.size() >= shortest && std::all_of(text.begin(), text.end(), is_hex) &&
         std::any_of(text.begin(), text.end(), is_digit);
}

std::string without_uuid(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i > 0 && is_hex(text[i - 1])) continue;
    const std::size_t length = uuid_length(text, i);
    if (length == 0) continue;
    std::string out(text.substr(0, i));
    std::string_view rest = text.substr(i + length);
    if (!out.empty() && !rest.empty() && opening.find(out.back()) != std::string_view::npos &&
        opening.find(out.back()) == closing.find(rest.front())) {
      out.pop_back();
      rest.remove_prefix(1);
    }
    return out.append(rest);
  }
  return std::string(text);
}

std::string without_copy_mark(std::string_view text) {
  const std::size_t kind = text.empty() ? std::string_view::npos : closing.find(text.back());
  if (kind == std::string_view::npos) return std::string(text);
  const std::size_t open = text.rfind(opening[kind]);
  if (open == std::string_view::npos) return std::string(text);
  const std::string inside = small_letters(text.substr(open + 1, text.size() - open - 2));
  const bool counts = std::all_of(inside.begin(), inside.end(), [](char c) { return is_digit(c) || is_separator(c); });
  const bool copies = inside == "clone" || inside == "copy" || inside == "instance" || inside == "kopie" ||
                      inside == "copie" || inside == "copia" || is_hexadecimal(inside);
  return std::string(counts || copies ? text.substr(0, open) : text);
}

}  // namespace parsel
