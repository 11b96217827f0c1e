// Evaluates a program at given parameter values: corners in, corners out, nothing solved.
//
// The state of a shape is the corners of every part and, for every translation or rotation group, its instances. Layers
// run in order, and the statements of a layer in order; each depends on the parameters and on its own part or group
// only. web/src/program/interpret.ts does the same; tests/golden/program_vectors.json keeps the two in step.
//
// References (origin, direction, normal) are read on the state at the start of the layer. The direction of a part's
// axis is the unit vector from its - to its + face centre; when those are closer than 1e-12 the statement does nothing.
// A literal direction is normalised. An amount that is not finite counts as 0 (validate() refuses such programs).
//
// A geometric operator
//   * on a real part moves that part's corners;
//   * on a member of a group moves that instance alone: not the group's points, not the parent. Refused by validate()
//     once a change_count on the group stands before it. Member k is instance min(k, n - 1) after that;
//   * on a virtual part moves the parent's corners; every instance of the group, its start and end (or centre) keep
//     their local coordinates in the parent. For the whole-part feature that is the operator itself. For other features a
//     point moves by Σₖ Nₖ(u)·(H'ₖ - Hₖ), u its local coordinates in the parent before the statement (see
//     local_coordinates()). A rotation group's axis then is along the parent's local axis parent_axis, with the sign
//     that it has at rest (it stays when that axis is degenerate), and its radius the mean distance of the instances'
//     centres from the axis.
//
// Translation groups. Instance i of n stands at p_i = start + i·delta with delta = (end - start)/(n - 1); a single one
// at (start + end)/2, and then delta is that of the shape at rest. The parent's first side, its corners with sign
// -direction along `axis`, moves with start, its last side with end.
//   * change_delta: instance i moves by (i - i₀)·a·delta, i₀ = 0, (n - 1)/2, n - 1 for anchor start, middle (also fit),
//     end. start and end move with the first and last instance. n = 1: nothing moves.
//   * change_count: n' = n + counted(a) (core/amount/amount.h), clamped to 1…1000. When n' = n nothing changes. Else
//   all n' instances are
//     copies of instance t, translated by q_j - p_t:
//       start   t = 0              q_j = p_0 + j·delta                                start = q_0, end = q_{n'-1}
//       end     t = n - 1          q_j = p_{n-1} - (n' - 1 - j)·delta                 likewise
//       middle  t = ⌊(n - 1)/2⌋    q_j = (start + end)/2 + (j - (n' - 1)/2)·delta     likewise
//       fit     t = 0              q_j = start + j·(end - start)/(n' - 1)             start, end stay
//     (fit with n' = 1: q_0 = (start + end)/2).
// Rotation groups; anchors are ignored.
//   * change_delta: instance k moves by a·r_k, r_k the vector from the axis to the instance's centre (the mean of its
//     corners). The parent's corner with in-plane signs (s₁, s₂) moves by a·radius·(s₁·e₁ + s₂·e₂), e₁ and e₂ the unit
//     directions of its two other local axes before the statement, zero when degenerate. Then radius becomes
//     (1 + a)·radius.
//   * change_count: n' as above; when n' ≠ n, instance k is instance 0 turned by k·2π/n' about the axis. The parent
//     stays.
#pragma once

#include <memory>
#include <vector>

#include "core/edit/program.h"
#include "core/edit/state.h"

namespace parsel {

/// A program with its references and amounts compiled for one shape. Holds no reference to either.
class Evaluator {
 public:
  /// `program` must have passed validate() for `shape`.
  Evaluator(const Program& program, const Shape& shape);

  /// `values[i]` is the value of layer i's parameter. Deterministic.
  State operator()(const std::vector<double>& values) const;

 private:
  struct Implementation;
  std::shared_ptr<const Implementation> implementation_;
};

/// The shape at rest.
State rest_state(const Shape& shape);

}  // namespace parsel
