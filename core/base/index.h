// Typed indices and the arrays they index, so that a part's number cannot be used where a relation's is meant.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace parsel {

/// A position in an IndexedVector of the same Tag.
template <class Tag>
class Index {
 public:
  constexpr Index() = default;
  constexpr explicit Index(std::size_t value) : value_(static_cast<std::uint32_t>(value)) {}
  constexpr std::size_t value() const { return value_; }
  auto operator<=>(const Index&) const = default;

 private:
  std::uint32_t value_ = 0;
};

/// A std::vector that only an Index of its own Tag can index. Bounds are checked.
template <class Tag, class T>
class IndexedVector {
 public:
  IndexedVector() = default;
  explicit IndexedVector(std::size_t size, const T& value = T()) : items_(size, value) {}
  explicit IndexedVector(std::vector<T> items) : items_(std::move(items)) {}

  T& operator[](Index<Tag> i) {
    PARSEL_ASSERT(i.value() < items_.size(), "index out of range");
    return items_[i.value()];
  }
  const T& operator[](Index<Tag> i) const {
    PARSEL_ASSERT(i.value() < items_.size(), "index out of range");
    return items_[i.value()];
  }
  Index<Tag> push_back(T item) {
    items_.push_back(std::move(item));
    return Index<Tag>(items_.size() - 1);
  }
  std::size_t size() const { return items_.size(); }
  bool empty() const { return items_.empty(); }
  bool operator==(const IndexedVector&) const = default;

  auto begin() { return items_.begin(); }
  auto end() { return items_.end(); }
  auto begin() const { return items_.begin(); }
  auto end() const { return items_.end(); }

  /// All indices in order, to iterate over: `for (PartIndex p : parts.indices())`.
  std::vector<Index<Tag>> indices() const {
    std::vector<Index<Tag>> all;
    all.reserve(items_.size());
    for (std::size_t i = 0; i < items_.size(); ++i) all.push_back(Index<Tag>(i));
    return all;
  }

 private:
  std::vector<T> items_;
};

using PartIndex = Index<struct PartTag>;
using RelationIndex = Index<struct RelationTag>;
template <class T>
using PartData = IndexedVector<PartTag, T>;
template <class T>
using RelationData = IndexedVector<RelationTag, T>;

}  // namespace parsel
