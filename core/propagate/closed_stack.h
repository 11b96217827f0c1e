// Where layers on layers take a part's corners, in closed form of all their parameters: what Evaluator (core/edit) does
// with numbers. Worked out part by part, and only for those that are asked for.
//
// Lengths are rational numbers of seven decimals, so that what cancels on paper cancels here. Not in closed form are: the
// instances of a group whose count or spacing is edited, axes that turn and stretch at once, and the clamps of a count.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "core/edit/displacement.h"
#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

using ClosedVector = Triple<GiNaC::ex>;
using ClosedCorners = std::array<ClosedVector, 8>;

/// What group operators look at; as in GroupState.
struct ClosedGroup {
  ClosedVector start, end;  ///< a row's
  GiNaC::ex gaps;           ///< a row's instances but one
  ClosedVector centre;      ///< a ring's
  GiNaC::ex radius;         ///< a ring's
};

struct ClosedPart {
  ClosedCorners corners;
  std::optional<ClosedGroup> group;  ///< of the parent of a group
};

/// The rational number of seven decimals next to a length.
GiNaC::ex closed_length(double value);
/// Expanded, without terms that are rounding (below 1e-6).
GiNaC::ex cleaned(const GiNaC::ex& e);

class ClosedStack {
 public:
  /// `shape` and `layers` must live as long. Statements of a layer may be changed while no part that they edit has been
  /// asked for behind that layer.
  ClosedStack(const Shape& shape, const std::vector<Layer>& layers) : shape_(shape), layers_(layers) {}

  /// The part behind the first `count` layers; null when it has no closed form.
  const ClosedPart* part(PartIndex part, std::size_t count);

  /// What `statements`, all on this part, on its group or on its parent, make of `before` as statements of the layer of
  /// number `layer`. Nothing when it has no closed form.
  std::optional<ClosedPart> after(PartIndex part, const ClosedPart& before,
                                  const std::vector<const Statement*>& statements, std::size_t layer);

  /// The point and unit vector that a reference names where the layer starts.
  std::optional<ClosedVector> point(const PointReference& reference, std::size_t layer);
  std::optional<ClosedVector> direction(const DirectionReference& reference, std::size_t layer);

 private:
  ClosedPart at_rest(PartIndex part) const;
  bool edit_group(PartIndex part, const Statement& statement, ClosedPart& state) const;
  std::optional<ClosedVector> unit_axis(PartIndex part, const ClosedCorners& corners, int axis) const;

  const Shape& shape_;
  const std::vector<Layer>& layers_;
  std::map<std::pair<PartIndex, std::size_t>, std::optional<ClosedPart>> known_;
};

}  // namespace parsel
