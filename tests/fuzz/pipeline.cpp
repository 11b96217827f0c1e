#include "tests/fuzz/pipeline.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/json.h"
#include "core/check/check.h"
#include "core/export/apply.h"
#include "core/propagate/propagate.h"
#include "core/shape/abstraction.h"
#include "core/shape/words.h"

namespace parsel::fuzz {

namespace {

std::string told(const char* steps, const Error& error) {
  return std::string(steps) + ": " + error.message();
}

/// As `parsel inspect` writes it and the other commands read it.
std::optional<std::string> shape_fault(const Shape& shape) {
  if (const Status sound = validate(shape); !sound.ok()) return told("inspect, then validate", sound.error());
  const auto text = to_json(shape).dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
  const Result<nlohmann::json> json = json_from_text(text, "fuzz");
  if (!json.ok()) return told("inspect, then the gate of JSON", json.error());
  const Result<Shape> again = shape_from_json(*json);
  if (!again.ok()) return told("inspect, then read", again.error());
  if (const Status sound = validate(*again); !sound.ok()) return told("inspect, then read and validate", sound.error());
  if (describe(shape).empty()) return "describe gives nothing";
  return std::nullopt;
}

std::optional<std::string> program_fault(const Shape& shape, const Program& program) {
  if (const Status valid = validate(program, shape); !valid.ok())
    return told("propagate, then validate", valid.error());
  const Result<nlohmann::json> json = json_from_text(to_json(program).dump(), "fuzz");
  if (!json.ok()) return told("propagate, then the gate of JSON", json.error());
  const Result<Program> from_json = program_from_json(*json);
  if (!from_json.ok()) return told("propagate, then program_from_json", from_json.error());
  const Result<Program> from_text = program_from_text(to_text(program));
  if (!from_text.ok()) return told("propagate, then program_from_text", from_text.error());
  if (to_json(*from_text) != *json) return "propagate, then text: the text form is not the program";
  return std::nullopt;
}

}  // namespace

Walk walk(std::string_view glb, std::string_view edit) {
  Walk result;
  const auto ended = [&](std::optional<std::string> fault) {
    result.fault = std::move(fault);
    return result;
  };
  const Result<Abstraction> opened = abstract_shape(glb, "fuzz");
  if (!opened.ok()) return result;
  const Shape& shape = opened->shape;
  result.reached = Reached::shape;
  if (auto fault = shape_fault(shape)) return ended(fault);

  const Result<nlohmann::json> json = json_from_text(edit, "fuzz");
  if (!json.ok()) return result;
  const Result<EditRequest> request = edit_request_from_json(*json);
  if (!request.ok()) return result;
  result.reached = Reached::edit;
  const Result<Propagation> found = propagate(shape, *request);
  if (!found.ok()) return result;
  result.reached = Reached::program;
  const Program& program = found->program;
  if (auto fault = program_fault(shape, program)) return ended(fault);

  const CheckReport report = check_program(shape, program, to_json(found->trace), 0);
  if (!report.accepted()) {
    return ended("propagate, then check: " + report.findings[0].place + ": " + report.findings[0].text);
  }
  const Parameter& parameter = program.layers[0].parameter;
  for (const double value : {parameter.min, 0.0, parameter.max}) {
    const Result<Applied> applied = apply_program(glb, shape, program, {value});
    if (!applied.ok()) return ended(told("inspect, then apply", applied.error()));
    const Result<Abstraction> again = abstract_shape(applied->glb, "fuzz");
    if (!again.ok()) return ended(told("apply, then inspect", again.error()));
  }
  result.reached = Reached::model;
  return result;
}

}  // namespace parsel::fuzz
