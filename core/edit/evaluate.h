// Evaluates a program at given parameter values: corners in, corners out, nothing solved.
//
// The state of a shape is the corners of every part and, for every translation or rotation group, its instances:
//   * A geometric operator on a real part moves that part's corners.
//   * On a virtual part it moves the parent's corners, and every instance of the group, its start and end points (or
//     centre) keep their local coordinates in the parent: they are carried by the parent's trilinear map, from the
//     parent's corners before the statement to those after. For a whole-part operator that is the operator itself.
//   * On a member of a group it moves that instance alone. Refused once the count of the group has been changed.
//   * change_delta (translation): instance i of n moves by (i − i₀)·a·delta with delta = (end − start)/(n − 1) and
//     i₀ = 0, (n−1)/2, n−1 for anchor start, middle (also fit), end. start and end move with the first and last
//     instance; the parent's corners on the side of the first (last) instance along the group's axis move by the same
//     vector.
//   * change_delta (rotation): instance k moves by a·r_k, r_k the vector from the axis to the instance's centre; the
//     parent's corner with in-plane signs (s₁, s₂) moves by a·radius·(s₁·e₁ + s₂·e₂), e₁, e₂ its in-plane axes.
//   * change_count: n' = max(1, n + floor(a + 1e-9)). Translation: anchor start keeps the first instance and delta, end
//   the
//     last, middle the mean of start and end; fit keeps start and end and spaces n' instances evenly between (n' = 1:
//     in the middle). Every new instance is a copy of the template (start, fit: first; end: last; middle: number
//     floor((n-1)/2)), translated. The parent's two sides follow the first and last instance as in change_delta.
//     Rotation: instance k is instance 0 turned by k·2π/n' about the axis; the parent stays.
//   * References (origin, direction, normal) are read on the state at the start of the layer.
// Statements of a layer run in order; each depends on the parameters and on its own part or group only.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/edit/program.h"

namespace parsel {

/// A translation or rotation group under edit.
struct GroupState {
  std::vector<Corners> instances;  ///< in order; as many as the relation has parts until a change_count
  bool count_changed = false;
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();    ///< translation
  Vec3 centre = Vec3::Zero(), axis = Vec3::Zero();  ///< rotation
  double radius = 0;                                ///< rotation
};

struct State {
  PartData<Corners> parts;          ///< members of a group whose count changed: the first of its instances, clamped
  RelationData<GroupState> groups;  ///< empty for relations that are no group
};

/// A program with its references and amounts compiled for one shape. Holds no reference to either.
class Evaluator {
 public:
  /// `program` must have passed validate() for `shape`.
  Evaluator(const Program& program, const Shape& shape);
  /// `values[i]` is the value of layer i's parameter. Deterministic, no allocation beyond the returned state.
  State operator()(const std::vector<double>& values) const;

 private:
  struct CompiledStatement;
  struct CompiledLayer;
  std::vector<CompiledLayer> layers_;
  // (private data is the implementation's to choose)
};

/// The shape at rest.
State rest_state(const Shape& shape);

}  // namespace parsel
