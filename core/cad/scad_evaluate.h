// Evaluates OpenSCAD's expressions: scopes, functions, loops over ranges, and the budget that keeps them short.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/cad/scad_syntax.h"
#include "core/cad/scad_value.h"

namespace parsel::cad {

/// How the interpreter stops, thrown and caught within core/cad: an Error of the caller's in every other room.
struct Refused {
  Error error;
};

/// The names of a block. Looked up from the inside out, as the text nests; lives on the stack of whoever runs the block.
struct Scope {
  const Scope* outer = nullptr;
  std::map<std::string, Value, std::less<>> variables;
  std::map<std::string, const Statement*, std::less<>> modules, functions;
};

/// A definition with the scope that its body sees.
struct Definition {
  const Statement* statement = nullptr;
  const Scope* home = nullptr;
};

class Evaluator {
 public:
  /// Refuses names that nothing defines, recursion beyond Limits::depth and more than Limits::steps in all.
  Value evaluate(const Expression& expression, const Scope& scope);

  /// Registers the definitions of a block, then assigns its variables: of several values the last one counts, as in
  /// OpenSCAD, at the place of the first.
  void open_block(const Statements& block, Scope& scope);

  /// The scope of a body, with parameters from the call's arguments, else their defaults. `$` arguments are pushed for
  /// the time of the call: keep a Specials on the stack.
  Scope bind(const std::vector<Argument>& parameters, const std::vector<Argument>& arguments, const Scope& caller,
             const Scope* home);

  /// Runs `body` for every combination of the loop's variables.
  void loop(const std::vector<Argument>& variables, const Scope& scope, const std::function<void(const Scope&)>& body);

  /// A scope in which each argument is assigned after the one before it.
  Scope let(const std::vector<Argument>& arguments, const Scope& scope);

  static Definition find_module(const Scope& scope, const std::string& name);

  /// Counts one step at a place.
  void step(const Place& place, std::size_t cost = 1);

  /// `$fn` and the like follow calls, not the text.
  void push_special(const std::string& name, Value value) { specials_.emplace_back(name, std::move(value)); }
  Value special(const std::string& name) const;

  /// Forgets on destruction what was pushed since.
  class Specials {
   public:
    explicit Specials(Evaluator& evaluator) : evaluator_(evaluator), size_(evaluator.specials_.size()) {}
    ~Specials() { evaluator_.specials_.resize(size_); }
    Specials(const Specials&) = delete;
    Specials& operator=(const Specials&) = delete;

   private:
    Evaluator& evaluator_;
    std::size_t size_;
  };

  /// One more level of calls or expressions.
  class Level {
   public:
    Level(Evaluator& evaluator, const Place& place);
    ~Level() { --evaluator_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Evaluator& evaluator_;
  };

 private:
  Value call(const Expression& expression, const Scope& scope);
  Value index(const Expression& expression, const Scope& scope);
  Value range(const Expression& expression, const Scope& scope);
  void element_into(const Expression& expression, const Scope& scope, Vector& elements);
  void loop_from(std::size_t first, const std::vector<Argument>& variables, const Scope& scope,
                 const std::function<void(const Scope&)>& body);

  std::vector<std::pair<std::string, Value>> specials_;
  std::size_t depth_ = 0, left_ = Limits::steps;
};

}  // namespace parsel::cad
