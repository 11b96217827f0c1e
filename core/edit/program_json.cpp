// Format `parsel/program` v1 as JSON: the gate that every untrusted program passes.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/edit/operator_table.h"
#include "core/edit/program_fields.h"

namespace parsel {

namespace {

using nlohmann::json;

/// Thrown and caught inside this file only: the reader is one long chain of look-ups.
struct Refusal {
  std::string place, cause, fix;
};

[[noreturn]] void refuse(std::string place, std::string cause, std::string fix = "correct it") {
  throw Refusal{std::move(place), std::move(cause), std::move(fix)};
}

const json& object(const json& value, const std::string& place, std::initializer_list<std::string_view> keys) {
  if (!value.is_object()) refuse(place, "it is not an object");
  for (const auto& [key, unused] : value.items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      refuse(place + "/" + pointer_token(key), "the key " + shown(key) + " is unknown", "remove it");
    }
  }
  return value;
}

const json& member(const json& value, const std::string& place, const char* key) {
  const auto found = value.find(key);
  if (found == value.end()) refuse(place, "the key '" + std::string(key) + "' is missing", "add it");
  return *found;
}

const json& array(const json& value, const std::string& place, std::size_t limit) {
  if (!value.is_array()) refuse(place, "it is not an array");
  if (value.size() > limit) {
    refuse(place, "it has " + std::to_string(value.size()) + " entries, more than " + std::to_string(limit),
           "split the program");
  }
  return value;
}

const std::string& text(const json& value, const std::string& place) {
  if (!value.is_string()) refuse(place, "it is not a string");
  return value.get_ref<const std::string&>();
}

void check(const std::string& place, std::string fault) {
  if (!fault.empty()) refuse(place, std::move(fault));
}

std::string name(const json& value, const std::string& place) {
  check(place, name_fault(text(value, place)));
  return value;
}

double number(const json& value, const std::string& place) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) refuse(place, "it is not a finite number");
  return value.get<double>();
}

/// An integer in [low, high]; 1.0 is one, as JSON does not tell it from 1.
int integer(const json& value, const std::string& place, int low, int high) {
  const double v = number(value, place);
  if (v != std::floor(v) || v < low || v > high) {
    refuse(place, "it is not an integer from " + std::to_string(low) + " to " + std::to_string(high));
  }
  return static_cast<int>(v);
}

template <class Enum>
Enum choice(const json& value, const std::string& place, std::optional<Enum> (*find)(std::string_view),
            const char* all) {
  const auto found = find(text(value, place));
  if (!found) refuse(place, shown(text(value, place)) + " is unknown", "it is one of " + std::string(all));
  return *found;
}

const json& triple(const json& value, const std::string& place) {
  if (!value.is_array() || value.size() != 3) refuse(place, "it is not an array of 3 numbers");
  return value;
}

Vec3 vector(const json& value, const std::string& place) {
  Vec3 result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[static_cast<Eigen::Index>(i)] = number(triple(value, place)[i], place + "/" + std::to_string(i));
  }
  return result;
}

LocalTriple local_triple(const json& value, const std::string& place) {
  LocalTriple result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = integer(triple(value, place)[i], place + "/" + std::to_string(i), -1, 1);
  }
  return result;
}

PointReference point(const json& value, const std::string& place) {
  if (value.is_object()) {
    object(value, place, {"part", "at"});
    return PartPoint{name(member(value, place, "part"), place + "/part"),
                     local_triple(member(value, place, "at"), place + "/at")};
  }
  const Vec3 literal = vector(value, place);
  check(place, point_fault(literal));
  return literal;
}

DirectionReference direction(const json& value, const std::string& place) {
  if (value.is_object()) {
    object(value, place, {"part", "axis"});
    return PartAxis{name(member(value, place, "part"), place + "/part"),
                    integer(member(value, place, "axis"), place + "/axis", 0, 2)};
  }
  const Vec3 literal = vector(value, place);
  check(place, direction_fault(literal));
  return literal;
}

Amount amount(const json& value, const std::string& place) {
  Result<Amount> parsed = parse_amount(text(value, place));
  if (!parsed.ok()) refuse(place, parsed.error().place + ": " + parsed.error().cause, parsed.error().fix);
  return *parsed;
}

Why why(const json& value, const std::string& place) {
  object(value, place, {"kind", "relations"});
  Why result;
  result.kind = choice(member(value, place, "kind"), place + "/kind", why_kind,
                       "seed, symmetry, attachment, neighbour, breaking, group");
  if (!value.contains("relations")) return result;
  const std::string under = place + "/relations";
  const json& relations = array(value["relations"], under, ProgramLimits::why_relations);
  for (std::size_t i = 0; i < relations.size(); ++i) {
    result.relations.push_back(name(relations[i], under + "/" + std::to_string(i)));
  }
  return result;
}

Statement statement(const json& value, const std::string& place) {
  if (!value.is_object()) refuse(place, "it is not an object");
  Statement result;
  result.op = choice(member(value, place, "op"), place + "/op", op_from_string, listed_operators().c_str());
  const std::string op(to_string(result.op));
  for (const char* key : {"part", "relation", "feature", "origin", "direction", "axis", "normal", "anchor", "amount"}) {
    const bool there = value.contains(key);
    const Presence wanted = presence(result.op, key);
    if (there && wanted == Presence::refused) refuse(place + "/" + key, op + " takes no '" + key + "'", "remove it");
    if (!there && wanted == Presence::required) refuse(place, op + " needs '" + std::string(key) + "'", "add it");
  }
  object(value, place,
         {"op", "part", "relation", "feature", "origin", "direction", "axis", "normal", "anchor", "amount", "why"});
  if (value.contains("part")) result.part = name(value["part"], place + "/part");
  if (value.contains("relation")) result.relation = name(value["relation"], place + "/relation");
  if (value.contains("feature")) result.feature = local_triple(value["feature"], place + "/feature");
  if (value.contains("origin")) result.origin = point(value["origin"], place + "/origin");
  for (const char* key : {"direction", "axis"}) {
    if (value.contains(key)) result.direction = direction(value[key], place + "/" + key);
  }
  if (value.contains("normal")) result.normal = direction(value["normal"], place + "/normal");
  if (value.contains("anchor")) {
    result.anchor = choice(value["anchor"], place + "/anchor", anchor_from_string, "start, middle, end, fit");
  }
  if (value.contains("amount")) result.amount = amount(value["amount"], place + "/amount");
  if (value.contains("why")) result.why = why(value["why"], place + "/why");
  return result;
}

RelationReport report(const json& value, const std::string& place) {
  object(value, place, {"id", "status", "worst", "proof", "samples"});
  RelationReport result;
  result.id = name(member(value, place, "id"), place + "/id");
  result.status = choice(member(value, place, "status"), place + "/status", relation_status, "held, broken, disabled");
  result.worst = number(member(value, place, "worst"), place + "/worst");
  if (result.worst < 0) refuse(place + "/worst", "a deviation is not negative");
  result.proof = choice(member(value, place, "proof"), place + "/proof", proof, "certified, sampled");
  if (value.contains("samples")) {
    const double samples = number(value["samples"], place + "/samples");
    if (result.proof != Proof::sampled) refuse(place + "/samples", "only a sampled report has samples");
    if (!(samples >= 1 && samples <= ProgramLimits::samples) || samples != std::floor(samples)) {
      refuse(place + "/samples", "samples are a whole number from 1 to 1000000");
    }
    result.samples = static_cast<int>(samples);
  }
  return result;
}

Parameter parameter(const json& value, const std::string& place) {
  object(value, place, {"name", "min", "max", "value"});
  Parameter result;
  result.name = text(member(value, place, "name"), place + "/name");
  check(place + "/name", parameter_name_fault(result.name));
  result.min = number(member(value, place, "min"), place + "/min");
  result.max = number(member(value, place, "max"), place + "/max");
  result.value = number(member(value, place, "value"), place + "/value");
  return result;
}

Layer layer(const json& value, const std::string& place) {
  object(value, place, {"request", "parameter", "statements", "relations"});
  Layer result;
  result.request = text(member(value, place, "request"), place + "/request");
  check(place + "/request", prose_fault(result.request, ProgramLimits::request_bytes));
  result.parameter = parameter(member(value, place, "parameter"), place + "/parameter");
  const json& statements = member(value, place, "statements");
  for (std::size_t i = 0; i < statements.size(); ++i) {
    result.statements.push_back(statement(statements[i], place + "/statements/" + std::to_string(i)));
  }
  if (!value.contains("relations")) return result;
  const json& reports = array(value["relations"], place + "/relations", ProgramLimits::reports);
  for (std::size_t i = 0; i < reports.size(); ++i) {
    result.relations.push_back(report(reports[i], place + "/relations/" + std::to_string(i)));
  }
  return result;
}

/// Before anything is read, so that a million statements are refused at once.
void check_sizes(const json& layers) {
  std::size_t statements = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const std::string place = "/layers/" + std::to_string(i);
    if (!layers[i].is_object()) refuse(place, "it is not an object");
    statements +=
        array(member(layers[i], place, "statements"), place + "/statements", ProgramLimits::statements).size();
  }
  if (statements > ProgramLimits::statements) {
    refuse(
        "/layers",
        "it has " + std::to_string(statements) + " statements, more than " + std::to_string(ProgramLimits::statements),
        "split the program");
  }
}

Program read(const json& file) {
  if (!file.is_object()) refuse("", "it is not a JSON object", "pass a program in the format parsel/program");
  if (text(member(file, "", "format"), "/format") != "parsel/program") {
    refuse("/format", "the format is " + shown(text(file["format"], "/format")) + ", not parsel/program",
           "pass an editing program");
  }
  const double version = number(member(file, "", "version"), "/version");
  if (version > 1) {
    refuse("/version", "the program was written by a newer version of ParSEL", "update ParSEL to open it");
  }
  if (version != 1) refuse("/version", "there is no such version of parsel/program", "the only version is 1");
  object(file, "", {"format", "version", "shape", "layers"});
  Program program;
  const json& shape = object(member(file, "", "shape"), "/shape", {"name", "sha256"});
  program.shape_name = text(member(shape, "/shape", "name"), "/shape/name");
  check("/shape/name", prose_fault(program.shape_name, ProgramLimits::name_bytes));
  program.shape_sha256 = text(member(shape, "/shape", "sha256"), "/shape/sha256");
  check("/shape/sha256", sha256_fault(program.shape_sha256));
  const json& layers = array(member(file, "", "layers"), "/layers", ProgramLimits::layers);
  check_sizes(layers);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    program.layers.push_back(layer(layers[i], "/layers/" + std::to_string(i)));
  }
  return program;
}

json vector_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

json point_json(const PointReference& reference) {
  if (const auto* of_part = std::get_if<PartPoint>(&reference)) return {{"part", of_part->part}, {"at", of_part->at}};
  return vector_json(std::get<Vec3>(reference));
}

json direction_json(const DirectionReference& reference) {
  if (const auto* of_part = std::get_if<PartAxis>(&reference))
    return {{"part", of_part->part}, {"axis", of_part->axis}};
  return vector_json(std::get<Vec3>(reference));
}

json statement_json(const Statement& statement) {
  json out = {{"op", to_string(statement.op)}};
  if (is_geometric(statement.op)) {
    out["part"] = statement.part;
    if (statement.op != Op::keep_fixed) out["feature"] = statement.feature;
  } else {
    out["relation"] = statement.relation;
    out["anchor"] = to_string(statement.anchor);
  }
  if (statement.origin) out["origin"] = point_json(*statement.origin);
  if (statement.direction) out[std::string(direction_field(statement.op))] = direction_json(*statement.direction);
  if (statement.normal) out["normal"] = direction_json(*statement.normal);
  if (statement.op != Op::keep_fixed) out["amount"] = statement.amount.text();
  if (statement.why) out["why"] = {{"kind", to_string(statement.why->kind)}, {"relations", statement.why->relations}};
  return out;
}

json layer_json(const Layer& layer) {
  json statements = json::array();
  for (const Statement& statement : layer.statements) statements.push_back(statement_json(statement));
  json reports = json::array();
  for (const RelationReport& report : layer.relations) {
    reports.push_back({{"id", report.id},
                       {"status", to_string(report.status)},
                       {"worst", report.worst},
                       {"proof", to_string(report.proof)}});
    if (report.samples) reports.back()["samples"] = *report.samples;
  }
  const Parameter& p = layer.parameter;
  return {{"request", layer.request},
          {"parameter", {{"name", p.name}, {"min", p.min}, {"max", p.max}, {"value", p.value}}},
          {"statements", statements},
          {"relations", reports}};
}

}  // namespace

Result<Program> program_from_json(const json& file) {
  try {
    return read(file);
  } catch (const Refusal& refusal) {
    return Error{"edit/program", refusal.place, refusal.cause, refusal.fix};
  }
}

json to_json(const Program& program) {
  json layers = json::array();
  for (const Layer& layer : program.layers) layers.push_back(layer_json(layer));
  return {{"format", "parsel/program"},
          {"version", 1},
          {"shape", {{"name", program.shape_name}, {"sha256", program.shape_sha256}}},
          {"layers", layers}};
}

}  // namespace parsel
