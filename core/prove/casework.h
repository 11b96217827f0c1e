// Jets of amounts, and how they are bounded where they jump: case by case.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/amount/amount.h"
#include "core/prove/jet.h"

namespace parsel {

/// A jump or kink in an amount as a question with few answers: which whole number a floor gives, or which sign (-1 or
/// 1) stands under abs, or which operand of min and max is the smaller (-1: the first). Equal questions, wherever they
/// are asked in a program, have one number, so that what jumps as one stays as one.
struct Case {
  std::size_t question = 0;
  double answer = 0;
};
struct OpenQuestion {
  std::size_t question = 0;
  std::vector<double> answers;  ///< all that are possible on the range; none: too many to tell
};
/// How an amount is evaluated where it jumps: by the answers given, whatever the range. A function is bounded on a
/// range by its jets for all answers that are possible there.
struct Casework {
  const std::vector<std::size_t>* questions = nullptr;  ///< of the amount's instructions; unused where none is asked
  const std::vector<Case>* cases = nullptr;             ///< answers that are given
  std::vector<OpenQuestion>* open = nullptr;            ///< questions that were asked without an answer are added
};

/// counted() as `question`.
Jet counted(const Jet& amount, std::size_t question, const Casework& casework);

/// The jet of a compiled amount. Undefined values follow CompiledAmount: a jet that is `defined` belongs to a function
/// that is real on the whole range.
Jet evaluate(const CompiledAmount& amount, const Jet* parameters, const Casework& casework = {});

/// Numbers the questions of a program: equal ones get one number, by the code of what they ask about.
class Questions {
 public:
  /// Of every instruction; 0 for those that ask nothing.
  std::vector<std::size_t> of(const CompiledAmount& amount);
  /// Of the whole number that the amount numbered last counts.
  std::size_t count() { return number("whole " + last_); }

 private:
  std::size_t number(const std::string& key) { return numbers_.try_emplace(key, numbers_.size()).first->second; }

  std::map<std::string, std::size_t> numbers_;
  std::string last_;
};

}  // namespace parsel
