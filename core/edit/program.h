// Editing programs: layers of statements, their JSON (`parsel/program` v1) and text forms, and their gate.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "core/edit/amount.h"
#include "core/edit/operators.h"
#include "core/shape/shape.h"

namespace parsel {

/// {"part": id, "at": [triple]}: a feature point of a part, on its state at the start of the layer.
struct PartPoint {
  std::string part;
  LocalTriple at{0, 0, 0};
  bool operator==(const PartPoint&) const = default;
};
/// {"part": id, "axis": 0|1|2}: the direction from the part's - face centre to its + face centre, at the layer's start.
struct PartAxis {
  std::string part;
  int axis = 0;
  bool operator==(const PartAxis&) const = default;
};
using PointReference = std::variant<Vec3, PartPoint>;
using DirectionReference = std::variant<Vec3, PartAxis>;

enum class WhyKind { seed, symmetry, attachment, neighbour, breaking, group };
struct Why {
  WhyKind kind = WhyKind::seed;
  std::vector<std::string> relations;
};

struct Statement {
  Op op = Op::keep_fixed;
  std::string part;      ///< geometric operators and keep_fixed
  std::string relation;  ///< change_count, change_delta
  LocalTriple feature{0, 0, 0};
  std::optional<PointReference> origin;
  std::optional<DirectionReference> direction;  ///< "axis" in JSON for rotate
  std::optional<DirectionReference> normal;
  Anchor anchor = Anchor::middle;
  Amount amount;
  std::optional<Why> why;
};

enum class RelationStatus { held, broken, disabled };
enum class Proof { certified, sampled };
struct RelationReport {
  std::string id;
  RelationStatus status = RelationStatus::held;
  double worst = 0;  ///< largest deviation of a coordinate over the range, normalised
  Proof proof = Proof::sampled;
};

struct Parameter {
  std::string name;
  double min = 0, max = 0, value = 0;
};

/// Layers run in order; a part edited by one is the input of the next (paper §8.1).
struct Layer {
  std::string request;
  Parameter parameter;
  std::vector<Statement> statements;
  std::vector<RelationReport> relations;
};

struct Program {
  std::string shape_name;
  std::string shape_sha256;
  std::vector<Layer> layers;
};

/// Untrusted JSON → a well-formed program (structure, types, limits, grammar), independent of any shape. Unknown keys
/// are refused by name. Error place is a JSON pointer: "/layers/0/statements/3/amount".
Result<Program> program_from_json(const nlohmann::json& json);
nlohmann::json to_json(const Program& program);

/// The text form, one statement a line, lossless. Error place is "line L, column C".
std::string to_text(const Program& program);
Result<Program> program_from_text(std::string_view text);

/// Whether the program makes sense for the shape: known parts and relations, fields that the operator needs, amounts
/// real and finite over the parameters' whole ranges, groups used as groups. Returns the first fault.
Status validate(const Program& program, const Shape& shape);

}  // namespace parsel
