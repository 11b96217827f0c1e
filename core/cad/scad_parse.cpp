#include "core/cad/scad_parse.h"

#include <algorithm>
#include <utility>

#include "core/base/text.h"
#include "core/cad/scad_token.h"

namespace parsel::cad {

namespace {

using Syntax = Expression::Kind;

/// Of operators of one strength in a row: they nest to the left.
constexpr std::size_t longest_chain = 200;

/// Thrown and caught within this file: the grammar would drown in checks of results.
struct Refused {
  Error error;
};

class Parser {
 public:
  explicit Parser(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}

  Statements program() {
    Statements statements;
    while (token().kind != Token::Kind::end) statement_into(statements);
    return statements;
  }

 private:
  const Token& token(std::size_t ahead = 0) const { return tokens_[std::min(at_ + ahead, tokens_.size() - 1)]; }
  bool is(std::string_view sign, std::size_t ahead = 0) const {
    const Token& next = token(ahead);
    return next.kind == Token::Kind::sign && next.text == sign;
  }
  bool is_word(std::string_view word) const { return token().kind == Token::Kind::name && token().text == word; }
  const Token& next() {
    const Token& taken = token();
    if (at_ + 1 < tokens_.size()) ++at_;
    return taken;
  }
  bool accept(std::string_view sign) {
    if (!is(sign)) return false;
    next();
    return true;
  }

  [[noreturn]] void refuse(const Place& place, std::string cause, std::string fix) const {
    throw Refused{refusal(place, std::move(cause), std::move(fix))};
  }
  std::string shown(const Token& what) const {
    return what.kind == Token::Kind::end ? "the end of the file" : "'" + printable(what.text, 40) + "'";
  }
  void expect(std::string_view sign) {
    if (accept(sign)) return;
    refuse(token().place, "'" + std::string(sign) + "' is missing before " + shown(token()), "put it there");
  }
  std::string expect_name(std::string_view what) {
    if (token().kind == Token::Kind::name) return next().text;
    refuse(token().place, shown(token()) + " stands where " + std::string(what) + " is needed", "write a name");
  }

  /// Bounds what stands on the stack here and later.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > Limits::nesting) {
        parser_.refuse(parser_.token().place, "it is nested deeper than " + std::to_string(Limits::nesting) + " levels",
                       "make it flatter");
      }
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  ExpressionPointer make(Syntax kind, const Place& place) const {
    auto made = std::make_unique<Expression>();
    made->kind = kind;
    made->place = place;
    return made;
  }

  void statement_into(Statements& statements) {
    if (accept(";")) return;
    const Level level(*this);
    const Token& first = token();
    Statement made;
    made.place = first.place;
    made.note = first.note;
    made.section = first.section;
    if (accept("{")) {
      made.kind = Statement::Kind::block;
      block_into(made.children);
    } else if (is_word("include") || is_word("use")) {
      refuse(first.place, first.text + " names another file",
             "open the .csg that OpenSCAD writes of this program (File, Export), which holds everything");
    } else if (is_word("module")) {
      next();
      made.kind = Statement::Kind::module;
      made.name = expect_name("a module's name");
      made.arguments = arguments();
      statement_into(made.children);
    } else if (is_word("function")) {
      next();
      made.kind = Statement::Kind::function;
      made.name = expect_name("a function's name");
      made.arguments = arguments();
      expect("=");
      made.value = expression();
      expect(";");
    } else if (first.kind == Token::Kind::name && is("=", 1)) {
      made.kind = Statement::Kind::assignment;
      made.name = next().text;
      next();
      made.value = expression();
      const Token& end = token();
      expect(";");
      made.remark = end.remark;
    } else {
      call(made);
    }
    statements.push_back(std::move(made));
  }

  void block_into(Statements& statements) {
    while (!accept("}")) {
      if (token().kind == Token::Kind::end) refuse(token().place, "'}' is missing at the end", "close every '{'");
      statement_into(statements);
    }
  }

  void call(Statement& made) {
    while (is("*") || is("!") || is("#") || is("%")) made.modifier = next().text[0];
    made.kind = Statement::Kind::call;
    if (is_word("if")) {
      next();
      made.kind = Statement::Kind::choice;
      expect("(");
      made.value = expression();
      expect(")");
      statement_into(made.children);
      if (is_word("else")) {
        next();
        statement_into(made.otherwise);
      }
      return;
    }
    made.name = expect_name("a statement");
    made.arguments = arguments();
    if (accept(";")) return;
    if (accept("{")) return block_into(made.children);
    if (is("}") || token().kind == Token::Kind::end) refuse(token().place, "';' is missing", "end the statement");
    statement_into(made.children);
  }

  std::vector<Argument> arguments() {
    expect("(");
    std::vector<Argument> list;
    while (!accept(")")) {
      Argument argument;
      argument.place = token().place;
      if (token().kind == Token::Kind::name && is("=", 1)) {
        argument.name = next().text;
        next();
      }
      argument.value = expression();
      list.push_back(std::move(argument));
      if (!is(")")) expect(",");
    }
    return list;
  }

  ExpressionPointer expression() {
    const Level level(*this);
    if (is_word("let") && is("(", 1)) {
      ExpressionPointer made = make(Syntax::let, next().place);
      made->arguments = arguments();
      made->operands.push_back(expression());
      return made;
    }
    if (is_word("function")) {
      refuse(token().place, "a function without a name is not read", "define it as function name(…) = …;");
    }
    if ((is_word("assert") || is_word("echo")) && is("(", 1)) {
      next();
      arguments();
      return expression();
    }
    ExpressionPointer condition = binary(0);
    if (!is("?")) return condition;
    ExpressionPointer made = make(Syntax::choice, next().place);
    made->operands.push_back(std::move(condition));
    made->operands.push_back(expression());
    expect(":");
    made->operands.push_back(expression());
    return made;
  }

  static int strength(const Token& sign) {
    static constexpr std::pair<std::string_view, int> table[] = {{"||", 1}, {"&&", 2}, {"==", 3}, {"!=", 3}, {"<", 4},
                                                                 {"<=", 4}, {">", 4},  {">=", 4}, {"+", 5},  {"-", 5},
                                                                 {"*", 6},  {"/", 6},  {"%", 6}};
    if (sign.kind != Token::Kind::sign) return 0;
    const auto found =
        std::find_if(std::begin(table), std::end(table), [&](const auto& e) { return e.first == sign.text; });
    return found == std::end(table) ? 0 : found->second;
  }

  ExpressionPointer binary(int weakest) {
    const Level level(*this);
    ExpressionPointer left = unary();
    std::size_t links = 0;
    for (int own = strength(token()); own > weakest; own = strength(token())) {
      const Token& sign = next();
      ExpressionPointer made = make(Syntax::binary, sign.place);
      made->text = sign.text;
      ExpressionPointer right = binary(own);
      made->operands.push_back(std::move(left));
      made->operands.push_back(std::move(right));
      left = std::move(made);
      if (++links > longest_chain) refuse(sign.place, "the expression is too long", "split it over variables");
    }
    return left;
  }

  ExpressionPointer unary() {
    const Level level(*this);
    if (!is("-") && !is("+") && !is("!")) return power();
    const Token& sign = next();
    ExpressionPointer operand = unary();
    if (sign.text == "-" && operand->kind == Syntax::number) {  // a literal, with its place
      operand->number = -operand->number;
      operand->place = sign.place;
      return operand;
    }
    ExpressionPointer made = make(Syntax::unary, sign.place);
    made->text = sign.text;
    made->operands.push_back(std::move(operand));
    return made;
  }

  ExpressionPointer power() {
    ExpressionPointer base = postfix();
    if (!is("^")) return base;
    ExpressionPointer made = make(Syntax::binary, next().place);
    made->text = "^";
    made->operands.push_back(std::move(base));
    made->operands.push_back(unary());
    return made;
  }

  ExpressionPointer postfix() {
    ExpressionPointer made = primary();
    for (std::size_t links = 0;; ++links) {
      if (links > Limits::nesting) refuse(token().place, "too many indices follow each other", "use variables");
      if (is("[")) {
        ExpressionPointer index = make(Syntax::index, next().place);
        index->operands.push_back(std::move(made));
        index->operands.push_back(expression());
        expect("]");
        made = std::move(index);
      } else if (is(".")) {
        ExpressionPointer member = make(Syntax::member, next().place);
        member->text = expect_name("x, y or z");
        member->operands.push_back(std::move(made));
        made = std::move(member);
      } else {
        return made;
      }
    }
  }

  ExpressionPointer primary() {
    const Token& first = next();
    ExpressionPointer made = make(Syntax::undefined, first.place);
    made->text = first.text;
    switch (first.kind) {
      case Token::Kind::number:
        made->kind = Syntax::number;
        made->number = first.number;
        return made;
      case Token::Kind::string:
        made->kind = Syntax::string;
        return made;
      case Token::Kind::name:
        if (first.text == "undef") return made;
        if (first.text == "true" || first.text == "false") {
          made->kind = Syntax::boolean;
          made->number = first.text == "true";
        } else if (is("(")) {
          made->kind = Syntax::call;
          made->arguments = arguments();
        } else {
          made->kind = Syntax::name;
        }
        return made;
      case Token::Kind::sign:
        if (first.text == "(") {
          made = expression();
          expect(")");
          return made;
        }
        if (first.text == "[") return bracket(first.place);
        break;
      case Token::Kind::end:
        break;
    }
    refuse(first.place, shown(first) + " stands where a value is needed", "write a number, a vector or a name");
  }

  /// A vector or a range, after its "[".
  ExpressionPointer bracket(const Place& place) {
    ExpressionPointer made = make(Syntax::vector, place);
    while (!accept("]")) {
      made->operands.push_back(element());
      if (made->operands.size() == 1 && is(":")) {
        made->kind = Syntax::range;
        while (accept(":")) made->operands.push_back(expression());
        if (made->operands.size() > 3) refuse(place, "a range has two or three numbers", "write [begin : step : end]");
        expect("]");
        return made;
      }
      if (!is("]")) expect(",");
    }
    return made;
  }

  ExpressionPointer element() {
    const Level level(*this);
    const Place place = token().place;
    if (is_word("for") || (is_word("let") && is("(", 1))) {
      ExpressionPointer made = make(next().text == "for" ? Syntax::each_for : Syntax::let, place);
      made->arguments = arguments();
      made->operands.push_back(element());
      return made;
    }
    if (is_word("each")) {
      next();
      ExpressionPointer made = make(Syntax::each, place);
      made->operands.push_back(element());
      return made;
    }
    if (is_word("if")) {
      next();
      ExpressionPointer made = make(Syntax::each_if, place);
      expect("(");
      made->operands.push_back(expression());
      expect(")");
      made->operands.push_back(element());
      if (is_word("else")) {
        next();
        made->operands.push_back(element());
      }
      return made;
    }
    if (is("(") && is_comprehension_in_brackets()) {
      next();
      ExpressionPointer made = element();
      expect(")");
      return made;
    }
    return expression();
  }

  bool is_comprehension_in_brackets() const {
    const Token& inner = token(1);
    return inner.kind == Token::Kind::name && (inner.text == "for" || inner.text == "each" || inner.text == "if");
  }

  std::vector<Token> tokens_;
  std::size_t at_ = 0, depth_ = 0;
};

}  // namespace

Result<Statements> parse_scad(std::string_view text) {
  if (text.size() > Limits::bytes) {
    return refusal({}, "the program is longer than " + std::to_string(Limits::bytes >> 20) + " MiB",
                   "split it, or write less of it out");
  }
  Result<std::vector<Token>> tokens = scad_tokens(text);
  if (!tokens) return tokens.error();
  try {
    return Parser(std::move(*tokens)).program();
  } catch (const Refused& refused) {
    return refused.error;
  }
}

}  // namespace parsel::cad
