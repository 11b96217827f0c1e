#include "core/base/text.h"

namespace parsel {

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto c = static_cast<unsigned char>(text[i]);
    const std::size_t size = c < 0x80                ? 1
                             : c >= 0xc2 && c < 0xe0 ? 2
                             : c >= 0xe0 && c < 0xf0 ? 3
                             : c >= 0xf0 && c < 0xf5 ? 4
                                                     : 0;
    bool whole = size > 0 && i + size <= text.size();
    for (std::size_t k = 1; whole && k < size; ++k) whole = (static_cast<unsigned char>(text[i + k]) & 0xc0) == 0x80;
    // C0 and C1 controls, and the marks that reorder or hide text: soft hyphen (U+00AD), Arabic letter mark (U+061C),
    // U+180E, U+200B…200F, U+2028…202E, U+2060…206F, U+FEFF, and the tags (U+E0000…E0FFF), which spell unseen text.
    const std::string_view character = text.substr(i, whole ? size : 1);
    bool hidden = !whole || c < 0x20 || c == 0x7f;
    if (whole && size == 2) {
      const auto next = static_cast<unsigned char>(text[i + 1]);
      hidden = (c == 0xc2 && (next < 0xa0 || next == 0xad)) || (c == 0xd8 && next == 0x9c);
    }
    if (whole && size == 4) hidden = c == 0xf3 && static_cast<unsigned char>(text[i + 1]) == 0xa0;
    if (whole && size == 3) {
      const unsigned code = (c & 15u) << 12 | (static_cast<unsigned char>(text[i + 1]) & 63u) << 6 |
                            (static_cast<unsigned char>(text[i + 2]) & 63u);
      hidden = (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
               (code >= 0x2060 && code <= 0x206f) || code == 0x180e || code == 0xfeff ||
               (code >= 0xd800 && code <= 0xdfff);
    }
    if (!hidden) {
      if (out.size() + character.size() > limit) break;
      out += character;
    } else if (!out.empty() && out.back() != ' ') {
      out += ' ';
    }
    i += character.size();
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

}  // namespace parsel
