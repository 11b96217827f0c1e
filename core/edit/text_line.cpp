#include "core/edit/text_line.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/text.h"
#include "core/edit/program_fields.h"

namespace parsel {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace

std::size_t Line::at() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  return at_;
}

void Line::fail(std::size_t column, std::string cause, std::string fix) {
  throw TextRefusal{column, std::move(cause), std::move(fix)};
}

bool Line::ended() {
  return at() == text_.size() || text_[at_] == '#';
}
void Line::expect_end() {
  if (!ended()) fail(at(), "there should be nothing more on this line", "remove it or put # before it");
}

bool Line::take(char c) {
  if (at() == text_.size() || text_[at_] != c) return false;
  ++at_;
  return true;
}

void Line::expect(char c) {
  if (!take(c)) fail(at(), std::string("'") + c + "' is missing here", "insert it");
}

std::string Line::word() {
  const std::size_t start = at();
  while (at_ < text_.size() && is_word(text_[at_])) ++at_;
  return std::string(text_.substr(start, at_ - start));
}

void Line::expect_word(const char* wanted) {
  const std::size_t start = at();
  if (word() != wanted) fail(start, std::string("'") + wanted + "' is missing here", "insert it");
}

double Line::number() {
  const std::size_t start = at();
  const std::size_t end = std::min(text_.find_first_not_of("+-.0123456789eE", start), text_.size());
  const std::string token(text_.substr(start, end - start));
  char* stop = nullptr;
  const double value = std::strtod(token.c_str(), &stop);
  if (token.empty() || stop != token.c_str() + token.size() || !std::isfinite(value)) {
    fail(start, "there should be a number", "write one, as in -0.35");
  }
  at_ = end;
  return value;
}

int Line::integer(int low, int high) {
  const std::size_t start = at();
  const double value = number();
  if (value != std::floor(value) || value < low || value > high) {
    fail(start, "there should be an integer from " + std::to_string(low) + " to " + std::to_string(high), "correct it");
  }
  return static_cast<int>(value);
}

std::string Line::string() {
  const std::size_t start = at();
  if (!take('"')) fail(start, "there should be a name in double quotes", "write it as in \"seat\"");
  std::string value;
  while (at_ < text_.size() && text_[at_] != '"') {
    if (static_cast<unsigned char>(text_[at_]) < 0x20) fail(at_, "control characters must be escaped", "write \\u0009");
    if (text_[at_] == '\\') {
      escape(value);
    } else {
      value += text_[at_++];
    }
  }
  if (at_ == text_.size()) fail(start, "the closing quote of this name is missing", "close it on the same line");
  ++at_;
  if (!is_utf8(value)) fail(start, "it is not UTF-8", "save the file as UTF-8");
  return value;
}

std::string Line::name() {
  const std::size_t start = at();
  std::string value = string();
  const std::string fault = name_fault(value);
  if (!fault.empty()) fail(start, fault, "correct it");
  return value;
}

Amount Line::amount() {
  const std::size_t start = at();
  int open = 0;
  for (; at_ < text_.size() && text_[at_] != '#'; ++at_) {
    if (open == 0 && (text_[at_] == ',' || text_[at_] == ')')) break;
    if (text_[at_] == '(') ++open;
    if (text_[at_] == ')') --open;
  }
  std::size_t end = at_;
  while (end > start && is_blank(text_[end - 1])) --end;
  Result<Amount> parsed = parse_amount(text_.substr(start, end - start));
  if (!parsed.ok()) {
    // "column 7" of the amount, which counts bytes as well.
    const std::size_t offset = std::strtoul(parsed.error().place.c_str() + 7, nullptr, 10) - 1;
    fail(start + offset, parsed.error().cause, parsed.error().fix);
  }
  return *parsed;
}

void Line::escape(std::string& value) {
  const std::size_t start = at_++;
  const char kind = at_ < text_.size() ? text_[at_++] : '\0';
  switch (kind) {
    case '"':
    case '\\':
    case '/':
      value += kind;
      return;
    case 'n':
      value += '\n';
      return;
    case 't':
      value += '\t';
      return;
    case 'r':
      value += '\r';
      return;
    case 'b':
      value += '\b';
      return;
    case 'f':
      value += '\f';
      return;
    case 'u':
      if (append_code_point(value)) return;
      break;
    default:
      break;
  }
  fail(start, "this escape is unknown", "use those of JSON, as in \\\" \\n or \\u with four hexadecimal digits");
}

bool Line::append_code_point(std::string& value) {
  const std::string digits(text_.substr(at_, 4));
  if (digits.size() < 4 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos) return false;
  at_ += 4;
  const auto point = static_cast<unsigned>(std::strtoul(digits.c_str(), nullptr, 16));
  if (point < 0x80) {
    value += static_cast<char>(point);
  } else if (point < 0x800) {
    value += static_cast<char>(0xc0 | point >> 6);
    value += static_cast<char>(0x80 | (point & 0x3f));
  } else {
    value += static_cast<char>(0xe0 | point >> 12);
    value += static_cast<char>(0x80 | (point >> 6 & 0x3f));
    value += static_cast<char>(0x80 | (point & 0x3f));
  }
  return true;  // a surrogate is refused with the whole string, as it is not UTF-8
}

}  // namespace parsel
