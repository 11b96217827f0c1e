// The state of a shape on jets, and how operators change it: the rules of core/edit/evaluate.h, whose notation this is.
// H corners, n instances, p_i places, q_j new places.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/edit/displacement.h"
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

template <>
Rotor<Jet> rotor_of(const Jet& angle);

/// A geometric operator on points.
class JetMotion {
 public:
  JetMotion(Op op, const JetPoint& origin, const JetPoint& direction, const JetPoint& normal, const Jet& amount);
  JetPoint operator()(const JetPoint& point) const;

 private:
  JetPoint origin_;
  Displacement<Jet> displacement_;
};

JetState rest_jets(const Shape& shape);

/// Where a reference points.
JetPoint resolve(const Shape& shape, const JetState& state, const PointReference& reference);
/// Unit; nothing when the axis of a part is degenerate, and unknown when it may be.
std::optional<JetPoint> resolve(const Shape& shape, const JetState& state, const DirectionReference& reference);

/// A geometric operator on the virtual parent of group `r`.
void edit_parent(const Shape& shape, PartIndex parent, RelationIndex r, const JetMotion& motion,
                 const LocalTriple& feature, JetState& state);
void change_delta(const Shape& shape, RelationIndex r, const Jet& amount, Anchor anchor, JetState& state);
/// `extra`: whole instances more.
void change_count(const Shape& shape, RelationIndex r, const Jet& extra, Anchor anchor, JetState& state);

}  // namespace parsel
