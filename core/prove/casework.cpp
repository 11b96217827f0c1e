#include "core/prove/casework.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/base/result.h"

namespace parsel {

namespace {

/// More answers than this to one question are not worth telling apart: the range is halved instead.
constexpr double most_answers = 3;

const double* find_answer(std::size_t question, const Casework& casework) {
  if (!casework.cases) return nullptr;
  for (const Case& given : *casework.cases) {
    if (given.question == question) return &given.answer;
  }
  return nullptr;
}

void note(std::size_t question, std::vector<double> answers, const Casework& casework) {
  if (casework.open) casework.open->push_back({question, std::move(answers)});
}

/// -1 or 1: the sign of what lies in `difference`; 0 when the answer is open.
int sign_of(const Interval& difference, std::size_t question, const Casework& casework) {
  if (const double* answer = find_answer(question, casework)) return *answer < 0 ? -1 : 1;
  if (difference.low >= 0) return 1;
  if (difference.high <= 0) return -1;
  note(question, {-1, 1}, casework);
  return 0;
}

/// One of two operands: what it is where both are defined.
Jet chosen(Jet operand, const Jet& other) {
  operand.defined = operand.defined && other.defined;
  return operand;
}

Jet absolute(const Jet& a, std::size_t question, const Casework& casework) {
  const int sign = sign_of(a.c[0], question, casework);
  return sign > 0 ? a : sign < 0 ? -a : abs(a);
}

Jet smaller(const Jet& a, const Jet& b, std::size_t question, const Casework& casework) {
  const int sign = sign_of(a.c[0] - b.c[0], question, casework);
  return sign < 0 ? chosen(a, b) : sign > 0 ? chosen(b, a) : min(a, b);
}

Jet larger(const Jet& a, const Jet& b, std::size_t question, const Casework& casework) {
  const int sign = sign_of(a.c[0] - b.c[0], question, casework);
  return sign < 0 ? chosen(b, a) : sign > 0 ? chosen(a, b) : max(a, b);
}

Jet unary(CompiledAmount::Op op, const Jet& a, std::size_t question, const Casework& casework) {
  using Op = CompiledAmount::Op;
  switch (op) {
    case Op::negate:
      return -a;
    case Op::sqrt:
      return sqrt(a);
    case Op::abs:
      return absolute(a, question, casework);
    case Op::floor:
      return counted(a, question, casework);
    case Op::sin:
      return sine_cosine(a).sine;
    case Op::cos:
      return sine_cosine(a).cosine;
    case Op::tan: {
      const SineCosine both = sine_cosine(a);
      return both.sine / both.cosine;
    }
    case Op::constant:
    case Op::parameter:
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::power:
    case Op::atan2:
    case Op::min:
    case Op::max:
      break;
  }
  PARSEL_ASSERT(false, "the operation takes one operand");
  return {};
}

Jet binary(CompiledAmount::Op op, const Jet& a, const Jet& b, std::size_t question, const Casework& casework) {
  using Op = CompiledAmount::Op;
  switch (op) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::power:
      return power(a, b);
    case Op::atan2:
      return atan2(a, b);
    case Op::min:
      return smaller(a, b, question, casework);
    case Op::max:
      return larger(a, b, question, casework);
    case Op::constant:
    case Op::parameter:
    case Op::negate:
    case Op::sqrt:
    case Op::abs:
    case Op::floor:
    case Op::sin:
    case Op::cos:
    case Op::tan:
      break;
  }
  PARSEL_ASSERT(false, "the operation takes two operands");
  return {};
}

}  // namespace

Jet counted(const Jet& amount, std::size_t question, const Casework& casework) {
  if (const double* answer = find_answer(question, casework)) {
    Jet result(*answer);
    result.defined = amount.defined;
    return result;
  }
  const Jet result = counted(amount);
  const Interval& value = result.c[0];
  if (value.low == value.high) return result;
  std::vector<double> answers;
  if (value.high - value.low < most_answers) {
    for (double answer = value.low; answer <= value.high; ++answer) answers.push_back(answer);
  }
  note(question, std::move(answers), casework);
  return result;
}

Jet evaluate(const CompiledAmount& amount, const Jet* parameters, const Casework& casework) {
  using Op = CompiledAmount::Op;
  std::vector<Jet> stack;
  const auto pop = [&] {
    PARSEL_ASSERT(!stack.empty(), "compiled code balances its stack");
    Jet top = stack.back();
    stack.pop_back();
    return top;
  };
  for (std::size_t i = 0; i < amount.code().size(); ++i) {
    const CompiledAmount::Instruction& instruction = amount.code()[i];
    const std::size_t question = casework.questions ? (*casework.questions)[i] : i;
    if (instruction.op == Op::constant) {
      stack.emplace_back(instruction.constant);
    } else if (instruction.op == Op::parameter) {
      stack.push_back(parameters[instruction.parameter]);
    } else if (arity(instruction.op) == 1) {
      const Jet a = pop();
      stack.push_back(unary(instruction.op, a, question, casework));
    } else {
      const Jet b = pop();
      const Jet a = pop();
      stack.push_back(binary(instruction.op, a, b, question, casework));
    }
    // The evaluators count what is undefined as 0, which no bound of the rest covers.
    if (!std::isfinite(stack.back().c[0].magnitude())) stack.back().defined = false;
  }
  return pop();
}

std::vector<std::size_t> Questions::of(const CompiledAmount& amount) {
  using Op = CompiledAmount::Op;
  std::vector<std::size_t> questions;
  std::vector<std::string> stack;  // the code of each operand
  const auto pop = [&] {
    std::string top = std::move(stack.back());
    stack.pop_back();
    return top;
  };
  for (const CompiledAmount::Instruction& i : amount.code()) {
    std::string code;
    std::size_t question = 0;
    if (arity(i.op) > 0) {
      code = pop();
      if (arity(i.op) == 2) code = pop() + code;
      if (i.op == Op::floor) question = number("whole " + code);
      if (i.op == Op::abs) question = number("sign " + code);
      if (i.op == Op::min || i.op == Op::max) question = number("order " + code);
    }
    std::array<char, 64> own;
    std::snprintf(own.data(), own.size(), "%d %u %a;", static_cast<int>(i.op), i.parameter, i.constant);
    stack.push_back(code + own.data());
    questions.push_back(question);
  }
  last_ = pop();
  return questions;
}

}  // namespace parsel
