#include "core/family/elimination.h"

#include <algorithm>

namespace parsel::family {

Elimination::Elimination(std::size_t columns) : preference_(columns) {
  for (std::size_t i = 0; i < columns; ++i) preference_[i] = i;
}

void Elimination::subtract(SparseRow& from, const SparseRow& row, const Rational& factor) const {
  for (const auto& [column, coefficient] : row) {
    Rational& entry = from[column];
    entry = entry - factor * coefficient;
    is_lost_ |= entry.is_lost();
    if (entry.is_zero() || is_lost_) from.erase(column);
  }
}

SparseRow Elimination::reduced(SparseRow row) const {
  // A pivot's row has no other pivot in it, so that one look at each entry is enough.
  const SparseRow given = row;
  for (const auto& [column, coefficient] : given) {
    if (const auto found = rows_.find(column); found != rows_.end()) subtract(row, found->second, coefficient);
  }
  return row;
}

bool Elimination::add(const SparseRow& given) {
  SparseRow row = reduced(given);
  if (row.empty()) return false;
  const auto lead = std::min_element(row.begin(), row.end(), [&](const auto& a, const auto& b) {
    return preference_[a.first] < preference_[b.first];
  });
  const std::size_t pivot = lead->first;
  const Rational scale = lead->second;
  for (auto& [column, coefficient] : row) coefficient = coefficient / scale;
  for (auto& [other, above] : rows_) {
    if (const auto found = above.find(pivot); found != above.end()) subtract(above, row, Rational(found->second));
  }
  rows_.emplace(pivot, std::move(row));
  return true;
}

}  // namespace parsel::family
