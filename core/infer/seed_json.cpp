#include "core/infer/seed_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/edit/program_fields.h"
#include "core/infer/names.h"

namespace parsel {

namespace {

using nlohmann::json;

/// Thrown and caught inside this file only: the reader is one long chain of look-ups.
struct Refusal {
  std::string place, cause, fix;
};

[[noreturn]] void refuse(std::string place, std::string cause, std::string fix) {
  throw Refusal{std::move(place), std::move(cause), std::move(fix)};
}

constexpr std::size_t longest_word = 64;
constexpr std::size_t longest_amount = 200;

/// Lower-case words; a sign in front belongs to the first: "Front-Left" → front, left; "-Y" → -y.
std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> out(1);
  for (const char c : text.substr(0, longest_word)) {
    const bool capital = c >= 'A' && c <= 'Z';
    const bool sign = (c == '-' || c == '+') && out.size() == 1 && out.back().empty();
    if (capital || sign || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
      out.back() += capital ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!out.back().empty()) {
      out.emplace_back();
    }
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

struct Side {
  std::string_view word;
  std::size_t axis;
  int sign;  ///< 0: says nothing about a side
};
constexpr std::array sides = {
    Side{"left", 0, 1},      Side{"right", 0, -1},     Side{"up", 1, 1},       Side{"upward", 1, 1},
    Side{"upwards", 1, 1},   Side{"top", 1, 1},        Side{"upper", 1, 1},    Side{"down", 1, -1},
    Side{"downward", 1, -1}, Side{"downwards", 1, -1}, Side{"bottom", 1, -1},  Side{"lower", 1, -1},
    Side{"front", 2, 1},     Side{"forward", 2, 1},    Side{"forwards", 2, 1}, Side{"back", 2, -1},
    Side{"backward", 2, -1}, Side{"backwards", 2, -1}, Side{"whole", 0, 0},    Side{"part", 0, 0},
    Side{"centre", 0, 0},    Side{"center", 0, 0},     Side{"middle", 0, 0},   Side{"face", 0, 0},
    Side{"edge", 0, 0},      Side{"corner", 0, 0},     Side{"the", 0, 0},      Side{"of", 0, 0},
    Side{"and", 0, 0},       Side{"to", 0, 0},         Side{"its", 0, 0},      Side{"all", 0, 0}};
constexpr std::array directions = {
    Side{"x", 0, 1},   Side{"+x", 0, 1},    Side{"-x", 0, -1},    Side{"width", 0, 1},    Side{"y", 1, 1},
    Side{"+y", 1, 1},  Side{"-y", 1, -1},   Side{"height", 1, 1}, Side{"z", 2, 1},        Side{"+z", 2, 1},
    Side{"-z", 2, -1}, Side{"depth", 2, 1}, Side{"axis", 0, 0},   Side{"vertical", 1, 1}, Side{"sideways", 0, 1}};

template <class Sides>
const Side* find(const Sides& list, const std::string& word) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Side& side) { return side.word == word; });
  return found == list.end() ? nullptr : &*found;
}

const json& member(const json& object, const char* key) {
  static const json none;
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

/// A feature or local point: [-1, 0, 1], "whole", "centre", "top", "front left".
json triple(const json& value, const std::string& place) {
  const std::string fix = "write a local point such as [0, -1, 0], numbers -1, 0 or 1";
  std::array<int, 3> out = {0, 0, 0};
  if (value.is_array() && value.size() == 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      const bool fits = value[i].is_number() && (value[i] == -1 || value[i] == 0 || value[i] == 1);
      if (!fits) refuse(place, "its numbers are not -1, 0 or 1", fix);
      out[i] = value[i].get<int>();
    }
    return out;
  }
  const std::vector<std::string> given =
      value.is_string() ? words(value.get_ref<const std::string&>()) : std::vector<std::string>();
  if (given.empty()) refuse(place, "it is no local point", fix);
  for (const std::string& word : given) {
    const Side* side = find(sides, word);
    if (side == nullptr) refuse(place, shown(word) + " names no side", fix);
    if (side->sign == 0) continue;
    if (out[side->axis] == -side->sign) refuse(place, "it names two opposite sides", fix);
    out[side->axis] = side->sign;
  }
  return out;
}

std::string part_id(const Shape& shape, const json& value, const std::string& place) {
  if (!value.is_string()) refuse(place, "there is no part's name", "name a part by the id that the prompt lists");
  const Result<PartIndex> part = part_named(shape, value.get_ref<const std::string&>());
  if (!part.ok()) refuse(place, part.error().cause, part.error().fix);
  return shape.parts[*part].id;
}

json origin(const Shape& shape, const json& value, const std::string& own, const json& feature) {
  const std::string place = "/origin";
  if (value.is_null()) return {{"part", own}, {"at", feature}};
  if (!value.is_object()) return {{"part", own}, {"at", triple(value, place)}};
  const json &part = member(value, "part"), &at = member(value, "at");
  return {{"part", part.is_null() ? own : part_id(shape, part, place + "/part")},
          {"at", at.is_null() ? json{0, 0, 0} : triple(at, place + "/at")}};
}

/// The axis and sign that a word or two say: "x", "-y", "up", "left and right".
Side named_direction(const std::string& text, const std::string& place) {
  Side out{"", 0, 0};
  for (const std::string& word : words(text)) {
    const Side* side = find(directions, word);
    if (side == nullptr) side = find(sides, word);
    const bool fits = side != nullptr && (side->sign == 0 || out.sign == 0 || side->axis == out.axis);
    if (!fits) refuse(place, shown(text) + " is no direction", "write one as [x, y, z], such as [0, 1, 0]");
    if (side->sign != 0 && out.sign == 0) out = *side;
  }
  if (out.sign == 0) refuse(place, shown(text) + " is no direction", "write one as [x, y, z], such as [0, 1, 0]");
  return out;
}

json direction(const Shape& shape, const json& value, const std::string& own, const std::string& place) {
  if (value.is_string()) {
    const Side side = named_direction(value.get_ref<const std::string&>(), place);
    std::array<int, 3> vector = {0, 0, 0};
    vector[side.axis] = side.sign;
    return vector;
  }
  if (value.is_number()) return {{"part", own}, {"axis", value}};
  if (!value.is_object()) return value;  // [x, y, z], which the strict reader checks
  const json &part = member(value, "part"), &axis = member(value, "axis");
  json out = {{"part", part.is_null() ? own : part_id(shape, part, place + "/part")}, {"axis", axis}};
  if (axis.is_string()) {
    const Side side = named_direction(axis.get_ref<const std::string&>(), place + "/axis");
    if (side.sign < 0) refuse(place + "/axis", "a part's axis has no sign", "give a negative amount instead");
    out["axis"] = side.axis;
  }
  return out;
}

/// The field that holds the operator's one direction, under whichever of the three names it was given.
const json& given_direction(const json& loose, const std::string& field) {
  for (const char* name : {field.c_str(), "direction", "axis", "normal"}) {
    if (!member(loose, name).is_null()) return member(loose, name);
  }
  refuse("/" + field, "it is missing", "give it as [x, y, z], such as [0, 1, 0]");
}

/// An expression in x. The slider says how much, so a bare number gives no more than its sign.
std::string amount(const json& loose, Op op) {
  const std::string unit = op == Op::change_count ? "8*x" : "x";
  const json& sign = member(loose, "sign");
  const bool minus = sign == -1 || sign == "-" || sign == "-1" || sign == "negative";
  const json& value = member(loose, "amount");
  if (value.is_null()) return (minus ? "-" : "") + unit;
  if (value.is_number()) {
    const double number = value.get<double>();
    if (!std::isfinite(number) || number == 0) refuse("/amount", "it changes nothing", "write an amount such as x");
    return (number < 0 ? "-" : "") + unit;
  }
  if (!value.is_string()) refuse("/amount", "it is no expression", "write an amount such as x or -x");
  std::string text = value.get<std::string>();
  if (text.size() > longest_amount) refuse("/amount", "it is too long", "write an amount such as x or -x");
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  const Result<Amount> parsed = parse_amount(text);
  if (!parsed.ok()) refuse("/amount", parsed.error().place + ": " + parsed.error().cause, parsed.error().fix);
  if (parsed->parameters() != std::vector<std::string>{"x"}) {
    refuse("/amount", "it is no expression in x alone", "write an amount such as x or -x");
  }
  const CompiledAmount at = parsed->compile({"x"});
  const double rest = 0;
  if (!(std::abs(at(&rest)) < 1e-9)) {
    refuse("/amount", "it is not 0 where x is 0, the shape at rest", "write an amount such as x or -x");
  }
  return text;
}

json group_statement(const Shape& shape, const json& loose, Op op) {
  const json& relation = member(loose, "relation").is_null() ? member(loose, "part") : member(loose, "relation");
  if (!relation.is_string()) refuse("/relation", "there is no group's name", "name it by its relation, such as t1");
  const Result<RelationIndex> group = group_named(shape, relation.get_ref<const std::string&>());
  if (!group.ok()) refuse("/relation", group.error().cause, group.error().fix);
  json out = {{"op", to_string(op)}, {"relation", shape.relations[*group].id}, {"amount", amount(loose, op)}};
  const json& anchor = member(loose, "anchor");
  if (anchor.is_null()) {
    out["anchor"] = op == Op::change_count ? "fit" : "middle";
  } else {
    const std::vector<std::string> said =
        anchor.is_string() ? words(anchor.get_ref<const std::string&>()) : std::vector<std::string>();
    const std::string word = said.size() == 1 ? said.front() : "";
    out["anchor"] = word == "centre" || word == "center" ? "middle" : word;
  }
  return out;
}

json statement(const Shape& shape, const json& loose) {
  if (!loose.is_object()) refuse("", "it is no object", "write {\"op\": …, \"part\": …}");
  const json& name = member(loose, "op");
  if (!name.is_string()) refuse("/op", "there is no operator", "name one that the prompt lists");
  std::string joined;
  for (const std::string& word : words(name.get_ref<const std::string&>()))
    joined += (joined.empty() ? "" : "_") + word;
  const auto op = op_from_string(joined);
  if (!op)
    refuse("/op", shown(name.get_ref<const std::string&>()) + " is no operator", "use one that the prompt lists");
  if (!is_geometric(*op)) return group_statement(shape, loose, *op);

  const std::string own = part_id(shape, member(loose, "part"), "/part");
  json out = {{"op", to_string(*op)}, {"part", own}};
  if (*op == Op::keep_fixed) return out;
  const json& feature = member(loose, "feature");
  out["feature"] = feature.is_null() ? json{0, 0, 0} : triple(feature, "/feature");
  out["amount"] = amount(loose, *op);
  if (needs_origin(*op)) out["origin"] = origin(shape, member(loose, "origin"), own, out["feature"]);
  for (const std::string& field : {std::string(direction_field(*op)), std::string("normal")}) {
    if (presence(*op, field) == Presence::refused) continue;
    const bool has_both = needs_direction(*op) && needs_normal(*op);
    const json& value = has_both ? member(loose, field.c_str()) : given_direction(loose, field);
    out[field] = direction(shape, value, own, "/" + field);
  }
  return out;
}

}  // namespace

Result<json> strict_statement(const Shape& shape, const json& loose) {
  try {
    return statement(shape, loose);
  } catch (const Refusal& refusal) {
    return Error{"infer/reply", refusal.place, refusal.cause, refusal.fix};
  }
}

}  // namespace parsel
