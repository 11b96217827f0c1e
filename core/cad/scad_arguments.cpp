#include "core/cad/scad_arguments.h"

#include <cmath>

#include "core/cad/scad_token.h"

namespace parsel::cad {

CallArguments::CallArguments(Evaluator& evaluator, const Statement& call, const Scope& scope,
                             std::initializer_list<std::string_view> names)
    : call_(call.name), place_(call.place) {
  const auto* position = names.begin();
  for (const Argument& argument : call.arguments) {
    Value value = evaluator.evaluate(*argument.value, scope);
    if (!argument.name.empty()) {
      values_[argument.name] = std::move(value);
    } else if (position != names.end()) {
      values_[std::string(*position++)] = std::move(value);
    }
  }
}

const Value& CallArguments::operator[](std::string_view name) const {
  static const Value undefined;
  const auto found = values_.find(name);
  return found == values_.end() ? undefined : found->second;
}

void CallArguments::refuse(std::string cause, std::string fix) const {
  throw Refused{refusal(place_, call_ + ": " + cause, std::move(fix))};
}

double CallArguments::checked(const Value& value, std::string_view name) const {
  if (!value.number()) {
    refuse("its " + std::string(name) + " is " + std::string(value.type()) + ", not a number", "give it a number");
  }
  const double number = value.number()->value;
  if (!(std::abs(number) <= Limits::coordinate)) {
    refuse("its " + std::string(name) + " is larger than a million", "use a smaller number");
  }
  return number;
}

std::optional<Number> CallArguments::number(std::string_view name) const {
  const Value& value = (*this)[name];
  if (value.is_undefined()) return std::nullopt;
  checked(value, name);
  return *value.number();
}

std::optional<Triple> CallArguments::triple(std::string_view name, double otherwise, bool may_be_number) const {
  const Value& value = (*this)[name];
  if (value.is_undefined()) return std::nullopt;
  Triple made;
  made.value = Vec3::Constant(otherwise);
  if (value.number() && may_be_number) {
    made.value = Vec3::Constant(checked(value, name));
    made.literals.fill(value.number()->literal);
    return made;
  }
  const Vector* vector = value.vector();
  if (!vector || vector->empty() || vector->size() > 4) {
    refuse("its " + std::string(name) + " is " + std::string(value.type()) + " that does not fit",
           "give it a vector of three numbers");
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(3, vector->size()); ++i) {
    made.value[static_cast<int>(i)] = checked((*vector)[i], name);
    made.literals[i] = (*vector)[i].number()->literal;
  }
  return made;
}

}  // namespace parsel::cad
