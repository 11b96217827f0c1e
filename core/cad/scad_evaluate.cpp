#include "core/cad/scad_evaluate.h"

#include <cmath>

#include "core/base/text.h"
#include "core/base/tolerance.h"
#include "core/cad/scad_token.h"

namespace parsel::cad {

namespace {

using Syntax = Expression::Kind;

[[noreturn]] void refuse(const Place& place, std::string cause, std::string fix) {
  throw Refused{refusal(place, std::move(cause), std::move(fix))};
}

Value taken(Result<Value> result) {
  if (!result) throw Refused{result.error()};
  return std::move(*result);
}

const Value* find_variable(const Scope& scope, std::string_view name) {
  for (const Scope* s = &scope; s != nullptr; s = s->outer) {
    if (const auto found = s->variables.find(name); found != s->variables.end()) return &found->second;
  }
  return nullptr;
}

Definition find_function(const Scope& scope, std::string_view name) {
  for (const Scope* s = &scope; s != nullptr; s = s->outer) {
    if (const auto found = s->functions.find(name); found != s->functions.end()) return {found->second, s};
  }
  return {};
}

}  // namespace

Definition Evaluator::find_module(const Scope& scope, const std::string& name) {
  for (const Scope* s = &scope; s != nullptr; s = s->outer) {
    if (const auto found = s->modules.find(name); found != s->modules.end()) return {found->second, s};
  }
  return {};
}

Evaluator::Level::Level(Evaluator& evaluator, const Place& place) : evaluator_(evaluator) {
  if (++evaluator_.depth_ > Limits::depth) {
    --evaluator_.depth_;
    refuse(place, "calls are nested deeper than " + std::to_string(Limits::depth) + " levels",
           "end the recursion by a condition");
  }
}

void Evaluator::step(const Place& place, std::size_t cost) {
  if (cost >= left_) {
    refuse(place, "the program takes more than " + std::to_string(Limits::steps) + " steps",
           "use fewer and smaller loops");
  }
  left_ -= cost;
}

Value Evaluator::special(const std::string& name) const {
  for (auto s = specials_.rbegin(); s != specials_.rend(); ++s) {
    if (s->first == name) return s->second;
  }
  if (name == "$fn" || name == "$t") return 0.0;
  if (name == "$fa") return 12.0;
  if (name == "$fs") return 2.0;
  if (name == "$preview") return true;
  if (name == "PI") return pi;
  return {};
}

Value Evaluator::evaluate(const Expression& expression, const Scope& scope) {
  const Level level(*this, expression.place);
  step(expression.place);
  const auto operand = [&](std::size_t i) { return evaluate(*expression.operands[i], scope); };
  switch (expression.kind) {
    case Syntax::number:
      return Value(expression.number, expression.place);
    case Syntax::string:
      return Value(expression.text);
    case Syntax::boolean:
      return Value(expression.number != 0);
    case Syntax::undefined:
      return {};
    case Syntax::name: {
      if (const Value* found = find_variable(scope, expression.text)) return *found;
      Value special_value = special(expression.text);
      if (special_value.is_undefined() && expression.text[0] != '$') {
        refuse(expression.place, "nothing is called '" + printable(expression.text, 40) + "'",
               "assign it, or open the .csg that OpenSCAD writes of this program");
      }
      return special_value;
    }
    case Syntax::vector: {
      Vector elements;
      for (const ExpressionPointer& element : expression.operands) element_into(*element, scope, elements);
      return Value(std::move(elements));
    }
    case Syntax::range:
      return range(expression, scope);
    case Syntax::unary:
      return taken(unary_value(expression.text, operand(0), {expression.place, left_}));
    case Syntax::binary: {
      Value left = operand(0);
      if (expression.text == "&&") return Value(left.is_true() && operand(1).is_true());
      if (expression.text == "||") return Value(left.is_true() || operand(1).is_true());
      return taken(binary_value(expression.text, left, operand(1), {expression.place, left_}));
    }
    case Syntax::choice:
      return operand(operand(0).is_true() ? 1 : 2);
    case Syntax::index:
      return index(expression, scope);
    case Syntax::member: {
      const Value whole = operand(0);
      const std::size_t i = expression.text == "x" ? 0 : expression.text == "y" ? 1 : expression.text == "z" ? 2 : 3;
      if (!whole.vector() || i >= whole.vector()->size()) return {};
      return (*whole.vector())[i];
    }
    case Syntax::call:
      return call(expression, scope);
    case Syntax::let: {
      const Specials specials(*this);
      const Scope inner = let(expression.arguments, scope);
      return evaluate(*expression.operands[0], inner);
    }
    case Syntax::each_for:
    case Syntax::each_if:
    case Syntax::each:
      break;
  }
  refuse(expression.place, "for, if and each make elements of a vector", "write them inside [ ]");
}

void Evaluator::element_into(const Expression& expression, const Scope& scope, Vector& elements) {
  const Level level(*this, expression.place);
  step(expression.place);
  if (expression.kind == Syntax::each_for) {
    loop(expression.arguments, scope,
         [&](const Scope& inner) { element_into(*expression.operands[0], inner, elements); });
  } else if (expression.kind == Syntax::each_if) {
    const bool is_true = evaluate(*expression.operands[0], scope).is_true();
    if (is_true) element_into(*expression.operands[1], scope, elements);
    if (!is_true && expression.operands.size() > 2) element_into(*expression.operands[2], scope, elements);
  } else if (expression.kind == Syntax::each) {
    Vector inner;
    element_into(*expression.operands[0], scope, inner);
    for (const Value& one : inner) {
      if (!one.vector()) refuse(expression.place, "each takes a vector", "write [each v] with a vector v");
      step(expression.place, one.vector()->size() + 1);
      elements.insert(elements.end(), one.vector()->begin(), one.vector()->end());
    }
  } else if (expression.kind == Syntax::let) {
    const Specials specials(*this);
    const Scope inner = let(expression.arguments, scope);
    element_into(*expression.operands[0], inner, elements);
  } else {
    elements.push_back(evaluate(expression, scope));
  }
}

Value Evaluator::range(const Expression& expression, const Scope& scope) {
  std::vector<double> given;
  for (const ExpressionPointer& operand : expression.operands) {
    const Value value = evaluate(*operand, scope);
    if (!value.number())
      refuse(operand->place, "a range needs numbers, not " + std::string(value.type()), "write numbers");
    given.push_back(value.number()->value);
  }
  Range made{given.front(), given.size() == 3 ? given[1] : 1.0, given.back()};
  if (given.size() == 2 && made.begin > made.end) std::swap(made.begin, made.end);
  if (made.step == 0) refuse(expression.place, "the range has a step of zero", "give it another step");
  return Value(made);
}

Value Evaluator::index(const Expression& expression, const Scope& scope) {
  const Value whole = evaluate(*expression.operands[0], scope), at = evaluate(*expression.operands[1], scope);
  if (!at.number() || !(at.number()->value >= 0) || at.number()->value > 1e9) return {};
  const auto i = static_cast<std::size_t>(at.number()->value);
  if (whole.vector()) return i < whole.vector()->size() ? (*whole.vector())[i] : Value();
  if (whole.string() && i < whole.string()->size()) return Value(std::string(1, (*whole.string())[i]));
  if (whole.range() && i < 3) return i == 0 ? whole.range()->begin : i == 1 ? whole.range()->step : whole.range()->end;
  return {};
}

Value Evaluator::call(const Expression& expression, const Scope& scope) {
  if (const Definition found = find_function(scope, expression.text); found.statement) {
    const Specials specials(*this);
    const Scope inner = bind(found.statement->arguments, expression.arguments, scope, found.home);
    return evaluate(*found.statement->value, inner);
  }
  if (expression.text == "is_undef" && expression.arguments.size() == 1) {
    // The one question that may be asked of a name that nothing defines.
    const Expression& asked = *expression.arguments[0].value;
    if (asked.kind == Syntax::name && !find_variable(scope, asked.text)) return special(asked.text).is_undefined();
  }
  Vector given;
  for (const Argument& argument : expression.arguments) given.push_back(evaluate(*argument.value, scope));
  return taken(builtin_value(expression.text, given, {expression.place, left_}));
}

Scope Evaluator::let(const std::vector<Argument>& arguments, const Scope& scope) {
  Scope inner;
  inner.outer = &scope;
  for (const Argument& argument : arguments) {
    Value value = evaluate(*argument.value, inner);
    if (argument.name.starts_with('$')) push_special(argument.name, value);
    if (!argument.name.empty()) inner.variables[argument.name] = std::move(value);
  }
  return inner;
}

Scope Evaluator::bind(const std::vector<Argument>& parameters, const std::vector<Argument>& arguments,
                      const Scope& caller, const Scope* home) {
  Scope inner;
  inner.outer = home;
  std::size_t position = 0;
  std::vector<std::pair<std::string, Value>> pushed;
  const auto name_of = [](const Argument& p) -> const std::string& {
    return p.name.empty() && p.value && p.value->kind == Syntax::name ? p.value->text : p.name;
  };
  for (const Argument& argument : arguments) {
    Value value = evaluate(*argument.value, caller);
    if (argument.name.starts_with('$')) {
      pushed.emplace_back(argument.name, std::move(value));
    } else if (!argument.name.empty()) {
      inner.variables[argument.name] = std::move(value);
    } else if (position < parameters.size()) {
      inner.variables[name_of(parameters[position++])] = std::move(value);
    }
  }
  for (auto& [name, value] : pushed) push_special(name, std::move(value));
  for (const Argument& parameter : parameters) {
    const std::string& name = name_of(parameter);
    if (inner.variables.count(name) > 0) continue;
    const bool has_default = !parameter.name.empty();
    inner.variables[name] = has_default ? evaluate(*parameter.value, home ? *home : caller) : Value();
  }
  return inner;
}

void Evaluator::loop(const std::vector<Argument>& variables, const Scope& scope,
                     const std::function<void(const Scope&)>& body) {
  loop_from(0, variables, scope, body);
}

void Evaluator::loop_from(std::size_t first, const std::vector<Argument>& variables, const Scope& scope,
                          const std::function<void(const Scope&)>& body) {
  if (first == variables.size()) return body(scope);
  const Argument& variable = variables[first];
  const Level level(*this, variable.place);
  const Value values = evaluate(*variable.value, scope);
  const auto run = [&](Value value) {
    step(variable.place);
    Scope inner;
    inner.outer = &scope;
    inner.variables[variable.name] = std::move(value);
    loop_from(first + 1, variables, inner, body);
  };
  if (const Range* range = values.range()) {
    const double count = std::floor((range->end - range->begin) / range->step * (1 + 1e-12) + 1e-9);
    if (count > double(Limits::steps)) step(variable.place, Limits::steps);
    for (double i = 0; i <= count; ++i) run(range->begin + i * range->step);
  } else if (const Vector* vector = values.vector()) {
    for (const Value& value : *vector) run(value);
  } else if (!values.is_undefined()) {
    run(values);
  }
}

void Evaluator::open_block(const Statements& block, Scope& scope) {
  std::map<std::string_view, const Statement*> last;
  for (const Statement& statement : block) {
    if (statement.kind == Statement::Kind::module) scope.modules[statement.name] = &statement;
    if (statement.kind == Statement::Kind::function) scope.functions[statement.name] = &statement;
    if (statement.kind == Statement::Kind::assignment) last[statement.name] = &statement;
  }
  for (const Statement& statement : block) {
    if (statement.kind != Statement::Kind::assignment) continue;
    const auto found = last.find(statement.name);
    if (found == last.end()) continue;
    Value value = evaluate(*found->second->value, scope);
    if (statement.name.starts_with('$')) push_special(statement.name, value);
    scope.variables[statement.name] = std::move(value);
    last.erase(found);
  }
}

}  // namespace parsel::cad
