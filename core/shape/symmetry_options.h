// The tolerances of the symmetry search. Lengths are in the normalised frame; each says what goes wrong on either side.
#pragma once

#include <cstddef>

namespace parsel {

struct SymmetryOptions {
  /// Centres and extents of like parts may differ by this much. Smaller: hand-modelled twins and models in millimetres
  /// rounded to whole ones lose their relations. Larger: an edit that carries one part over to the other is off by more
  /// than a relation may be (δ = 0.0144).
  double position = 0.01;
  /// A mirror image may miss its twin by this much across the plane: both centres may be off. Bounds as for `position`.
  double image = 0.015;
  /// A pair's own middle may be this far off the plane that it is put on, so that its image is off by `image` at most.
  /// Smaller: four legs get four planes, which do not agree with each other. Larger: images miss their twins.
  double plane = 0.0075;
  /// Centres closer to each other than this along an axis lie on the plane: a part that is its own image is no pair.
  /// Smaller: two layers of a seat are mirror images. Larger: leaves of a hinge, a drawer's front and back are not.
  double apart = 0.01;
  /// A surface may be off by this share of the part's half-diagonal, at most `position` …
  double surface = 0.05;
  double finest = 0.002;  ///< … and need not be closer than this: float noise and coarse tessellation stay below.
  /// Share of the samples that must lie on the other surface. 1: one screw hole parts two doors. Much less: a door with
  /// a window is the image of one without.
  double agreeing = 0.95;
  /// Samples a surface: 5 % of 200 are 10, enough that chance does not decide; time grows with it.
  std::size_t samples = 200;
  /// Surface areas of like parts may differ by this share. Less: tessellations of a circle differ. More: says nothing.
  double area = 0.1;

  /// Share of the parts at one height that a ring must have. Less: corners of a grid, on a circle by chance, are rings.
  double ring_share = 0.5;
  /// A ring's parts are this far from its axis, and the plane of its axis is this wide. Less: what is stacked is a
  /// ring.
  double ring_radius = 0.02;
  /// A normal of a ring's plane this near (cos) to a global axis is that axis, 1°: tried already.
  double same_axis = 0.9998;
  /// A blade is longer than wide by this, and points along the radius within 30° (cos). Less: square legs that stand on
  /// a circle are blades and their mirror images are lost. More: stubby feet of a star base are none.
  double blade_length = 1.2, blade_angle = 0.866;

  /// A single step of a row may be off by this share of it, so that parts closer than `position` are told apart.
  double row_step = 0.15;
  /// Neighbours of a part that a row may go on to. Fewer: every second slat of a grid. More: time, squared.
  std::size_t row_neighbours = 16;
  /// Rows that cross compete, longest first; what one leaves over may still be a row, this often.
  int row_rounds = 8;
};

}  // namespace parsel
