// What the geometric operators do to a point (the table of operators.h), written once for every kind of number: doubles
// (apply_operator), jets of intervals (core/prove), closed forms (core/propagate). The checker's replay, the page's
// readable interpreter and the reference in Python are written apart, to be held against this.
#pragma once

#include <array>
#include <cmath>

#include "core/edit/operators.h"

namespace parsel {

template <class T>
using Triple = std::array<T, 3>;

template <class T>
struct Rotor {
  T sine, cosine;
};
/// Sine and cosine of T: specialised where T is used.
template <class T>
Rotor<T> rotor_of(const T& angle);
template <>
inline Rotor<double> rotor_of(const double& angle) {
  return {std::sin(angle), std::cos(angle)};
}

/// An operator with an amount, and everything that does not depend on the point worked out once.
template <class T>
class Displacement {
 public:
  /// As in ResolvedOperator; what the operator does not need is not read.
  Displacement(Op op, Triple<T> direction, Triple<T> normal, T amount)
      : op_(op), direction_(std::move(direction)), normal_(std::move(normal)), amount_(std::move(amount)) {
    if (op_ == Op::rotate) rotor_ = rotor_of(amount_);
  }

  /// H' - H of a point H, from its lever r = H - o.
  Triple<T> operator()(const Triple<T>& r) const {
    switch (op_) {
      case Op::translate:
        return times(amount_, direction_);
      case Op::rotate: {
        const T along = dot(direction_, r);
        const Triple<T> turned = times(rotor_.sine, cross(direction_, r));
        const Triple<T> shrunk = times(rotor_.cosine - T(1), minus(r, times(along, direction_)));
        return {turned[0] + shrunk[0], turned[1] + shrunk[1], turned[2] + shrunk[2]};
      }
      case Op::scale_1d:
        return times(amount_ * dot(direction_, r), direction_);
      case Op::scale_2d:
        return times(amount_, minus(r, times(dot(normal_, r), normal_)));
      case Op::scale_3d:
        return times(amount_, r);
      case Op::shear:
        return times(amount_ * dot(normal_, r), direction_);
      case Op::keep_fixed:
        return {T(0), T(0), T(0)};
      case Op::change_count:
      case Op::change_delta:
        break;
    }
    PARSEL_ASSERT(false, "the group operators move instances, not points");
    return {T(0), T(0), T(0)};
  }

 private:
  static Triple<T> times(const T& s, const Triple<T>& a) { return {s * a[0], s * a[1], s * a[2]}; }
  static Triple<T> minus(const Triple<T>& a, const Triple<T>& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static T dot(const Triple<T>& a, const Triple<T>& b) { return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]); }
  static Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }

  Op op_;
  Triple<T> direction_, normal_;
  T amount_;
  Rotor<T> rotor_{T(0), T(1)};  ///< rotate
};

}  // namespace parsel
