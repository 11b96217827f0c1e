// Editing programs: layers of statements, their JSON (`parsel/program` v1) and text forms, and their gate.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/amount/amount.h"
#include "core/base/result.h"
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
  Amount amount;  ///< of any parameters of the program; zero for keep_fixed
  std::optional<Why> why;
};

enum class RelationStatus { held, broken, disabled };
enum class Proof { certified, sampled };
struct RelationReport {
  std::string id;
  RelationStatus status = RelationStatus::held;
  double worst = 0;  ///< largest deviation of a coordinate over the range, normalised
  Proof proof = Proof::sampled;
  std::optional<int> samples;  ///< when sampled: at how many values of the parameter, if known
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

/// The part whose corners a statement moves: its part, or the parent of its relation. Nothing when unknown.
std::optional<PartIndex> part_of(const Shape& shape, const Statement& statement);

std::string_view to_string(WhyKind kind);
std::optional<WhyKind> why_kind(std::string_view text);
std::string_view to_string(RelationStatus status);
std::optional<RelationStatus> relation_status(std::string_view text);
std::string_view to_string(Proof proof);
std::optional<Proof> proof(std::string_view text);

/// What a program may hold, whoever made it: writers keep to it as readers do (readable.h), and
/// web/src/program/schema.ts has the same numbers (tests/web/limits.test.ts compares them). Bytes are those of UTF-8.
struct ProgramLimits {
  static constexpr std::size_t layers = 100;
  static constexpr std::size_t statements = 10'000;  ///< in the whole program
  /// A layer: one for each relation that an edit may touch. The largest model that opens has 2,000 parts; a field of as
  /// many boxes on a board has 11,800 relations. So many reports still fit text_bytes.
  static constexpr std::size_t reports = 100'000;
  static constexpr std::size_t why_relations = 256;  ///< a statement
  static constexpr std::size_t name_bytes = 200;     ///< ids and names
  static constexpr std::size_t request_bytes = 4'096;
  static constexpr std::size_t parameter_bytes = 64;
  static constexpr std::size_t text_bytes = 8'388'608;  ///< of the text form
  static constexpr double coordinate = 1e6;             ///< of a literal point
  static constexpr double shortest_direction = 1e-9;    ///< a literal direction is longer
  static constexpr double amount = 1e6;                 ///< |amount| over the ranges
  static constexpr double instances = 1000;             ///< of a group; also |amount| of a change_count
  static constexpr int samples = 1'000'000;             ///< that a report may speak of
};

/// Untrusted JSON → a well-formed program (structure, types, limits, grammar), independent of any shape. Unknown keys
/// are refused by name, and so are those that the operator does not take: translate takes direction; rotate origin and
/// axis; scale_1d origin and direction; scale_2d origin and normal; scale_3d origin; shear origin, normal and
/// direction, each with part, amount and, if wanted, feature; change_count and change_delta take relation, amount and,
/// if wanted, anchor; keep_fixed takes part. Error place is a JSON pointer: "/layers/0/statements/3/amount".
Result<Program> program_from_json(const nlohmann::json& json);
nlohmann::json to_json(const Program& program);

/// The text form, as in ParSEL's figure 2, lossless but for comments:
///   parsel program 1
///   shape "chair" "<sha256>"
///
///   layer "widen the chair": x1 = 0 in [-0.35, 0.35]
///     scale_1d("seat", amount=x1, origin=point("seat", 0, 0, 0), direction=(1, 0, 0)) because seed
///     rotate("door", amount=pi*x1, origin=(0.2, 0, 0.1), axis=axis("door", 1), feature=(0, 0, 1))   # a comment
///     change_count("t1", amount=floor(6.1*sqrt(abs(0.1*x1 - 0.4))), anchor=fit) because group "t1", "a2"
///     keep_fixed("back")
///     relation "a3": held, worst 1.2e-09, certified
/// One statement a line, blanks and the order of named fields are free. Strings are quoted as in JSON.
std::string to_text(const Program& program);
/// Error place is "line L, column C", both 1-based, columns in characters.
Result<Program> program_from_text(std::string_view text);

/// Whether the program makes sense for the shape: parts (by id or node:<n>) and relations are known; every statement
/// has the fields that its operator needs and no other; parameters have unique names and ranges with min <= 0 <= max
/// and min <= value <= max; amounts name only parameters of the program and are shown to be defined, with magnitude up
/// to ProgramLimits::amount (a change_count: instances), for all parameters in their ranges (see amount_range.h); no
/// instance is edited after the count of its group may have changed. Returns the first fault, its place a JSON pointer
/// as in program_from_json().
Status validate(const Program& program, const Shape& shape);

}  // namespace parsel
