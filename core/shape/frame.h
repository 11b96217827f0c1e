// The axes that a model stands along: furniture is put into rooms at any angle, and is still made of right angles.
#pragma once

#include "core/base/geometry.h"
#include "core/base/index.h"
#include "core/shape/part.h"

namespace parsel {

struct FrameOptions {
  /// Faces whose normal rises less than this (sine, 10°) tell the yaw. Less: a splayed chair has none. More: slopes of
  /// a roof count.
  double upright = 0.17;
  /// Faces count as along an axis within this, in degrees. Less: hand-made models spread. More: round legs count.
  double along = 0.5;
  /// The own axes must hold this share of the upright faces. Less: the facets of a round table have a direction.
  double share = 0.3;
  /// … and this many times what the file's axes hold. Less: a diamond on a straight cabinet turns it.
  double clearer = 2;
  /// A model turned by less than this, in degrees, stands along the file's axes: tolerances cover it.
  double turned = 0.1;
};

/// The model's own axes as rows, in the coordinates of the meshes: the vertical one, +y, is kept, the others are turned
/// about it, by at most 45°, to where most of the upright faces point. The identity where there is nothing to see.
Mat3 own_axes(const PartData<PartMesh>& meshes, const FrameOptions& options = {});

/// Puts meshes that are normalised in `frame` into the normalised frame along `axes`, which `frame` becomes.
void turn_into(const Mat3& axes, PartData<PartMesh>& meshes, Frame& frame);

}  // namespace parsel
