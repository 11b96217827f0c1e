#include "core/propagate/edit_request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/tolerance.h"
#include "core/edit/program_fields.h"
#include "core/propagate/transfer.h"

namespace parsel {

using nlohmann::json;

namespace {

constexpr const char* stage = "propagate/edit_request";
constexpr std::size_t largest_count = 10000;
/// An amount is 0 at x = 0 within this. Less would refuse what rounding leaves of sin(x + pi); with 1e-6 and more the
/// checker sees the part move.
constexpr double rest = 1e-9;

Error refused(std::string place, std::string cause, std::string fix) {
  return {stage, std::move(place), std::move(cause), std::move(fix)};
}

std::string pointer(const std::string& parent, const std::string& key) {
  return parent + "/" + pointer_token(key);
}

/// The statements are those of a program's layer: its reader checks them. But a count that says no anchor keeps the room
/// of its row: fewer bars are no narrower chair, unless that is asked for.
Result<std::vector<Statement>> read_seed(json seed) {
  for (json& statement : seed) {
    if (statement.is_object() && statement.value("op", json()) == "change_count" && !statement.contains("anchor")) {
      statement["anchor"] = to_string(Anchor::fit);
    }
  }
  const json program = {{"format", "parsel/program"},
                        {"version", 1},
                        {"shape", {{"name", ""}, {"sha256", ""}}},
                        {"layers",
                         {{{"request", ""},
                           {"parameter", {{"name", edit_parameter}, {"min", -tau}, {"max", tau}, {"value", 0}}},
                           {"statements", seed},
                           {"relations", json::array()}}}}};
  auto read = program_from_json(program);
  if (read.ok()) return std::move(read.value().layers[0].statements);
  Error error = read.error();
  const std::string prefix = "/layers/0/statements";
  if (error.place.rfind(prefix, 0) == 0) error.place = "/seed" + error.place.substr(prefix.size());
  error.stage = stage;
  return error;
}

Result<std::vector<std::string>> read_strings(const json& list, const std::string& place) {
  if (!list.is_array()) return refused(place, "is not a list", "write a list of relation ids");
  if (list.size() > largest_count) return refused(place, "has too many entries", "list at most 10000");
  std::vector<std::string> strings;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_string()) {
      return refused(pointer(place, std::to_string(i)), "is not a text", "write a relation's id or kind:<kind>");
    }
    strings.push_back(list[i].get<std::string>());
  }
  return strings;
}

Result<std::map<std::string, Hint>> read_hints(const json& hints) {
  if (!hints.is_object()) return refused("/hints", "is not an object", "write {\"part id\": \"translate\"}");
  if (hints.size() > largest_count) return refused("/hints", "has too many entries", "give at most 10000");
  std::map<std::string, Hint> result;
  for (const auto& [part, value] : hints.items()) {
    const auto hint = value.is_string() ? hint_from_string(value.get_ref<const std::string&>()) : std::nullopt;
    if (!hint) {
      return refused(pointer("/hints", part), "is no kind of edit",
                     "use translate, rotate, scale, shear, change_count, change_delta or keep_fixed");
    }
    result.emplace(part, *hint);
  }
  return result;
}

}  // namespace

Result<EditRequest> edit_request_from_json(const json& input) {
  if (!input.is_object()) return refused("", "the edit is not a JSON object", "write {\"seed\": [...]}");
  for (const auto& [key, value] : input.items()) {
    if (key == "format" && value != "parsel/edit") return refused("/format", "is not parsel/edit", "check the file");
    if (key == "version" && value != 1) return refused("/version", "is not 1", "use a version that this program knows");
    if (key != "seed" && key != "disabled" && key != "hints" && key != "format" && key != "version") {
      return refused(pointer("", key), "is no field of an edit", "use seed, disabled and hints only");
    }
  }
  if (!input.contains("seed") || !input["seed"].is_array() || input["seed"].empty()) {
    return refused("/seed", "there is no seed edit", "give a list of at least one statement");
  }
  if (input["seed"].size() > largest_count) return refused("/seed", "has too many statements", "give at most 10000");
  EditRequest request;
  auto seed = read_seed(input["seed"]);
  if (!seed.ok()) return seed.error();
  request.seed = std::move(seed.value());
  if (input.contains("disabled")) {
    auto disabled = read_strings(input["disabled"], "/disabled");
    if (!disabled.ok()) return disabled.error();
    request.disabled = std::move(disabled.value());
  }
  if (input.contains("hints")) {
    auto hints = read_hints(input["hints"]);
    if (!hints.ok()) return hints.error();
    request.hints = std::move(hints.value());
  }
  return request;
}

json to_json(const EditRequest& request) {
  Program program;
  program.layers.emplace_back();
  program.layers[0].parameter = {edit_parameter, -tau, tau, 0};
  program.layers[0].statements = request.seed;
  json hints = json::object();
  for (const auto& [part, hint] : request.hints) hints[part] = to_string(hint);
  return {{"format", "parsel/edit"},
          {"version", 1},
          {"seed", to_json(program)["layers"][0]["statements"]},
          {"disabled", request.disabled},
          {"hints", hints}};
}

namespace {

/// Replaces node:<index> by ids in a statement's references; the place of the first unknown part otherwise.
Status resolve_names(Statement& statement, const Shape& shape, const std::string& place) {
  const auto rename = [&](std::string& id, const char* field) -> Status {
    const auto part = shape.find_part(id);
    if (!part) {
      return refused(pointer(place, field), "the shape has no part " + shown(id),
                     "name a part that `parsel inspect` lists");
    }
    id = shape.parts[*part].id;
    return success();
  };
  if (is_geometric(statement.op)) {
    if (Status s = rename(statement.part, "part"); !s.ok()) return s;
  } else {
    const auto relation = shape.find_relation(statement.relation);
    if (!relation) {
      return refused(pointer(place, "relation"), "the shape has no relation " + shown(statement.relation),
                     "name a relation that `parsel inspect` lists");
    }
    if (!shape.relations[*relation].is_group()) {
      return refused(pointer(place, "relation"), shown(statement.relation) + " is no translation or rotation",
                     "change count and spacing of groups only");
    }
  }
  if (statement.origin) {
    if (auto* point = std::get_if<PartPoint>(&*statement.origin)) {
      if (Status s = rename(point->part, "origin"); !s.ok()) return s;
    }
  }
  if (statement.direction) {
    if (auto* axis = std::get_if<PartAxis>(&*statement.direction)) {
      if (Status s = rename(axis->part, "direction"); !s.ok()) return s;
    }
  }
  if (statement.normal) {
    if (auto* axis = std::get_if<PartAxis>(&*statement.normal)) {
      if (Status s = rename(axis->part, "normal"); !s.ok()) return s;
    }
  }
  return success();
}

Status check_fields(const Statement& statement, const std::string& place) {
  const std::string op(to_string(statement.op));
  if (needs_origin(statement.op) && !statement.origin) return refused(place, op + " has no origin", "give an origin");
  if (needs_direction(statement.op) && !statement.direction) {
    return refused(place, op + " has no direction", "give a direction or axis");
  }
  if (needs_normal(statement.op) && !statement.normal) return refused(place, op + " has no normal", "give a normal");
  for (const auto& direction : {statement.direction, statement.normal}) {
    const Vec3* literal = direction ? std::get_if<Vec3>(&*direction) : nullptr;
    if (literal && !(literal->norm() > 1e-9))
      return refused(place, "a direction has no length", "give a non-zero vector");
  }
  if (statement.op == Op::keep_fixed) return success();
  const std::vector<std::string> names = statement.amount.parameters();
  if (names.empty()) {
    return refused(pointer(place, "amount"), "does not contain the parameter x", "write an amount such as x or 2*x");
  }
  if (names != std::vector<std::string>{edit_parameter}) {
    return refused(pointer(place, "amount"), "contains another parameter than x", "write it in x alone");
  }
  // Every slider starts at 0, where the shape is as it was.
  const double at_zero = statement.amount.compile({edit_parameter})(std::array{0.0}.data());
  if (!std::isfinite(at_zero)) {
    return refused(pointer(place, "amount"), "is undefined at x = 0", "write an amount that is 0 there, such as x");
  }
  const bool moves = statement.op == Op::change_count ? std::floor(at_zero + rest) != 0 : std::abs(at_zero) > rest;
  if (moves) {
    return refused(pointer(place, "amount"), "is not 0 at x = 0, so that the part would move at once",
                   "write an amount that is 0 there, such as x");
  }
  return success();
}

Status resolve_disabled(const EditRequest& request, const Shape& shape, ResolvedRequest& resolved) {
  for (std::size_t i = 0; i < request.disabled.size(); ++i) {
    const std::string& id = request.disabled[i];
    const std::string place = "/disabled/" + std::to_string(i);
    if (id.rfind("kind:", 0) == 0) {
      const auto kind = relation_kind(std::string_view(id).substr(5));
      if (!kind)
        return refused(place, "is no kind of relation", "use kind:reflection, kind:translation, kind:rotation, …");
      for (const RelationIndex r : shape.relations.indices()) {
        if (shape.relations[r].kind == *kind) resolved.disabled.insert(r);
      }
      continue;
    }
    const auto relation = shape.find_relation(id);
    if (!relation) {
      return refused(place, "the shape has no relation " + shown(id),
                     "name a relation that `parsel inspect` lists, or kind:<kind>");
    }
    resolved.disabled.insert(*relation);
  }
  return success();
}

Status resolve_hints(const EditRequest& request, const Shape& shape, const std::set<RelationIndex>& dissolved,
                     ResolvedRequest& resolved) {
  for (const auto& [id, hint] : request.hints) {
    const auto part = shape.find_part(id);
    if (!part) {
      return refused(pointer("/hints", id), "the shape has no such part", "name a part that `parsel inspect` lists");
    }
    // A group is edited as one: what is asked of an instance is asked of the group.
    const Part& named = shape.parts[*part];
    PartIndex edited = *part;
    if (named.group && !named.is_virtual() && dissolved.count(*named.group) == 0) {
      edited = parent_of(shape.relations[*named.group]);
    }
    const auto [known, is_new] = resolved.hints.emplace(edited, hint);
    if (!is_new && known->second != hint) {
      return refused(pointer("/hints", id), "the part, or its group, has another hint under another name",
                     "keep one of the two");
    }
  }
  return success();
}

/// Groups whose instances hang on single instances of a group that is taken apart are taken apart as well: the knobs of
/// drawers, of which one is pulled. Not those that the request edits as one.
void dissolve_followers(const Shape& shape, const std::set<RelationIndex>& as_group,
                        std::set<RelationIndex>& dissolved) {
  const auto group_of_instance = [&](PartIndex part) {
    return shape.parts[part].is_virtual() ? std::nullopt : shape.parts[part].group;
  };
  for (bool grows = true; grows;) {
    grows = false;
    for (const Relation& relation : shape.relations) {
      if (!relation.is_attachment()) continue;
      const auto a = group_of_instance(relation.parts[0]), b = group_of_instance(relation.parts[1]);
      if (!a || !b || *a == *b) continue;
      for (const auto& [from, to] : {std::pair(*a, *b), std::pair(*b, *a)}) {
        if (dissolved.count(from) == 0 || dissolved.count(to) > 0 || as_group.count(to) > 0) continue;
        dissolved.insert(to);
        grows = true;
      }
    }
  }
}

/// Whether the instances of two groups of one kind and number are joined one to one, in their order, and to no others.
bool hang_together(const Shape& shape, const Relation& a, const Relation& b) {
  if (a.kind != b.kind || a.parts.size() != b.parts.size()) return false;
  const auto place_in = [](const Relation& group, PartIndex part) {
    return std::find(group.parts.begin(), group.parts.end(), part) - group.parts.begin();
  };
  const auto count = std::ssize(a.parts);
  std::vector<bool> joined(a.parts.size(), false);
  for (const Relation& joint : shape.relations) {
    if (!joint.is_attachment()) continue;
    for (const auto& [first, second] :
         {std::pair(joint.parts[0], joint.parts[1]), std::pair(joint.parts[1], joint.parts[0])}) {
      const auto i = place_in(a, first), k = place_in(b, second);
      if (i == count || k == count) continue;
      if (i != k) return false;
      joined[static_cast<std::size_t>(i)] = true;
    }
  }
  return std::all_of(joined.begin(), joined.end(), [](bool one) { return one; });
}

/// Rows that hang on a row whose number or spacing changes get the same change, unless the request speaks of them.
void add_following_rows(const Shape& shape, const std::set<RelationIndex>& dissolved, ResolvedRequest& resolved) {
  const auto is_told = [&](RelationIndex group) {
    const PartIndex parent = parent_of(shape.relations[group]);
    const auto& seeds = resolved.seed_parts;
    return dissolved.count(group) > 0 || resolved.disabled.count(group) > 0 || resolved.hints.count(parent) > 0 ||
           std::find(seeds.begin(), seeds.end(), parent) != seeds.end();
  };
  for (std::size_t i = 0; i < resolved.seed.size(); ++i) {  // those that are added, too
    if (resolved.seed[i].op != Op::change_count && resolved.seed[i].op != Op::change_delta) continue;
    const Relation& changed = shape.relations[*shape.parts[resolved.seed_parts[i]].group];
    for (const RelationIndex other : shape.relations.indices()) {
      const Relation& group = shape.relations[other];
      if (!group.is_group() || is_told(other) || !hang_together(shape, changed, group)) continue;
      // Whatever else is asked of the row that changes is asked of this one as well.
      const PartIndex parent = parent_of(group);
      for (std::size_t k = 0; k < resolved.seed.size(); ++k) {
        const Op op = resolved.seed[k].op;
        if (resolved.seed_parts[k] != resolved.seed_parts[i] || (op != Op::change_count && op != Op::change_delta))
          continue;
        Statement statement = resolved.seed[k];
        statement.relation = group.id;
        resolved.seed.push_back(std::move(statement));
        resolved.seed_parts.push_back(parent);
      }
    }
  }
}

/// The joint of a group that may come apart stands for those of its instances with the same part: they may as well. So
/// may the instances of a group that may leave the floor.
void disable_relations_of_instances(const Shape& shape, ResolvedRequest& resolved) {
  using Ends = std::set<PartIndex>;
  const auto taken_by = [&](PartIndex part) {
    const auto group = shape.parts[part].group;
    const bool stands =
        group && std::find(resolved.dissolved.begin(), resolved.dissolved.end(), *group) == resolved.dissolved.end();
    return stands ? parent_of(shape.relations[*group]) : part;
  };
  std::set<Ends> apart;
  std::set<PartIndex> off_floor;
  for (const RelationIndex r : resolved.disabled) {
    const Relation& relation = shape.relations[r];
    if (relation.is_attachment()) apart.insert({relation.parts[0], relation.parts[1]});
    if (relation.kind == RelationKind::ground) off_floor.insert(relation.parts[0]);
  }
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    if (relation.is_attachment() && apart.count({taken_by(relation.parts[0]), taken_by(relation.parts[1])}) > 0)
      resolved.disabled.insert(r);
    if (relation.kind == RelationKind::ground && off_floor.count(taken_by(relation.parts[0])) > 0)
      resolved.disabled.insert(r);
  }
}

}  // namespace

Result<ResolvedRequest> resolve(const EditRequest& request, const Shape& shape) {
  ResolvedRequest resolved;
  if (Status s = resolve_disabled(request, shape, resolved); !s.ok()) return s.error();
  resolved.disabled_by_name = resolved.disabled;
  std::set<RelationIndex> dissolved;
  for (const RelationIndex r : resolved.disabled) {
    if (shape.relations[r].is_group()) dissolved.insert(r);
  }
  std::set<RelationIndex> as_group;
  for (std::size_t i = 0; i < request.seed.size(); ++i) {
    Statement statement = request.seed[i];
    const std::string place = "/seed/" + std::to_string(i);
    if (Status s = resolve_names(statement, shape, place); !s.ok()) return s.error();
    if (Status s = check_fields(statement, place); !s.ok()) return s.error();
    const auto part = part_of(shape, statement);
    PARSEL_ASSERT(part.has_value(), "names were resolved");
    if (const auto group = shape.parts[*part].group) {
      (shape.parts[*part].is_virtual() ? as_group : dissolved).insert(*group);
    }
    resolved.seed.push_back(std::move(statement));
    resolved.seed_parts.push_back(*part);
  }
  for (const RelationIndex group : as_group) {
    if (dissolved.count(group) == 0) continue;
    return refused("/seed",
                   "group '" + shape.relations[group].id + "' is edited as one, but its instances are on their own",
                   "edit the group or its instances, not both, and do not disable a group that you edit");
  }
  dissolve_followers(shape, as_group, dissolved);
  if (Status s = resolve_hints(request, shape, dissolved, resolved); !s.ok()) return s.error();
  resolved.asked = resolved.seed.size();
  add_following_rows(shape, dissolved, resolved);
  resolved.dissolved.assign(dissolved.begin(), dissolved.end());
  resolved.disabled.insert(dissolved.begin(), dissolved.end());
  disable_relations_of_instances(shape, resolved);
  return resolved;
}

}  // namespace parsel
