// Writes the text form of programs; program_text_read.cpp reads it.
#include <array>
#include <cstdio>

#include "core/amount/number.h"
#include "core/edit/program.h"
#include "core/edit/program_fields.h"

namespace parsel {

namespace {

/// As in JSON: quotes, backslashes and control characters escaped, the rest as it is.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      std::array<char, 8> buffer{};
      std::snprintf(buffer.data(), buffer.size(), "\\u%04x", static_cast<unsigned>(c));
      out += buffer.data();
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string triple(const LocalTriple& t) {
  return std::to_string(t[0]) + ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]);
}

std::string vector(const Vec3& v) {
  return "(" + shortest_decimal(v[0]) + ", " + shortest_decimal(v[1]) + ", " + shortest_decimal(v[2]) + ")";
}

std::string point(const PointReference& reference) {
  const auto* of_part = std::get_if<PartPoint>(&reference);
  if (of_part == nullptr) return vector(std::get<Vec3>(reference));
  return "point(" + in_quotes(of_part->part) + ", " + triple(of_part->at) + ")";
}

std::string direction(const DirectionReference& reference) {
  const auto* of_part = std::get_if<PartAxis>(&reference);
  if (of_part == nullptr) return vector(std::get<Vec3>(reference));
  return "axis(" + in_quotes(of_part->part) + ", " + std::to_string(of_part->axis) + ")";
}

std::string because(const Why& why) {
  std::string text = " because " + std::string(to_string(why.kind));
  for (std::size_t i = 0; i < why.relations.size(); ++i) text += (i > 0 ? ", " : " ") + in_quotes(why.relations[i]);
  return text;
}

std::string line(const Statement& statement) {
  const Op op = statement.op;
  std::string text =
      std::string(to_string(op)) + "(" + in_quotes(is_geometric(op) ? statement.part : statement.relation);
  if (op != Op::keep_fixed) text += ", amount=" + statement.amount.text();
  if (statement.origin) text += ", origin=" + point(*statement.origin);
  if (statement.normal) text += ", normal=" + direction(*statement.normal);
  if (statement.direction) text += ", " + std::string(direction_field(op)) + "=" + direction(*statement.direction);
  if (statement.feature != LocalTriple{0, 0, 0}) text += ", feature=(" + triple(statement.feature) + ")";
  if (!is_geometric(op)) text += ", anchor=" + std::string(to_string(statement.anchor));
  text += ")";
  if (statement.why) text += because(*statement.why);
  return text;
}

}  // namespace

std::string to_text(const Program& program) {
  std::string text = "parsel program 1\n";
  text += "shape " + in_quotes(program.shape_name) + " " + in_quotes(program.shape_sha256) + "\n";
  for (const Layer& layer : program.layers) {
    const Parameter& p = layer.parameter;
    text += "\nlayer " + in_quotes(layer.request) + ": " + p.name + " = " + shortest_decimal(p.value) + " in [" +
            shortest_decimal(p.min) + ", " + shortest_decimal(p.max) + "]\n";
    for (const Statement& statement : layer.statements) text += "  " + line(statement) + "\n";
    for (const RelationReport& report : layer.relations) {
      text += "  relation " + in_quotes(report.id) + ": " + std::string(to_string(report.status)) + ", worst " +
              shortest_decimal(report.worst) + ", " + std::string(to_string(report.proof));
      if (report.samples) text += " at " + std::to_string(*report.samples);
      text += "\n";
    }
  }
  return text;
}

}  // namespace parsel
