// Rigorous bounds on where a program takes a shape: what core/edit/evaluate.h does in doubles, on Taylor jets.
//
// Within a layer only its own parameter varies; those of the other layers stand at their values. References are read at
// the start of the layer, which is the same for the whole range, so origins and directions are constants (thin
// intervals).
#pragma once

#include <array>
#include <vector>

#include "core/edit/program.h"
#include "core/prove/jet.h"
#include "core/shape/shape.h"

namespace parsel {

using JetPoint = std::array<Jet, 3>;
using JetCorners = std::array<JetPoint, 8>;

/// GroupState on jets.
struct JetGroup {
  std::vector<JetCorners> instances;
  bool count_changed = false;
  JetPoint start, end;    ///< translation
  JetPoint centre, axis;  ///< rotation
  Jet radius;             ///< rotation
};

struct JetState {
  PartData<JetCorners> parts;
  RelationData<JetGroup> groups;  ///< empty for relations that are no group
};

/// One layer of a program, ready to be evaluated over ranges of its parameter.
class Enclosure {
 public:
  /// Applies layers 0 … layer; later ones are not looked at. `program` passed validate() for `shape`, which must
  /// outlive this object.
  Enclosure(const Shape& shape, const Program& program, std::size_t layer);

  /// The state as jets of the layer's parameter, at a point (low == high) or over a range. Jets are not `defined` where
  /// no bound is known: amounts with singularities, a count that jumps inside the range, and the instances of a group
  /// whose parent, already moved in this layer, is then edited by a feature (their local coordinates in it vary).
  JetState operator()(const Interval& x) const;

  /// Whether every amount is defined, without kink or jump over a range of the layer's parameter; so is every count.
  bool is_smooth(const Interval& x) const;

 private:
  struct Step {
    Op op;
    LocalTriple feature;
    Anchor anchor;
    std::optional<PartIndex> part;
    std::optional<RelationIndex> relation;
    std::optional<PointReference> origin;
    std::optional<DirectionReference> direction, normal;
    CompiledAmount amount;
  };

  void run(const std::vector<Step>& steps, const std::vector<Jet>& parameters, JetState& state) const;

  const Shape* shape_;
  std::size_t layer_;
  std::vector<std::vector<Step>> layers_;  ///< 0 … layer
  std::vector<Jet> values_;                ///< of every layer's parameter
  std::size_t first_ = 0;                  ///< layers before it do not depend on the parameter …
  JetState base_;                          ///< … and lead to this state
};

}  // namespace parsel
