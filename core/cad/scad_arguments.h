// The arguments of a call of one of OpenSCAD's own modules, by position or name.
#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/cad/scad_evaluate.h"

namespace parsel::cad {

/// Three numbers with the literals that they come from.
struct Triple {
  Vec3 value = Vec3::Zero();
  std::array<Place, 3> literals;
};

class CallArguments {
 public:
  /// `names` of the positional ones, in order; what has another name is kept under it.
  CallArguments(Evaluator& evaluator, const Statement& call, const Scope& scope,
                std::initializer_list<std::string_view> names);

  /// undef when it is not given.
  const Value& operator[](std::string_view name) const;
  bool has(std::string_view name) const { return !(*this)[name].is_undefined(); }

  /// Refuses what is given and is no finite number of at most Limits::coordinate.
  std::optional<Number> number(std::string_view name) const;
  bool is_true(std::string_view name) const { return (*this)[name].is_true(); }
  /// A vector of two or three numbers, missing ones are `otherwise`; a number counts for all three where `may_be_number`.
  std::optional<Triple> triple(std::string_view name, double otherwise, bool may_be_number) const;
  [[noreturn]] void refuse(std::string cause, std::string fix) const;

 private:
  double checked(const Value& value, std::string_view name) const;

  std::string call_;
  Place place_;
  std::map<std::string, Value, std::less<>> values_;
};

}  // namespace parsel::cad
