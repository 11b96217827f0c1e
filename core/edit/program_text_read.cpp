// Reads the text form of programs, a line at a time. The form stands at program_from_text().
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <set>

#include "core/edit/program_fields.h"

namespace parsel {

namespace {

/// Thrown and caught inside this file only.
struct Refusal {
  std::size_t column;  ///< in bytes, from 0
  std::string cause, fix;
};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Tokens of one line.
class Line {
 public:
  explicit Line(std::string_view text) : text_(text) {}

  /// Where the next token starts.
  std::size_t at() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    return at_;
  }
  [[noreturn]] void fail(std::size_t column, std::string cause, std::string fix) const {
    throw Refusal{column, std::move(cause), std::move(fix)};
  }
  /// Nothing but blanks or a comment is left.
  bool ended() { return at() == text_.size() || text_[at_] == '#'; }
  void expect_end() {
    if (!ended()) fail(at(), "there should be nothing more on this line", "remove it or put # before it");
  }
  bool take(char c) {
    if (at() == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail(at(), std::string("'") + c + "' is missing here", "insert it");
  }
  /// A run of letters, digits and _; empty when there is none.
  std::string word() {
    const std::size_t start = at();
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    return std::string(text_.substr(start, at_ - start));
  }
  void expect_word(const char* wanted) {
    const std::size_t start = at();
    if (word() != wanted) fail(start, std::string("'") + wanted + "' is missing here", "insert it");
  }
  double number() {
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
  int integer(int low, int high) {
    const std::size_t start = at();
    const double value = number();
    if (value != std::floor(value) || value < low || value > high) {
      fail(start, "there should be an integer from " + std::to_string(low) + " to " + std::to_string(high),
           "correct it");
    }
    return static_cast<int>(value);
  }
  std::string string() {
    const std::size_t start = at();
    if (!take('"')) fail(start, "there should be a name in double quotes", "write it as in \"seat\"");
    std::string value;
    while (at_ < text_.size() && text_[at_] != '"') {
      if (static_cast<unsigned char>(text_[at_]) < 0x20)
        fail(at_, "control characters must be escaped", "write \\u0009");
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
  std::string name() {
    const std::size_t start = at();
    std::string value = string();
    const std::string fault = name_fault(value);
    if (!fault.empty()) fail(start, fault, "correct it");
    return value;
  }
  /// Up to the ',' or ')' that ends the field; parentheses inside are matched.
  Amount amount() {
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

 private:
  void escape(std::string& value) {
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
      case 'u':
        if (append_code_point(value)) return;
        break;
      default:
        break;
    }
    fail(start, "this escape is unknown", "use \\\" \\\\ \\n \\t \\r or \\u with four hexadecimal digits");
  }
  bool append_code_point(std::string& value) {
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

  std::string_view text_;
  std::size_t at_ = 0;
};

template <class Enum>
Enum choice(Line& line, std::optional<Enum> (*find)(std::string_view), const char* all) {
  const std::size_t start = line.at();
  const std::string word = line.word();
  const auto found = find(word);
  if (!found) line.fail(start, shown(word) + " is unknown", "it is one of " + std::string(all));
  return *found;
}

LocalTriple local_triple(Line& line) {
  LocalTriple result{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) line.expect(',');
    result[i] = line.integer(-1, 1);
  }
  return result;
}

Vec3 vector(Line& line, std::string (*fault_of)(const Vec3&)) {
  const std::size_t start = line.at();
  Vec3 result;
  line.expect('(');
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (i > 0) line.expect(',');
    result[i] = line.number();
  }
  line.expect(')');
  const std::string fault = fault_of(result);
  if (!fault.empty()) line.fail(start, fault, "correct it");
  return result;
}

PointReference point(Line& line) {
  const std::size_t start = line.at();
  const std::string word = line.word();
  if (word.empty()) return vector(line, point_fault);
  if (word != "point") line.fail(start, shown(word) + " is no point", "write (x, y, z) or point(\"part\", 0, 1, 0)");
  PartPoint result;
  line.expect('(');
  result.part = line.name();
  line.expect(',');
  result.at = local_triple(line);
  line.expect(')');
  return result;
}

DirectionReference direction(Line& line) {
  const std::size_t start = line.at();
  const std::string word = line.word();
  if (word.empty()) return vector(line, direction_fault);
  if (word != "axis") line.fail(start, shown(word) + " is no direction", "write (x, y, z) or axis(\"part\", 0)");
  PartAxis result;
  line.expect('(');
  result.part = line.name();
  line.expect(',');
  result.axis = line.integer(0, 2);
  line.expect(')');
  return result;
}

Why why(Line& line) {
  Why result;
  result.kind = choice(line, why_kind, "seed, symmetry, attachment, neighbour, breaking, group");
  if (line.ended()) return result;
  do {
    if (result.relations.size() == ProgramLimits::why_relations) {
      line.fail(line.at(), "a reason has at most 256 relations", "remove some");
    }
    result.relations.push_back(line.name());
  } while (line.take(','));
  return result;
}

void field(Line& line, const std::string& key, Statement& statement) {
  if (key == "amount") {
    statement.amount = line.amount();
  } else if (key == "origin") {
    statement.origin = point(line);
  } else if (key == "direction" || key == "axis") {
    statement.direction = direction(line);
  } else if (key == "normal") {
    statement.normal = direction(line);
  } else if (key == "feature") {
    line.expect('(');
    statement.feature = local_triple(line);
    line.expect(')');
  } else {
    statement.anchor = choice(line, anchor_from_string, "start, middle, end, fit");
  }
}

Statement statement(Line& line, Op op, std::size_t start) {
  Statement result;
  result.op = op;
  line.expect('(');
  (is_geometric(op) ? result.part : result.relation) = line.name();
  std::set<std::string> given;
  while (line.take(',')) {
    const std::size_t at = line.at();
    const std::string key = line.word();
    const bool operand = key == "part" || key == "relation" || key == "why" || key == "op";
    if (operand || presence(op, key) == Presence::refused) {
      line.fail(at, std::string(to_string(op)) + " takes no " + shown(key), "remove it or correct its name");
    }
    if (!given.insert(key).second) line.fail(at, shown(key) + " is given twice", "remove one");
    line.expect('=');
    field(line, key, result);
  }
  line.expect(')');
  for (const char* key : {"amount", "origin", "direction", "axis", "normal"}) {
    if (presence(op, key) == Presence::required && given.count(key) == 0) {
      line.fail(start, std::string(to_string(op)) + " needs " + key, "add " + std::string(key) + "=…");
    }
  }
  if (line.ended()) return result;
  line.expect_word("because");
  result.why = why(line);
  return result;
}

RelationReport report(Line& line) {
  RelationReport result;
  result.id = line.name();
  line.expect(':');
  result.status = choice(line, relation_status, "held, broken, disabled");
  line.expect(',');
  line.expect_word("worst");
  const std::size_t at = line.at();
  result.worst = line.number();
  if (result.worst < 0) line.fail(at, "a deviation is not negative", "correct it");
  line.expect(',');
  result.proof = choice(line, proof, "certified, sampled");
  return result;
}

Layer layer(Line& line) {
  Layer result;
  const std::size_t start = line.at();
  result.request = line.string();
  std::string fault = prose_fault(result.request, ProgramLimits::request_bytes);
  if (!fault.empty()) line.fail(start, fault, "shorten it");
  line.expect(':');
  const std::size_t name = line.at();
  result.parameter.name = line.word();
  fault = parameter_name_fault(result.parameter.name);
  if (!fault.empty()) line.fail(name, fault, "rename it, to x1 for one");
  line.expect('=');
  result.parameter.value = line.number();
  line.expect_word("in");
  line.expect('[');
  result.parameter.min = line.number();
  line.expect(',');
  result.parameter.max = line.number();
  line.expect(']');
  return result;
}

class Reader {
 public:
  /// One line that is not blank.
  void read(Line& line) {
    if (lines_ == 0) {
      header(line);
    } else if (lines_ == 1) {
      shape(line);
    } else {
      entry(line);
    }
    line.expect_end();
    ++lines_;
  }
  std::size_t lines() const { return lines_; }
  Program take() { return std::move(program_); }

 private:
  void header(Line& line) {
    const std::size_t start = line.at();
    if (line.word() != "parsel" || line.word() != "program") {
      line.fail(start, "it is not the text of a program", "the first line is 'parsel program 1'");
    }
    const std::size_t at = line.at();
    const double version = line.number();
    if (version > 1) line.fail(at, "the program was written by a newer version of ParSEL", "update ParSEL to open it");
    if (version != 1) line.fail(at, "there is no such version of the text form", "the only version is 1");
  }
  void shape(Line& line) {
    line.expect_word("shape");
    const std::size_t name = line.at();
    program_.shape_name = line.string();
    std::string fault = prose_fault(program_.shape_name, ProgramLimits::name_bytes);
    if (!fault.empty()) line.fail(name, fault, "shorten it");
    const std::size_t digest = line.at();
    program_.shape_sha256 = line.string();
    fault = sha256_fault(program_.shape_sha256);
    if (!fault.empty()) line.fail(digest, fault, "copy it from parsel inspect");
  }
  void entry(Line& line) {
    const std::size_t start = line.at();
    const std::string word = line.word();
    if (word == "layer") {
      if (program_.layers.size() == ProgramLimits::layers)
        line.fail(start, "there are more than 100 layers", "split it");
      program_.layers.push_back(layer(line));
      return;
    }
    const auto op = op_from_string(word);
    if (word != "relation" && !op) {
      line.fail(
          start, shown(word) + " is no operator",
          "a line starts with layer, relation, translate, rotate, scale_1d, scale_2d, scale_3d, shear, change_count, "
          "change_delta or keep_fixed");
    }
    if (program_.layers.empty())
      line.fail(start, "a layer must come first", "write layer \"…\": x1 = 0 in [-0.35, 0.35]");
    Layer& last = program_.layers.back();
    if (!op) {
      if (last.relations.size() == ProgramLimits::reports)
        line.fail(start, "there are more than 10000 reports", "remove some");
      last.relations.push_back(report(line));
      return;
    }
    if (++statements_ > ProgramLimits::statements)
      line.fail(start, "there are more than 10000 statements", "split the program");
    last.statements.push_back(statement(line, *op, start));
  }

  Program program_;
  std::size_t lines_ = 0;
  std::size_t statements_ = 0;
};

Error fault(std::size_t line, std::size_t column, std::string cause, std::string fix) {
  return {"edit/program", "line " + std::to_string(line) + ", column " + std::to_string(column), std::move(cause),
          std::move(fix)};
}

/// The column of a byte, counted in characters from 1.
std::size_t column_of(std::string_view line, std::size_t byte) {
  std::size_t column = 1;
  for (const char c : line.substr(0, byte)) column += (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  return column;
}

}  // namespace

Result<Program> program_from_text(std::string_view text) {
  if (text.size() > ProgramLimits::text_bytes) return fault(1, 1, "the text is longer than 8 MiB", "split the program");
  Reader reader;
  std::size_t number = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view whole = text.substr(start, end - start);
    start = end + 1;
    ++number;
    Line line(whole);
    if (line.ended()) continue;
    try {
      reader.read(line);
    } catch (const Refusal& refusal) {
      return fault(number, column_of(whole, refusal.column), refusal.cause, refusal.fix);
    }
  }
  if (reader.lines() < 2) {
    return fault(number + 1, 1, "the text of a program starts with 'parsel program 1' and its shape",
                 "write shape \"name\" \"sha256\" on the second line");
  }
  return reader.take();
}

}  // namespace parsel
