// Format `parsel/shape` v1.
//
// Frame: "centre", "scale" and, where the model does not stand along the file's axes, "axes", three rows.
// Relations: {"id","kind","parts":[ids], …} with, for reflection, "origin", "normal", "corner_map", "stacked" where
// true; translation, "parent", "start", "end", "count", "delta", "axis", "direction", "touching" where true; rotation,
// "parent", "centre", "axis", "parent_axis", "radius", "count", "angle", "arc"; attachments, "points", "local_a",
// "local_b"; ground, "points", "local". Attachments may have "patch": {"centre", "normal", "half_sides", "local_a",
// "local_b"} and "contact_points": [{"point", "normal"}]. A part may have "group": the id of its relation. "count", "delta", "angle" and "arc" follow from the rest
// and are not read back.
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/base/tolerance.h"
#include "core/shape/shape.h"

namespace parsel {
namespace {

using nlohmann::json;

json vector_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}
json points_json(const std::vector<Vec3>& points) {
  json out = json::array();
  for (const Vec3& p : points) out.push_back(vector_json(p));
  return out;
}

/// What went wrong while reading, thrown and caught inside this file only: the reader is one long chain of look-ups.
struct Malformed {
  std::string place, cause;
};

const json& member(const json& object, const char* name, const std::string& place) {
  if (!object.is_object()) throw Malformed{place, "it is not an object"};
  const auto found = object.find(name);
  if (found == object.end()) throw Malformed{place, std::string("'") + name + "' is missing"};
  return *found;
}
const json& array(const json& object, const char* name, const std::string& place) {
  const json& value = member(object, name, place);
  if (!value.is_array()) throw Malformed{place, std::string("'") + name + "' is not an array"};
  return value;
}
std::string text(const json& object, const char* name, const std::string& place) {
  const json& value = member(object, name, place);
  if (!value.is_string()) throw Malformed{place, std::string("'") + name + "' is not a string"};
  return value.get<std::string>();
}
/// A name as abstract_shape() gives it: prompts and messages show it as it is.
std::string name(const json& object, const char* member, const std::string& place) {
  constexpr std::size_t longest = 200;
  std::string value = text(object, member, place);
  if (printable(value, longest) != value) {
    throw Malformed{place, std::string("'") + member + "' is not printable, or longer than 200 bytes"};
  }
  return value;
}
double number(const json& value, const std::string& place) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) throw Malformed{place, "a number was expected"};
  return value.get<double>();
}
int integer(const json& object, const char* name, const std::string& place) {
  const json& value = member(object, name, place);
  const bool good =
      value.is_number_integer() && value.get<std::int64_t>() >= -1 && value.get<std::int64_t>() < 0x7fffffff;
  if (!good) throw Malformed{place, std::string("'") + name + "' is not an integer in range"};
  return value.get<int>();
}
/// A member that says something special, and is left out where there is nothing to say.
bool flag(const json& object, const char* name, const std::string& place) {
  const auto found = object.find(name);
  if (found == object.end()) return false;
  if (!found->is_boolean()) throw Malformed{place, std::string("'") + name + "' is neither true nor false"};
  return found->get<bool>();
}
Vec3 vector(const json& value, const std::string& place) {
  if (!value.is_array() || value.size() != 3) throw Malformed{place, "a vector of 3 numbers was expected"};
  return {number(value[0], place), number(value[1], place), number(value[2], place)};
}
std::vector<Vec3> points(const json& object, const char* name, const std::string& place) {
  std::vector<Vec3> out;
  for (const json& value : array(object, name, place)) out.push_back(vector(value, place));
  return out;
}

template <std::size_t count>
std::array<Vec3, count> points_of(const json& object, const char* name, const std::string& place) {
  const std::vector<Vec3> read = points(object, name, place);
  if (read.size() != count) throw Malformed{place, std::string("'") + name + "' has another number of points"};
  std::array<Vec3, count> out;
  std::copy(read.begin(), read.end(), out.begin());
  return out;
}

ContactPatch patch(const json& entry, const std::string& place) {
  return {vector(member(entry, "centre", place), place), vector(member(entry, "normal", place), place),
          points_of<2>(entry, "half_sides", place), points_of<4>(entry, "local_a", place),
          points_of<4>(entry, "local_b", place)};
}

std::vector<ContactPoint> contact_points(const json& entry, const std::string& place) {
  std::vector<ContactPoint> out;
  for (const json& point : array(entry, "contact_points", place))
    out.push_back({vector(member(point, "point", place), place), vector(member(point, "normal", place), place)});
  return out;
}

json contact_points_json(const std::vector<ContactPoint>& points) {
  json out = json::array();
  for (const auto& [point, normal] : points)
    out.push_back({{"point", vector_json(point)}, {"normal", vector_json(normal)}});
  return out;
}

json axes_json(const Mat3& axes) {
  json out = json::array();
  for (int i = 0; i < 3; ++i) out.push_back(vector_json(axes.row(i).transpose()));
  return out;
}

json part_json(const Shape& shape, const Part& part) {
  json corners = json::array(), members = json::array();
  for (int k = 0; k < 8; ++k) corners.push_back(vector_json(part.hexahedron.corners.row(k).transpose()));
  for (const PartIndex p : part.members) members.push_back(shape.parts[p].id);
  json out = {{"id", part.id},
              {"label", part.label},
              {"name", part.name},
              {"node", part.node},
              {"primitive", part.primitive},
              {"corners", corners},
              {"axes", axes_json(part.hexahedron.axes)},
              {"virtual", part.is_virtual()},
              {"members", members}};
  if (part.group) out["group"] = shape.relations[*part.group].id;
  return out;
}

template <std::size_t count>
json points_json(const std::array<Vec3, count>& points) {
  return points_json(std::vector<Vec3>(points.begin(), points.end()));
}

json patch_json(const ContactPatch& patch) {
  return {{"centre", vector_json(patch.centre)},
          {"normal", vector_json(patch.normal)},
          {"half_sides", points_json(patch.half_sides)},
          {"local_a", points_json(patch.local_a)},
          {"local_b", points_json(patch.local_b)}};
}

json relation_json(const Shape& shape, const Relation& relation) {
  json parts = json::array();
  for (const PartIndex p : relation.parts) parts.push_back(shape.parts[p].id);
  json out = {{"id", relation.id}, {"kind", to_string(relation.kind)}, {"parts", parts}};
  const std::size_t count = relation.parts.size();
  if (const auto* r = std::get_if<Reflection>(&relation.detail)) {
    out["origin"] = vector_json(r->origin);
    out["normal"] = vector_json(r->normal);
    out["corner_map"] = r->corner_map;
    if (r->stacked) out["stacked"] = true;
  } else if (const auto* t = std::get_if<Translation>(&relation.detail)) {
    out["parent"] = shape.parts[t->parent].id;
    out["start"] = vector_json(t->start);
    out["end"] = vector_json(t->end);
    out["count"] = count;
    out["delta"] = vector_json((t->end - t->start) / static_cast<double>(count - 1));
    out["axis"] = t->axis;
    out["direction"] = t->direction;
    if (t->touching) out["touching"] = true;
  } else if (const auto* o = std::get_if<Rotation>(&relation.detail)) {
    out["parent"] = shape.parts[o->parent].id;
    out["centre"] = vector_json(o->centre);
    out["axis"] = vector_json(o->axis);
    out["parent_axis"] = o->parent_axis;
    out["radius"] = o->radius;
    out["count"] = count;
    out["angle"] = 2 * pi / static_cast<double>(count);
    out["arc"] = 2 * pi * o->radius / static_cast<double>(count);
  } else if (const auto* a = std::get_if<Attachment>(&relation.detail)) {
    out["points"] = points_json(a->points);
    out["local_a"] = points_json(a->local_a);
    out["local_b"] = points_json(a->local_b);
    if (a->patch) out["patch"] = patch_json(*a->patch);
    if (!a->contact_points.empty()) out["contact_points"] = contact_points_json(a->contact_points);
  } else if (const auto* g = std::get_if<Ground>(&relation.detail)) {
    out["points"] = points_json(g->points);
    out["local"] = points_json(g->local);
  }
  return out;
}

class Reader {
 public:
  Shape read(const json& file) {
    if (text(file, "format", "/") != "parsel/shape") throw Malformed{"/format", "it is not parsel/shape"};
    if (integer(file, "version", "/") != 1) throw Malformed{"/version", "only version 1 is known"};
    shape_.name = name(file, "name", "/");
    shape_.sha256 = text(file, "sha256", "/");
    shape_.frame.centre = vector(member(member(file, "frame", "/"), "centre", "/frame"), "/frame/centre");
    shape_.frame.scale = number(member(file["frame"], "scale", "/frame"), "/frame/scale");
    if (file["frame"].contains("axes")) {
      const std::vector<Vec3> axes = points(file["frame"], "axes", "/frame");
      if (axes.size() != 3) throw Malformed{"/frame/axes", "a frame has 3 axes"};
      for (int i = 0; i < 3; ++i) shape_.frame.axes.row(i) = axes[static_cast<std::size_t>(i)].transpose();
    }
    const json &parts = array(file, "parts", "/"), &relations = array(file, "relations", "/");
    for (std::size_t i = 0; i < parts.size(); ++i) read_part(parts[i], "/parts/" + std::to_string(i));
    for (std::size_t i = 0; i < relations.size(); ++i) read_relation(relations[i], "/relations/" + std::to_string(i));
    for (const PartIndex p : shape_.parts.indices()) link_part(parts[p.value()], p);
    for (const json& warning : array(file, "warnings", "/")) {
      shape_.warnings.push_back({text(warning, "place", "/warnings"), text(warning, "text", "/warnings")});
    }
    return std::move(shape_);
  }

 private:
  void read_part(const json& entry, const std::string& place) {
    Part part;
    part.id = name(entry, "id", place);
    part.label = name(entry, "label", place);
    part.name = name(entry, "name", place);
    part.node = integer(entry, "node", place);
    part.primitive = integer(entry, "primitive", place);
    const std::vector<Vec3> corners = points(entry, "corners", place), axes = points(entry, "axes", place);
    if (corners.size() != 8 || axes.size() != 3) throw Malformed{place, "a hexahedron has 8 corners and 3 axes"};
    for (int k = 0; k < 8; ++k) part.hexahedron.corners.row(k) = corners[static_cast<std::size_t>(k)].transpose();
    for (int i = 0; i < 3; ++i) part.hexahedron.axes.row(i) = axes[static_cast<std::size_t>(i)].transpose();
    by_id_.emplace(part.id, PartIndex(shape_.parts.size()));
    shape_.parts.push_back(std::move(part));
  }

  void link_part(const json& entry, PartIndex index) {
    const std::string place = "/parts/" + std::to_string(index.value());
    for (const json& id : array(entry, "members", place)) shape_.parts[index].members.push_back(part(id, place));
    if (!entry.contains("group")) return;
    const auto found = relation_by_id_.find(text(entry, "group", place));
    if (found == relation_by_id_.end()) throw Malformed{place, "its group does not exist"};
    shape_.parts[index].group = found->second;
  }

  PartIndex part(const json& id, const std::string& place) const {
    if (!id.is_string()) throw Malformed{place, "a part's id was expected"};
    const auto found = by_id_.find(id.get<std::string>());
    if (found == by_id_.end()) throw Malformed{place, "it names a part that does not exist"};
    return found->second;
  }

  void read_relation(const json& entry, const std::string& place) {
    Relation relation;
    relation.id = name(entry, "id", place);
    const std::optional<RelationKind> kind = relation_kind(text(entry, "kind", place));
    if (!kind) throw Malformed{place, "its kind is unknown"};
    relation.kind = *kind;
    for (const json& id : array(entry, "parts", place)) relation.parts.push_back(part(id, place));
    if (*kind == RelationKind::reflection) {
      Reflection r{vector(member(entry, "origin", place), place), vector(member(entry, "normal", place), place), {}};
      const json& map = array(entry, "corner_map", place);
      if (map.size() != 8) throw Malformed{place, "a corner map has 8 entries"};
      for (std::size_t k = 0; k < 8; ++k)
        r.corner_map[k] = static_cast<int>(std::clamp(number(map[k], place), -1.0, 8.0));
      r.stacked = flag(entry, "stacked", place);
      relation.detail = r;
    } else if (*kind == RelationKind::translation) {
      relation.detail =
          Translation{part(member(entry, "parent", place), place), vector(member(entry, "start", place), place),
                      vector(member(entry, "end", place), place),  integer(entry, "axis", place),
                      integer(entry, "direction", place),          flag(entry, "touching", place)};
    } else if (*kind == RelationKind::rotation) {
      relation.detail =
          Rotation{part(member(entry, "parent", place), place), vector(member(entry, "centre", place), place),
                   vector(member(entry, "axis", place), place), integer(entry, "parent_axis", place),
                   number(member(entry, "radius", place), place)};
    } else if (*kind == RelationKind::ground) {
      relation.detail = Ground{points(entry, "points", place), points(entry, "local", place)};
    } else {
      Attachment a{points(entry, "points", place), points(entry, "local_a", place), points(entry, "local_b", place)};
      if (entry.contains("patch")) a.patch = patch(entry["patch"], place + "/patch");
      if (entry.contains("contact_points")) a.contact_points = contact_points(entry, place);
      relation.detail = std::move(a);
    }
    relation_by_id_.emplace(relation.id, RelationIndex(shape_.relations.size()));
    shape_.relations.push_back(std::move(relation));
  }

  Shape shape_;
  std::map<std::string, PartIndex> by_id_;
  std::map<std::string, RelationIndex> relation_by_id_;
};

}  // namespace

json to_json(const Shape& shape) {
  json parts = json::array(), relations = json::array(), warnings = json::array();
  for (const Part& part : shape.parts) parts.push_back(part_json(shape, part));
  for (const Relation& relation : shape.relations) relations.push_back(relation_json(shape, relation));
  for (const Warning& warning : shape.warnings) warnings.push_back({{"place", warning.place}, {"text", warning.text}});
  json frame = {{"centre", vector_json(shape.frame.centre)}, {"scale", shape.frame.scale}};
  if (shape.frame.axes != Mat3::Identity()) frame["axes"] = axes_json(shape.frame.axes);
  return {{"format", "parsel/shape"}, {"version", 1},   {"name", shape.name},     {"sha256", shape.sha256},
          {"frame", frame},           {"parts", parts}, {"relations", relations}, {"warnings", warnings}};
}

Result<Shape> shape_from_json(const json& file) {
  try {
    Shape shape = Reader().read(file);
    if (const Status sound = validate(shape); !sound.ok()) return sound.error();
    return shape;
  } catch (const Malformed& fault) {
    return Error{"shape/json", fault.place, fault.cause, "make the file anew with parsel inspect"};
  }
}

}  // namespace parsel
