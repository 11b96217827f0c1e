// Pieces of a surface that bound nothing by themselves: the inner face of a wall, the back of a bookcase between two
// shelves, a hollow. They belong to what the solid behind them ends at.
//
// A ray from a face into its solid leaves it on the other side of the same part: the idea of the shape diameter function
// (Shapira, Shamir and Cohen-Or 2008, "Consistent mesh partitioning and skeletonisation using the shape diameter function",
// The Visual Computer 24(4), §3). Here the ray says which piece is there, not how far it is.
#pragma once

#include "core/split/seams.h"

namespace parsel::split {

struct BehindOptions {
  /// A piece is a sheet when this share of its area looks along its mean normal, to within about 15°.
  double flat_share = 0.95, flat_cosine = 0.97;
  /// Rays a piece, from its largest triangles.
  std::size_t rays = 16;
  /// Triangles looked at, over all rays: about a second. Then what is left stays by itself.
  std::size_t visits = 100'000'000;
};

/// Joins sheets that hang together with other pieces, and closed surfaces that face inwards, to the piece that most of their
/// rays leave the solid through. `turned` as close_seams(). Numbers are in the order of first triangles.
Components join_behind(const PartMesh& mesh, const Seams& seams, bool turned, const Components& pieces,
                       const BehindOptions& options = {});

}  // namespace parsel::split
