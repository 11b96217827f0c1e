#include "core/cad/label_note.h"

#include <algorithm>

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

}  // namespace parsel::cad
