// Gauss-Jordan elimination in exact fractions, one row at a time.
//
// The columns are in an order of preference: the pivots are the columns that come first in it. Adding rows one by one
// gives the same reduced form as all at once: the leading columns of the rows' span only ever grow by the leading column
// of the reduced new row.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "core/family/rational.h"

namespace parsel::family {

/// Column → coefficient, zeros left out.
using SparseRow = std::map<std::size_t, Rational>;

class Elimination {
 public:
  /// `preference[c]`: the smaller, the sooner column c becomes a pivot; no two alike.
  explicit Elimination(std::vector<std::size_t> preference) : preference_(std::move(preference)) {}
  /// Columns in their own order.
  explicit Elimination(std::size_t columns);

  /// Whether the row is no combination of those before, which then are reduced by it.
  bool add(const SparseRow& row);
  /// The same question, nothing changed.
  bool raises_rank(const SparseRow& row) const { return !reduced(row).empty(); }

  std::size_t rank() const { return rows_.size(); }
  /// Some fraction did not fit 64 bits: nothing here can be relied upon.
  bool is_lost() const { return is_lost_; }
  /// By pivot column: 1 there, 0 in every other pivot column.
  const std::map<std::size_t, SparseRow>& rows() const { return rows_; }

 private:
  SparseRow reduced(SparseRow row) const;
  void subtract(SparseRow& from, const SparseRow& row, const Rational& factor) const;

  std::vector<std::size_t> preference_;
  std::map<std::size_t, SparseRow> rows_;
  mutable bool is_lost_ = false;
};

}  // namespace parsel::family
