// How the triangles of a mesh hang together once its seams are closed.
//
// Exporters double vertices wherever normals or texture coordinates jump, so that a box is six loose squares. Here
// positions alone count (core/split/weld.h), and triangles are neighbours across an edge.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/shape/part.h"

namespace parsel::split {

/// Half-edge k = 0, 1, 2 of triangle t, from its corner k to the next, has the number 3 t + k.
using HalfEdge = std::uint32_t;
inline constexpr HalfEdge no_edge = std::numeric_limits<HalfEdge>::max();

struct Seams {
  /// By half-edge: the one that it is glued to, or no_edge along a border.
  std::vector<HalfEdge> across;
  /// By vertex: the first vertex at its place.
  std::vector<std::uint32_t> place;
};

/// Two triangles with an edge in common are neighbours. Where more than two meet, as where boxes touch along an edge,
/// those that bound the same solid are: going round the edge, a face that the solid begins at and the next at which it
/// ends (the pairing of Guéziec et al. 2001, "Cutting and stitching", by angle).
/// `turned`: the mesh is shown mirrored, so that its triangles are seen from inside. Takes time in proportion to size.
Seams close_seams(const PartMesh& mesh, bool turned);

/// By triangle: the number of its connected component, in the order of their first triangles.
struct Components {
  std::vector<std::uint32_t> of;
  std::uint32_t count = 0;
};

/// Triangles that can be reached through neighbours. `open(h)` false: half-edge h is not to be crossed.
template <class Open>
Components components(const Seams& seams, const Open& open) {
  Components found;
  const std::size_t triangles = seams.across.size() / 3;
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  found.of.assign(triangles, none);
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t first = 0; first < triangles; ++first) {
    if (found.of[first] != none) continue;
    found.of[first] = found.count;
    waiting.push_back(first);
    while (!waiting.empty()) {
      const std::uint32_t t = waiting.back();
      waiting.pop_back();
      for (HalfEdge h = 3 * t; h < 3 * t + 3; ++h) {
        const HalfEdge other = seams.across[h];
        if (other == no_edge || found.of[other / 3] != none || !open(h)) continue;
        found.of[other / 3] = found.count;
        waiting.push_back(other / 3);
      }
    }
    ++found.count;
  }
  return found;
}

}  // namespace parsel::split
