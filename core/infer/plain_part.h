// What a clause of a plain request means for one part: the rules behind plain_seed.h, sizes in plain_size.cpp, moves and
// the like in plain_acts.cpp.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "core/infer/plain_clause.h"
#include "core/infer/plain_edit.h"
#include "core/infer/plain_facts.h"
#include "core/infer/plain_statement.h"

namespace parsel {

/// No edit, and why.
Meant no_edit(std::string fault);
std::string name_of(const Shape& shape, PartIndex part);
/// By its label, in any of the languages that requests are read in.
bool is_drawer(const Shape& shape, PartIndex part);
bool is_size(Change change);

/// Gives up the joints along which the parts slide, open or grow, and lets what hangs on what is opened go along.
/// `parts`: one that the edit changes, with those of its mirror images that are meant as well.
void loosen(const ShapeFacts& facts, const Clause& clause, const std::vector<PartIndex>& parts, PlainEdit& edit);

class PartMeaning {
 public:
  PartMeaning(const ShapeFacts& facts, const Clause& clause) : facts_(facts), shape_(facts.shape()), clause_(clause) {}

  /// `set`: the part with those of its mirror images that are meant as well, which follow by themselves.
  Meant of(PartIndex part, const std::vector<PartIndex>& set);

 private:
  Meant finished(const StatementMaker& maker) const { return maker.finish(clause_.how_much, clause_.compares); }
  /// Why a group cannot be edited as one along this axis, or (two_axes) across it; empty when it can.
  std::string group_fault(PartIndex part, int axis, bool two_axes) const;
  std::optional<int> axis_of(PartIndex part) const;
  /// Whether an edit to one side breaks the mirror images across it: the parts are not themselves a pair across it.
  bool joined_across(const std::vector<PartIndex>& set, int axis) const;
  bool has_word(PartIndex part, std::initializer_list<const char*> words) const;

  Meant size_of(PartIndex part, const std::vector<PartIndex>& set);
  Meant taper(PartIndex part, std::optional<int> axis, int sign);
  Meant raise(PartIndex part);
  Meant count(PartIndex part);
  Meant spacing(PartIndex part, const std::vector<PartIndex>& set);
  Meant move(PartIndex part, const std::vector<PartIndex>& set);
  Meant tilt(PartIndex part, const std::vector<PartIndex>& set);
  Meant open(PartIndex part);

  const ShapeFacts& facts_;
  const Shape& shape_;
  const Clause& clause_;
};

}  // namespace parsel
