// The syntax tree of an OpenSCAD program: what scad_parse builds and scad_flatten runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/cad/model.h"

namespace parsel::cad {

struct Expression;
using ExpressionPointer = std::unique_ptr<Expression>;

/// `name = value` or `value` alone; of a parameter list, the value is the default and may be missing.
struct Argument {
  std::string name;
  ExpressionPointer value;
  Place place;
};

struct Expression {
  enum class Kind {
    number,
    string,
    boolean,
    undefined,
    name,
    vector,    ///< operands: elements
    range,     ///< operands: begin, end or begin, step, end
    unary,     ///< text: operator
    binary,    ///< text: operator
    choice,    ///< operands: condition, then, else
    index,     ///< operands: vector, index
    member,    ///< text: x, y or z
    call,      ///< text: function, arguments
    let,       ///< arguments, operands: body
    each_for,  ///< inside a vector: arguments, operands: body
    each_if,   ///< inside a vector: operands: condition, then, maybe else
    each       ///< inside a vector: operands: vector
  };
  Kind kind = Kind::undefined;
  std::string text;
  double number = 0;  ///< of a boolean: 0 or 1
  std::vector<ExpressionPointer> operands;
  std::vector<Argument> arguments;
  Place place;
};

struct Statement;
using Statements = std::vector<Statement>;

struct Statement {
  enum class Kind { assignment, module, function, call, choice, block };
  Kind kind = Kind::block;
  std::string name;                 ///< what is assigned, defined or called
  ExpressionPointer value;          ///< assignment, function; condition of a choice
  std::vector<Argument> arguments;  ///< of a call; parameters of a definition
  Statements children;              ///< of a call or block, body of a module, first branch of a choice
  Statements otherwise;             ///< second branch of a choice
  char modifier = ' ';              ///< '*', '!', '#', '%' before a call
  std::string note;                 ///< a comment that may name what the statement makes
  std::string remark, section;      ///< assignment: for the Customizer
  Place place;
};

}  // namespace parsel::cad
