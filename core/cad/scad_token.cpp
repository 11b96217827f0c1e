#include "core/cad/scad_token.h"

#include <cmath>
#include <cstdlib>

#include "core/base/text.h"

namespace parsel::cad {

std::string to_string(const Place& place) {
  return "line " + std::to_string(place.line) + ", column " + std::to_string(place.column);
}

Error refusal(const Place& place, std::string cause, std::string fix) {
  return {"cad/read", place.line > 0 ? to_string(place) : "", std::move(cause), std::move(fix)};
}

namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view trimmed(std::string_view text) {
  const auto is_edge = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '/' || c == '*'; };
  while (!text.empty() && is_edge(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_edge(text.back())) text.remove_suffix(1);
  return text;
}

class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  }

  Result<std::vector<Token>> read() {
    for (;;) {
      if (Status skipped = skip(); !skipped) return skipped.error();
      Token token;
      token.place = here();
      token.section = section_;
      if (note_line_ + 1 == line_ && is_line_begin()) token.note = note_;
      note_line_ = -1;
      notes_in_a_row_ = 0;
      if (at_ == text_.size()) {
        tokens_.push_back(std::move(token));
        return std::move(tokens_);
      }
      if (Status status = word(token); !status) return status.error();
      tokens_.push_back(std::move(token));
    }
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

  Place here() {
    column_ += static_cast<int>(count_characters(text_.substr(counted_, at_ - counted_)));
    counted_ = at_;
    return {line_, column_};
  }

  bool is_line_begin() const { return text_.substr(line_begin_, at_ - line_begin_).find_first_not_of(" \t") >= at_; }

  void step() {
    if (text_[at_] == '\n') {
      ++line_;
      column_ = 1;
      counted_ = line_begin_ = at_ + 1;
    }
    ++at_;
  }

  /// Blanks and comments.
  Status skip() {
    while (at_ < text_.size()) {
      const char c = peek();
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n') {
        step();
      } else if (c == '/' && (peek(1) == '/' || peek(1) == '*')) {
        if (Status status = comment(peek(1) == '*'); !status) return status;
      } else {
        break;
      }
    }
    return success();
  }

  Status comment(bool is_block) {
    const Place place = here();
    const bool alone = tokens_.empty() || tokens_.back().place.line < line_ || last_line_ < line_;
    const std::size_t begin = at_;
    if (is_block) {
      const std::size_t end = text_.find("*/", at_ + 2);
      if (end == std::string_view::npos) return refusal(place, "a comment has no end", "close it with */");
      while (at_ < end + 2) step();
    } else {
      while (at_ < text_.size() && peek() != '\n') step();
    }
    const std::string_view inside = trimmed(text_.substr(begin, at_ - begin));
    if (is_block && inside.size() > 2 && inside.front() == '[' && inside.back() == ']') {
      section_ = printable(inside.substr(1, inside.size() - 2));
    } else if (!alone) {
      if (!tokens_.empty()) tokens_.back().remark = inside;
    } else {
      // More than one line of comment explains something; a single one names what follows.
      notes_in_a_row_ = note_line_ + 1 == place.line ? notes_in_a_row_ + 1 : 1;
      const bool is_name = notes_in_a_row_ == 1 && place.line == line_;
      note_ = is_name ? std::string(inside) : std::string();
      note_line_ = line_;
    }
    return success();
  }

  Status word(Token& token) {
    const char c = peek();
    const std::size_t begin = at_;
    last_line_ = line_;
    if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return number(token);
    if (is_letter(c)) {
      while (is_letter(peek()) || is_digit(peek())) ++at_;
      token.kind = Token::Kind::name;
      token.text = text_.substr(begin, at_ - begin);
      return success();
    }
    if (c == '"') return string(token);
    token.kind = Token::Kind::sign;
    constexpr std::string_view pairs[] = {"<=", ">=", "==", "!=", "&&", "||"};
    for (const std::string_view pair : pairs) {
      if (text_.substr(at_, 2) == pair) {
        token.text = pair;
        at_ += 2;
        return success();
      }
    }
    if (std::string_view("()[]{}<>=!+-*/%^?:;,.#").find(c) == std::string_view::npos) {
      const std::string shown = printable(text_.substr(at_, character_at(text_, at_).size));
      return refusal(token.place, "'" + shown + "' is no sign of OpenSCAD", "take it out");
    }
    token.text = c;
    ++at_;
    return success();
  }

  Status number(Token& token) {
    const std::size_t begin = at_;
    std::size_t name_end = at_;
    while (is_letter(peek(name_end - at_)) || is_digit(peek(name_end - at_))) ++name_end;
    const auto digits = [&] {
      while (is_digit(peek())) ++at_;
    };
    digits();
    if (peek() == '.') ++at_;
    digits();
    if (peek() == 'e' || peek() == 'E') {
      const std::size_t sign = peek(1) == '+' || peek(1) == '-' ? 1 : 0;
      if (is_digit(peek(1 + sign))) {
        at_ += 1 + sign;
        digits();
      }
    }
    token.kind = Token::Kind::number;
    if (is_letter(peek()) && at_ < name_end) {  // OpenSCAD's names may begin with digits: 3d_text
      token.kind = Token::Kind::name;
      at_ = name_end;
    }
    token.text = text_.substr(begin, at_ - begin);
    if (token.kind == Token::Kind::number) token.number = std::strtod(token.text.c_str(), nullptr);
    if (!std::isfinite(token.number)) return refusal(token.place, "the number is too large", "write a smaller number");
    return success();
  }

  Status string(Token& token) {
    token.kind = Token::Kind::string;
    for (step(); peek() != '"'; step()) {
      if (at_ >= text_.size()) return refusal(token.place, "a string has no end", "close it with \"");
      if (peek() != '\\') {
        token.text += peek();
        continue;
      }
      step();
      if (at_ >= text_.size()) return refusal(token.place, "a string has no end", "close it with \"");
      token.text += peek() == 'n' ? '\n' : peek() == 't' ? '\t' : peek();
    }
    step();
    last_line_ = line_;
    return success();
  }

  std::string_view text_;
  std::vector<Token> tokens_;
  std::string note_, section_;
  int note_line_ = -1, notes_in_a_row_ = 0, last_line_ = 0;
  std::size_t at_ = 0, counted_ = 0, line_begin_ = 0;
  int line_ = 1, column_ = 1;
};

}  // namespace

Result<std::vector<Token>> scad_tokens(std::string_view text) {
  return Reader(text).read();
}

}  // namespace parsel::cad
