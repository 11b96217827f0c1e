// Vertices at one place: exporters double them wherever normals or texture coordinates jump.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/geometry.h"

namespace parsel::split {

/// Vertices within this distance, in half-diagonals of the model, are one. Less: positions quantised to 14 bits do not
/// meet. More: the two sides of a thin sheet do.
inline constexpr double weld_distance = 1e-5;

/// By vertex: the first one within `tolerance` of it that has no earlier one itself. NaN meets nothing. Takes time in
/// proportion to the number of vertices.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& positions, double tolerance = weld_distance);

/// Chains of numbers below a known size by hash: a bucket's first, and each one's next.
class HashChains {
 public:
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  explicit HashChains(std::size_t size);
  std::uint32_t first(std::uint64_t hash) const { return first_[hash & (first_.size() - 1)]; }
  std::uint32_t next(std::uint32_t item) const { return next_[item]; }
  void add(std::uint64_t hash, std::uint32_t item);
  /// A hash of which every bit depends on every bit of `x`.
  static std::uint64_t mixed(std::uint64_t x);

 private:
  std::vector<std::uint32_t> first_, next_;
};

}  // namespace parsel::split
