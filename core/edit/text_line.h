// Tokens of one line of a program's text form.
#pragma once

#include <string>
#include <string_view>

#include "core/amount/amount.h"

namespace parsel {

/// Thrown by Line and caught by program_from_text(), which knows the line's number; never leaves core/edit.
struct TextRefusal {
  std::size_t column;  ///< in bytes, from 0
  std::string cause, fix;
};

/// A cursor over one line. Every reading function skips blanks first, and throws TextRefusal when it does not find what
/// it is for.
class Line {
 public:
  explicit Line(std::string_view text) : text_(text) {}

  /// Where the next token starts.
  std::size_t at();
  [[noreturn]] static void fail(std::size_t column, std::string cause, std::string fix);
  /// Nothing but blanks or a comment is left.
  bool ended();
  void expect_end();
  /// Whether the next character is `c`, which then is consumed.
  bool take(char c);
  void expect(char c);
  /// A run of letters, digits and _; empty when there is none.
  std::string word();
  void expect_word(const char* wanted);
  double number();
  int integer(int low, int high);
  /// In double quotes with the escapes of JSON; UTF-8.
  std::string string();
  /// A string that may be an id or a name.
  std::string name();
  /// Up to the ',' or ')' that ends the field; parentheses inside are matched.
  Amount amount();

 private:
  void escape(std::string& value);
  bool append_code_point(std::string& value);

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace parsel
