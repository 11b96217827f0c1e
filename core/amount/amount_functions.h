// What the files of the amount share: real functions that GiNaC lacks, and the forms that an expression is kept in.
#pragma once

#include <ginac/ginac.h>

#include <optional>
#include <string_view>
#include <vector>

namespace parsel {

// GiNaC has no floor (real_floor is counted() of amount.h), and no min and max of two; more arguments are folded.
DECLARE_FUNCTION_1P(real_floor)
DECLARE_FUNCTION_2P(real_min)
DECLARE_FUNCTION_2P(real_max)

/// The name in the grammar of a function that may stand in an amount, "atan" (of one argument) included; empty for
/// others.
std::string_view function_name(const GiNaC::ex& e);

/// The exact rational that a decimal of at most 12 significant digits between 1e-25 and 1e25 stands for; nothing for
/// other text. The parser, the printer and the Amount's constructor agree on numbers through this one rule.
std::optional<GiNaC::numeric> exact_decimal(std::string_view text);

/// A double as GiNaC's number; denormals, which CLN throws about, are 0.
GiNaC::numeric inexact(double value);

/// Whether all numbers in it are finite as doubles: CLN's go much further.
bool fits_double(const GiNaC::ex& e);

/// Replaces what has an equal in the grammar: CLN's long floats by doubles, doubles that are short decimals by
/// rationals, conjugates (all is real), asin and acos.
GiNaC::ex canonical(const GiNaC::ex& e);

/// The operands of a sum or product in the order of their text: GiNaC's own order depends on when symbols were made.
std::vector<GiNaC::ex> ordered_operands(const GiNaC::ex& e);

/// Text of an expression in the grammar.
std::string amount_text(const GiNaC::ex& e);

}  // namespace parsel
