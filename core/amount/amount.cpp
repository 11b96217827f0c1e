#include "core/amount/amount.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/amount/amount_functions.h"

namespace parsel {

namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

void collect_names(const ex& e, std::set<std::string>& names) {
  if (is_a<GiNaC::symbol>(e)) names.insert(ex_to<GiNaC::symbol>(e).get_name());
  for (std::size_t i = 0; i < e.nops(); ++i) collect_names(e.op(i), names);
}

bool in_grammar(const ex& e) {
  if (is_a<GiNaC::function>(e) && function_name(e).empty()) return false;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    if (!in_grammar(e.op(i))) return false;
  }
  return true;
}

}  // namespace

const GiNaC::symbol& parameter_symbol(const std::string& name) {
  static std::map<std::string, GiNaC::realsymbol> symbols;
  return symbols.try_emplace(name, name).first->second;
}

Amount::Amount() : expression_(0) {}

Amount::Amount(const ex& expression) : expression_(canonical(expression)) {
  PARSEL_ASSERT(in_grammar(expression_), "amounts are made of the grammar's functions");
}

Amount::Amount(const ex& expression, WrittenAmount written) : Amount(expression) {
  written_ = std::make_shared<const WrittenAmount>(std::move(written));
}

std::shared_ptr<const WrittenAmount> Amount::written() const {
  if (written_) return written_;
  const Result<Amount> read = parse_amount(text());
  PARSEL_ASSERT(read.ok(), "the text of an amount can be read");
  return read->written_;
}

Amount Amount::constant(double value) {
  PARSEL_ASSERT(std::isfinite(value), "amounts are finite");
  for (long q = 3; q <= 1000; ++q) {
    const double p = std::round(value * static_cast<double>(q));
    if (std::abs(p) > 1e6) break;
    if (p / static_cast<double>(q) == value && p != 0) return Amount(numeric(static_cast<long>(p), q));
  }
  return Amount(inexact(value));
}

Amount Amount::parameter(const std::string& name) {
  PARSEL_ASSERT(is_parameter_name(name), "a parameter's name is [a-z][a-z0-9_]* and no function");
  return Amount(parameter_symbol(name));
}

std::vector<std::string> Amount::parameters() const {
  if (written_) return written_->names;
  std::set<std::string> names;
  collect_names(expression_, names);
  return {names.begin(), names.end()};
}

bool Amount::is_zero() const {
  return expression_.is_zero();
}

std::optional<Amount> Amount::derivative(const std::string& parameter) const {
  const ex result = canonical(expression_.diff(parameter_symbol(parameter)));
  if (!in_grammar(result)) return std::nullopt;
  return Amount(result);
}

}  // namespace parsel
