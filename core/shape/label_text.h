// Letters and counters of names, shared by label.cpp and grouping.cpp.
#pragma once

#include <string>
#include <string_view>

namespace parsel {

bool is_digit(char c);
bool is_letter(char c);  ///< ASCII
bool is_upper(char c);   ///< ASCII
bool is_separator(char c);

/// ASCII and Latin-1 letters of a UTF-8 text made small.
std::string small_letters(std::string_view text);

/// Eight or more hexadecimal digits, letters and numbers among them: an exporter's number, no word.
bool is_hexadecimal(std::string_view text);

/// Without the first UUID: 8-4-4-4-12 hexadecimal digits between separators, or 32 in a row; and without the brackets
/// around it.
std::string without_uuid(std::string_view text);

/// Without brackets at the end that only count or copy: "(2)", "<1>", "(Clone)", "(33b9bc94-cd6b-…)".
std::string without_copy_mark(std::string_view text);

}  // namespace parsel
