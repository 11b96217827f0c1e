// Rigorous bounds on where a program takes a shape: what core/edit/evaluate.h does in doubles, on Taylor jets.
//
// Within a layer only its own parameter varies; those of the other layers stand at their values. References are read at
// the start of the layer, which is the same for the whole range, so origins and directions are constants (thin
// intervals).
#pragma once

#include <vector>

#include "core/edit/program.h"
#include "core/prove/casework.h"
#include "core/prove/jet_state.h"
#include "core/shape/shape.h"

namespace parsel {

/// One layer of a program, ready to be evaluated over ranges of its parameter.
class Enclosure {
 public:
  /// Applies layers 0 … layer; later ones are not looked at. `program` passed validate() for `shape`, which must
  /// outlive this object.
  Enclosure(const Shape& shape, const Program& program, std::size_t layer);

  /// The state as jets of the layer's parameter, at a point (low == high) or over a range, where jumps and kinks are as
  /// `cases` say. Jets are not `defined` where no bound is known: amounts with singularities, a count that jumps inside
  /// the range without a case, and the instances of a group whose parent, already moved in this layer, is then edited
  /// by a feature (their local coordinates in it vary).
  JetState operator()(const Interval& x, const std::vector<Case>& cases = {}) const;

  /// Whether every amount is defined, without kink or jump over a range of the layer's parameter; so is every count.
  bool is_smooth(const Interval& x) const;

  /// All cases that are possible on the range: at each of its points the state is as one of them says. {{}} when
  /// nothing jumps; nothing when there are more than `most`.
  std::vector<std::vector<Case>> cases_over(const Interval& x, std::size_t most) const;

  /// Whether all amounts of the layer are shown to be defined and smaller in size over the range than `limit`, those of
  /// change_count than `most_instances`.
  bool amounts_below(double limit, double most_instances, const Interval& x) const;

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
    std::vector<std::size_t> questions;  ///< by instruction, see Casework
    std::size_t count = 0;               ///< the question that change_count asks

    /// What the operator is given: the amount, whole for change_count.
    Jet value(const Jet* parameters, const std::vector<Case>& cases, std::vector<OpenQuestion>* open) const;
  };

  void run(const std::vector<Step>& steps, const std::vector<Jet>& parameters, const std::vector<Case>& cases,
           JetState& state) const;
  std::vector<Jet> parameters_over(const Interval& x) const;
  bool extend(const Interval& x, std::vector<Case>& cases, std::size_t most, std::vector<std::vector<Case>>& all) const;

  const Shape* shape_;
  std::size_t layer_;
  std::vector<std::vector<Step>> layers_;  ///< 0 … layer
  std::vector<Jet> values_;                ///< of every layer's parameter
  std::size_t first_ = 0;                  ///< layers before it do not depend on the parameter …
  JetState base_;                          ///< … and lead to this state
};

}  // namespace parsel
