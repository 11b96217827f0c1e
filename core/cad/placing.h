// From a solid in its own coordinates and an affine map to a part along the axes.
#pragma once

#include <optional>

#include "core/cad/model.h"

namespace parsel::cad {

/// A solid as OpenSCAD makes it, before any map: its axis is z. Colours, places and labels are the caller's.
struct Raw {
  Kind kind = Kind::box;
  Vec3 centre = Vec3::Zero();
  Vec3 size = Vec3::Ones();  ///< cylinder, cone: diameter, diameter, height
  double top = 0;            ///< cone
  int sides = 0;             ///< cylinder, cone; its first corner lies towards +x
};

/// An affine map: what OpenSCAD's transformations amount to.
struct Map {
  Mat3 linear = Mat3::Identity();
  Vec3 offset = Vec3::Zero();

  /// First `inner`, then this one.
  Map after(const Map& inner) const { return {linear * inner.linear, linear * inner.offset + offset}; }
};

/// OpenSCAD's frame to ours.
Map to_gltf_frame();

/// The solid under the map, with numbers of 12 significant digits; of kind opaque, with the box that it needs, when it
/// does not lie along the axes. Nothing when the map makes it flat.
std::optional<Part> placed(const Raw& raw, const Map& map);

/// 12 significant digits, and zero for what is within 1e-12 of it: sums of decimals come out as they read.
double tidy(double value);

}  // namespace parsel::cad
