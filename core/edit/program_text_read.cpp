// Reads the text form of programs, a line at a time. The form stands at program_from_text().
#include <algorithm>
#include <set>

#include "core/edit/operator_table.h"
#include "core/edit/program_fields.h"
#include "core/edit/text_line.h"

namespace parsel {

namespace {

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
  if (result.proof == Proof::sampled && !line.ended()) {
    line.expect_word("at");
    result.samples = line.integer(1, ProgramLimits::samples);
  }
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
      line.fail(start, shown(word) + " is no operator",
                "a line starts with layer, relation, " + listed_operators(" or "));
    }
    if (program_.layers.empty())
      line.fail(start, "a layer must come first", "write layer \"…\": x1 = 0 in [-0.35, 0.35]");
    Layer& last = program_.layers.back();
    if (!op) {
      if (last.relations.size() == ProgramLimits::reports)
        line.fail(start, "there are more than " + std::to_string(ProgramLimits::reports) + " reports", "remove some");
      last.relations.push_back(report(line));
      return;
    }
    if (++statements_ > ProgramLimits::statements)
      line.fail(start, "there are more than " + std::to_string(ProgramLimits::statements) + " statements",
                "split the program");
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
    } catch (const TextRefusal& refusal) {
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
