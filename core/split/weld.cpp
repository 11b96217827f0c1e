#include "core/split/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace parsel::split {
namespace {

using Cell = std::array<std::int64_t, 3>;

std::uint64_t hash_of(const Cell& cell) {
  std::uint64_t hash = 0;
  for (const std::int64_t c : cell) hash = HashChains::mixed(hash ^ static_cast<std::uint64_t>(c));
  return hash;
}

}  // namespace

HashChains::HashChains(std::size_t size)
    : first_(std::bit_ceil(std::max<std::size_t>(size, 1)), none), next_(size, none) {}

void HashChains::add(std::uint64_t hash, std::uint32_t item) {
  std::uint32_t& first = first_[hash & (first_.size() - 1)];
  next_[item] = first;
  first = item;
}

// The finaliser of MurmurHash3 (Austin Appleby, public domain).
std::uint64_t HashChains::mixed(std::uint64_t x) {
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdULL;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53ULL;
  return x ^ x >> 33;
}

std::vector<std::uint32_t> weld(const std::vector<Vec3>& positions, double tolerance) {
  // A vertex stands in one cell; what is near it in that one and at most seven around.
  const double side = 4 * tolerance;
  const auto cell = [&](double c) { return static_cast<std::int64_t>(std::floor(c / side)); };
  std::vector<std::uint32_t> place(positions.size());
  HashChains kept(positions.size());
  const auto found_in = [&](const Cell& at, const Vec3& p) {
    std::uint32_t k = kept.first(hash_of(at));
    while (k != HashChains::none && (positions[k] - p).squaredNorm() > tolerance * tolerance) k = kept.next(k);
    return k;
  };
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    place[v] = v;
    const Vec3& p = positions[v];
    if (p.hasNaN()) continue;
    const Cell own = {cell(p[0]), cell(p[1]), cell(p[2])};
    std::uint32_t found = found_in(own, p);
    for (int around = 1; around < 8 && found == HashChains::none; ++around) {
      Cell at = own;
      bool beside = true;  // whether there is such a cell within the tolerance
      for (int i = 0; i < 3; ++i) {
        if (!(around >> i & 1)) continue;
        const auto k = static_cast<std::size_t>(i);
        const std::int64_t low = cell(p[i] - tolerance), high = cell(p[i] + tolerance);
        beside = beside && low != high;
        at[k] = low != own[k] ? low : high;
      }
      if (beside) found = found_in(at, p);
    }
    if (found == HashChains::none) {
      kept.add(hash_of(own), v);
    } else {
      place[v] = found;
    }
  }
  return place;
}

}  // namespace parsel::split
