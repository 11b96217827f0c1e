// Regions of a surface in one piece: fused models come apart where they are creased inwards.
//
// People see parts end at concave creases (the minima rule: Hoffman and Richards 1984, "Parts of recognition"). A crease
// that goes all the way round bounds a part by itself. Where it is interrupted, as at a leg that is flush with the seat
// above it, the surface is cut along the plane of one of the two faces that meet there, as approximate convex
// decomposition does at a notch (Lien and Amato 2007, "Approximate convex decomposition of polyhedra", §3), but no
// triangle is cut: it goes to the side of its centre. A cut counts only where creases run along enough of it, so that a
// plane through a whole model divides what lies at the crease and nothing else.
#pragma once

#include "core/split/seams.h"

namespace parsel::split {

struct CreaseOptions {
  /// An edge is a crease when the surface turns inwards by more than this, in radians (15°). Less: facets of a round
  /// thing that curves inwards. More: splayed legs.
  double angle = 0.26;
  /// A cut counts when creases make up this share of its length. A leg flush with two sides of a corner has 0.5.
  double share = 0.4;
  /// … and when they are this long, in half-diagonals.
  double length = 0.02;
  /// Planes that are tried for every cut, those along most crease first.
  std::size_t planes = 12;
  /// Surfaces of more triangles come apart along closed creases alone: a scan has a crease everywhere.
  std::size_t most_triangles = 200'000;
  /// Triangles looked at, over all planes and cuts; then what is left stays together. Some seconds.
  std::size_t visits = 20'000'000;
};

/// Numbers the triangles by region. `turned` as close_seams().
Components crease_regions(const PartMesh& mesh, const Seams& seams, bool turned, const CreaseOptions& options = {});

}  // namespace parsel::split
