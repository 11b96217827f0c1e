// Shapes built by hand from boxes, and programs for them, small enough to compute what must come out.
#pragma once

#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel::hand {

/// A box with axes along the global ones; returns its index.
PartIndex add_box(Shape& shape, const std::string& id, const Vec3& centre, const Vec3& half);
/// 1, 2, 4 or 8 points, given in the normalised frame.
RelationIndex attach(Shape& shape, const std::string& id, PartIndex a, PartIndex b, const std::vector<Vec3>& points);
/// Mirror images across x = 0; both boxes must have axes along the global ones.
RelationIndex mirror(Shape& shape, const std::string& id, PartIndex a, PartIndex b);

/// seat 0.8 × 0.1 × 0.8 around the origin; leg_left (x = 0.3) and leg_right, mirrored (r1), attached to the seat from
/// below (a1, a2: points); back across the seat's rear edge (a3: line, at x = ±0.4); door_handle inside the back (a4:
/// volume).
Shape chair();

/// A rail, and three slats along x at -0.2, 0, 0.2 below it, a translation (t1) with the parent slats; the parent hangs
/// on the rail (a1: face, the parent's upper corners); the first and last slat alone also do (a2, a3: points).
Shape slats();

/// A plate and four feet around y, a rotation (o1) with the parent feet at radius 0.3; the parent hangs on the plate
/// (a1).
Shape ring();

/// The ring with a motor inside it, to whose sides the feet (blades) are attached (a2 … a5: points), and to whose
/// centre their parent is (a6: point).
Shape fan();

/// A geometric statement on a whole part, with literal origin and directions.
Statement statement(Op op, const std::string& part, const Vec3& direction, const std::string& amount,
                    const Vec3& origin = Vec3::Zero(), const Vec3& normal = Vec3::UnitY());
Statement group_statement(Op op, const std::string& relation, const std::string& amount, Anchor anchor);

/// One layer with parameter x1 in [min, max].
Program program(const Shape& shape, std::vector<Statement> statements, double min = -0.35, double max = 0.35);

/// A program of 1 … 6 random statements on random parts of the shape: every geometric operator, any feature, literal
/// and part references, amounts from linear to nested roots and angles.
Program random_program(const Shape& shape, Random& random);
std::string random_amount(Random& random);

}  // namespace parsel::hand
