// How far a slider should go, from its seeds alone: far enough that its full travel is a change worth having of what it
// is about. Whether the model stays valid so far is another question (core/prove/extend.h).
#pragma once

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

/// An axis nearer to the vertical than 45°, about which a part opens or spins and does not lean.
inline constexpr double upright_axis = 0.7;

/// Of a parameter; low <= 0 <= high.
struct SliderSpan {
  double low = 0, high = 0;
};

/// The values of the layer's parameter between which each of its seeds stays a useful change, but at least ±`least`:
///
///   scale           half to twice; a part thinner than can be seen, up to a thickness that can
///   translate       a whole part by half the model, or by its own length; a face until the part is half or twice as
///                   long
///   rotate          ±110° for what opens or spins, as a door, a lid or a wheel: everything that the layer moves turns,
///                   and the part does not stand on its axis. ±30° for what leans, as a chair's back
///   shear           by the slope of ±30°
///   change_count    half to twice as many
///   change_delta    half to twice as far apart
///
/// Seeds are the statements with WhyKind::seed; references are read on the shape at rest. Amounts need not be the
/// parameter itself: the values are sought at which they reach so far. `least` > 0.
SliderSpan span_of_seeds(const Shape& shape, const Layer& layer, double least);

}  // namespace parsel
