// Pieces of a mesh: what becomes a part each.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/geometry.h"
#include "core/shape/part.h"
#include "core/split/seams.h"

namespace parsel::split {

struct Piece {
  std::vector<std::uint32_t> triangles;  ///< indices into PartMesh::triangles, ascending
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  double area = 0;

  double diagonal() const { return (high - low).norm(); }
};

/// The pieces that a numbering of a mesh's triangles names, in its order.
std::vector<Piece> pieces_of(const PartMesh& mesh, const Components& numbering);

/// The length below which a piece is small, in half-diagonals of the model: its own diagonal. `fine` in [0, 1]: 0.4 at
/// 0, 0.02 at 0.5 (a screw; a door's knob is larger), nothing at 1.
double small_below(double fine);

/// Joins what is small to what it sits on: of the pieces whose boxes it reaches into, the smallest that is not small
/// itself, else the nearest. Pieces of which none is large enough, or more than `most` are, stay as they are: the latter so
/// that the time is bounded. Answers how many were joined.
std::size_t join_small(std::vector<Piece>& pieces, double below, std::size_t most);

}  // namespace parsel::split
