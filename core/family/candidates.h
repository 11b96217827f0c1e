// Candidate constraints: what may be meant by two features of a model lying alike (ReparamCAD §3.4.1).
//
// kind        features of a part                                                  rows
// coplanar    planes: a box's six faces, a cylinder's two caps                    1: their coordinates
// coaxial     axes: a box's three through its centre, a round part's own          2: the other two coordinates
// coincident  points: a box's corners, a round part's cap centres, a sphere's     3
//             centre
// equal       sizes along x, y and z                                              1
// All pairs along the same direction: coplanar, coincident and equal within a part as well, equal across directions.
// The extended vocabulary adds the planes that bound cylinders sideways and spheres (nothing else ties the front wheels
// of a car to its rear wheels: with them its 94 constraints of rank 31 become 110 of rank 32) and tops of cones as sizes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/geometry.h"
#include "core/family/elimination.h"
#include "core/family/layout.h"

namespace parsel::family {

enum class ConstraintKind { coplanar, coaxial, coincident, equal };
std::string_view to_string(ConstraintKind kind);
inline constexpr ConstraintKind constraint_kinds[] = {ConstraintKind::coplanar, ConstraintKind::coaxial,
                                                      ConstraintKind::coincident, ConstraintKind::equal};

/// A linear form of the parameters, in halves: Σ halves/2 · parameter.
struct Term {
  std::size_t parameter = 0;
  int halves = 0;
};
using Form = std::vector<Term>;

/// A plane, axis, point or size of a part, with what it amounts to in the parameters, one form a row.
struct Feature {
  std::size_t part = 0;
  std::string name;  ///< "seat.x-", "wheel.x", "seat.x-y+z-", "seat.sx"
  std::vector<Form> forms;
};

struct Constraint {
  ConstraintKind kind = ConstraintKind::coplanar;
  Feature a, b;

  std::string id() const;  ///< "coplanar(seat.x-,back.x-)"
  /// One a row of the constraint: form of a minus form of b.
  std::vector<SparseRow> rows() const;
  /// The largest absolute value of its rows.
  double residual(const Values& values) const;
};

double value_of(const Form& form, const Values& values);

/// A part's face across an axis, side -1 or 1: c ± s/2.
Form plane_form(const Layout& layout, std::size_t part, int axis, int side);

/// How many candidates there are, by kind in the order of constraint_kinds.
struct Count {
  std::size_t by_kind[4] = {0, 0, 0, 0};
  std::size_t all() const { return by_kind[0] + by_kind[1] + by_kind[2] + by_kind[3]; }
};

struct Candidates {
  Count count;                      ///< of all pairs
  std::vector<Constraint> holding;  ///< those whose residual at `values` is at most the tolerance, in order of kinds
};

/// `tolerance` in the model's unit.
Candidates find_candidates(const Layout& layout, const cad::Model& model, const Values& values, double tolerance);

}  // namespace parsel::family
