// One statement of a program, compiled for one shape, to be run on a state: what Evaluator (evaluate.h) does one after
// the other, for whoever puts a layer together statement by statement.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/edit/group_edit.h"
#include "core/edit/program.h"
#include "core/edit/state.h"

namespace parsel {

class StatementRun {
 public:
  /// `parameters`: all that may occur in the amount, in the order of the values given later. `groups`: groups_of(shape).
  /// The statement passed validate() in its program. Holds no reference to any of them.
  StatementRun(const Statement& statement, const std::vector<std::string>& parameters, const Shape& shape,
               const std::vector<Group>& groups);

  /// The operator with its references read on `start`, the state at the start of the layer; nothing for a group operator,
  /// and when a part's axis that it names is degenerate there.
  std::optional<ResolvedOperator> resolve(const State& start) const;

  /// The amount at these values of the parameters; 0 when it is not finite.
  double amount(const double* values) const;

  /// Does to `state` what the statement does: its own part or group, and what rides on it. `what`: from resolve().
  void run(const std::optional<ResolvedOperator>& what, double amount, const std::vector<Group>& groups,
           State& state) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace parsel
