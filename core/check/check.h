// The independent checker of propagated programs and their traces: `parsel check`.
//
// It believes nothing that the propagation says and uses none of its code: programs are evaluated by replay.h,
// relations, tolerances, edited parts and active relations are worked out here once more, and everything is looked at
// numerically at many values of the parameter. So it can refute, never prove: a certified bound is accepted when
// nothing exceeds it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include "core/check/report.h"
#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

/// What is checked of a program:
///   * it is for this shape; parts, relations and references exist; operators have the fields they need;
///   * ranges contain 0 and the value; with all parameters 0 nothing moves (1e-6);
///   * over each layer's range (201 even values, ends included, and 40 random ones; other layers at their value):
///     amounts are defined and below 5 (a change_count: 1000 instances), no cage is inverted at a corner;
///   * every judged relation (is_judged() in core/prove/scope.h) that touches an edited part and exists while the
///     layer's parameter is 0 is reported, once, and no other but disabled groups;
///   * held: never beyond the tolerance; broken: beyond it somewhere; worst: never exceeded (1e-6, for it is rounded
///     when written), and no more than a tenth too large unless certified and within the tolerance.
/// Layers without any report are programs written by hand, whose authors claim nothing: only the first three are
/// checked. Time is linear in statements and relations: 242 evaluations of the program a layer.
CheckReport check_program(const Shape& shape, const Program& program);

/// The same, and what a trace (format parsel/trace v1, see trace.h) says of layer `layer`; see check_trace.cpp.
CheckReport check_program(const Shape& shape, const Program& program, const nlohmann::json& trace, std::size_t layer);

nlohmann::json to_json(const CheckReport& report);

}  // namespace parsel
