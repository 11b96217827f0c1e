#include "core/edit/program_fields.h"

#include <array>
#include <cmath>

#include "core/base/text.h"

namespace parsel {

namespace {

constexpr std::array<std::string_view, 6> why_names = {"seed",      "symmetry", "attachment",
                                                       "neighbour", "breaking", "group"};
constexpr std::array<std::string_view, 3> status_names = {"held", "broken", "disabled"};
constexpr std::array<std::string_view, 2> proof_names = {"certified", "sampled"};

template <class Enum, std::size_t n>
std::optional<Enum> find(const std::array<std::string_view, n>& names, std::string_view text) {
  for (std::size_t i = 0; i < n; ++i) {
    if (names[i] == text) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

}  // namespace

std::string_view to_string(WhyKind kind) {
  return why_names[static_cast<std::size_t>(kind)];
}
std::optional<WhyKind> why_kind(std::string_view text) {
  return find<WhyKind>(why_names, text);
}
std::string_view to_string(RelationStatus status) {
  return status_names[static_cast<std::size_t>(status)];
}
std::optional<RelationStatus> relation_status(std::string_view text) {
  return find<RelationStatus>(status_names, text);
}
std::string_view to_string(Proof proof) {
  return proof_names[static_cast<std::size_t>(proof)];
}
std::optional<Proof> proof(std::string_view text) {
  return find<Proof>(proof_names, text);
}

std::string shown(std::string_view name) {
  constexpr std::size_t longest = 40;
  return "'" + printable(name, longest) + (name.size() > longest ? "…'" : "'");
}

std::string pointer_token(std::string_view key) {
  std::string token;
  for (const char c : printable(key)) token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return token;
}

std::string prose_fault(std::string_view text, std::size_t limit) {
  if (text.size() > limit) return "it is longer than " + std::to_string(limit) + " bytes";
  if (!is_utf8(text)) return "it is not UTF-8";
  return {};
}

std::string name_fault(std::string_view text) {
  if (text.empty()) return "it is empty";
  return prose_fault(text, ProgramLimits::name_bytes);
}

std::string sha256_fault(std::string_view text) {
  if (text.size() > 64 || text.find_first_not_of("0123456789abcdef") != std::string_view::npos) {
    return "it is no SHA-256 in lower-case hexadecimal digits";
  }
  return {};
}

std::string parameter_name_fault(std::string_view text) {
  if (text.size() > ProgramLimits::parameter_bytes) return "a parameter's name has at most 64 characters";
  if (!is_parameter_name(text)) {
    return "a parameter's name is lower-case letters, digits and _, starts with a letter and is no function or pi";
  }
  return {};
}

std::string point_fault(const Vec3& point) {
  if (point.allFinite() && point.cwiseAbs().maxCoeff() <= ProgramLimits::coordinate) return {};
  return "coordinates are finite and at most a million";
}

std::string direction_fault(const Vec3& direction) {
  if (!direction.allFinite() || direction.cwiseAbs().maxCoeff() > ProgramLimits::coordinate)
    return point_fault(direction);
  if (direction.norm() <= ProgramLimits::shortest_direction) return "a direction has a length";
  return {};
}

std::string_view direction_field(Op op) {
  return op == Op::rotate ? "axis" : "direction";
}

Presence presence(Op op, std::string_view field) {
  if (field == "op") return Presence::required;
  if (field == "why") return Presence::optional;
  if (field == "amount") return op == Op::keep_fixed ? Presence::refused : Presence::required;
  const bool geometric = is_geometric(op);
  if (field == "part") return geometric ? Presence::required : Presence::refused;
  if (field == "relation") return geometric ? Presence::refused : Presence::required;
  if (field == "anchor") return geometric ? Presence::refused : Presence::optional;
  if (field == "feature") return geometric && op != Op::keep_fixed ? Presence::optional : Presence::refused;
  const bool needed = (field == "origin" && needs_origin(op)) || (field == "normal" && needs_normal(op)) ||
                      (field == direction_field(op) && needs_direction(op));
  return needed ? Presence::required : Presence::refused;
}

}  // namespace parsel
