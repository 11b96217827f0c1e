// Solids of the gallery: closed triangle meshes that exactly fill a box of a given size, centred at the origin.
//
// A Solid is a recipe: size in metres → mesh. Bevels and profiles are given in metres as well; a recipe is always run
// at the size the part has in the model's default state and then stretched to the size asked for (model_builder.h), so
// that a regenerated part is exactly what an affine edit of its control cage gives, bevels included.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/geometry.h"

namespace parsel::gallery {

/// Counter-clockwise triangles seen from outside, one unit normal a vertex.
struct TriangleMesh {
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

using Solid = std::function<TriangleMesh(const Vec3& size)>;
using Point2 = Eigen::Vector2d;

/// A box whose edges are rounded with `radius` metres (at most half the smallest side).
Solid rounded_box(double radius, int segments = 2);

/// A rounded box, vertical, that keeps its section above the fraction `from` of its height and narrows below it to
/// `foot` times the section.
Solid tapered_box(double radius, double foot, double from = 1.0);

/// An upholstered box: large radius and faces that swell by `swell` metres.
Solid cushion(double radius, double swell);

/// A box whose top edge rises towards the middle of its width: its corners are lower by `rise` metres.
Solid arched_box(double radius, double rise);

/// A surface of revolution about the y axis. `profile` holds (radius, height) from bottom to top in fractions: radius 1
/// touches the box sideways, heights run from 0 to 1. Open ends are closed with caps; edges sharper than 35° stay so.
Solid turned(std::vector<Point2> profile, int segments = 32);

/// A vertical cylinder with a rounded rim of `bevel` metres.
Solid cylinder(double bevel, int segments = 32);

/// A vertical round leg or shade: cylinder() with `bottom` and `top` radii as fractions, the larger of them 1.
Solid cone(double bottom, double top, double bevel, int segments = 32);

/// A ring about the y axis with an elliptical section of `tube` metres radially; its height is the box's.
Solid ring(double tube, int segments = 48, int tube_segments = 12);

/// A hollow tube about the y axis, open above and below: walls of `wall` metres, `top` the upper radius as a fraction
/// of the lower one (lamp shades).
Solid shade(double wall, double top, int segments = 48);

/// A prism along z whose section is the convex polygon `outline` (counter-clockwise, fractions -1…1 of the box in x and
/// y), with edges chamfered by `bevel` metres.
Solid prism(std::vector<Point2> outline, double bevel);

/// A pyramid or polygonal roof about the y axis with `sides` straight sides from the full section below to the fraction
/// `top` above, first corner at `phase` radians from +z towards +x; flat-shaded. The box is that of the round it is
/// inscribed in only when corners lie on the axes; it is stretched to fill its box.
Solid faceted(int sides, double top, double phase, double lip);

/// Another solid turned so that its y axis becomes x or z (cross bars, wheels, pegs).
Solid along_x(Solid solid);
Solid along_z(Solid solid);

}  // namespace parsel::gallery
