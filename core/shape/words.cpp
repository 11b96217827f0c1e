#include "core/shape/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "core/base/text.h"

namespace parsel {
namespace {

std::string percent(double share) {
  return std::to_string(static_cast<long>(std::lround(100 * share)));
}

/// Half extents of the axis-aligned box around a hexahedron.
Vec3 reach(const Hexahedron& h) {
  return (h.corners.colwise().maxCoeff() - h.corners.colwise().minCoeff()).transpose() / 2;
}

Vec3 centre(const Part& part) {
  return part.hexahedron.point(Vec3::Zero());
}

struct Whole {
  explicit Whole(const Shape& shape) {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
    for (const Part& part : shape.parts) {
      if (part.is_virtual()) continue;  // a rotation's square box may stick out
      low = low.cwiseMin(part.hexahedron.corners.colwise().minCoeff().transpose());
      high = high.cwiseMax(part.hexahedron.corners.colwise().maxCoeff().transpose());
    }
    start = low;
    size = (high - low).cwiseMax(1e-9);
  }
  Vec3 start, size;
};

std::string size_and_place(const Part& part, const Whole& whole) {
  const Vec3 size = (2 * reach(part.hexahedron)).cwiseQuotient(whole.size);
  const Vec3 at = (centre(part) - whole.start).cwiseQuotient(whole.size);
  std::string text = percent(size[0]) + " x " + percent(size[1]) + " x " + percent(size[2]) + " at (" + percent(at[0]) +
                     ", " + percent(at[1]) + ", " + percent(at[2]) + ")";
  if ((part.hexahedron.axes - Mat3::Identity()).cwiseAbs().maxCoeff() > 0.02) text += ", turned";
  return text;
}

constexpr std::array<const char*, 3> sides = {"left and right", "top and bottom", "front and back"};
constexpr std::array<std::array<const char*, 2>, 3> ends = {{{"right", "left"}, {"bottom", "top"}, {"back", "front"}}};

int main_axis(const Vec3& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return axis;
}

std::string list(const Shape& shape, const std::vector<PartIndex>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += ", ";
    text += shape.parts[parts[i]].id;
  }
  return text;
}

std::string group_words(const Shape& shape, const Relation& relation) {
  const std::string count = std::to_string(relation.parts.size());
  if (const auto* t = std::get_if<Translation>(&relation.detail)) {
    const Vec3 way = t->end - t->start;
    const auto axis = static_cast<std::size_t>(main_axis(way));
    const bool up = way[static_cast<int>(axis)] > 0;
    return count + " parts at equal distances from " + ends[axis][up ? 0 : 1] + " to " + ends[axis][up ? 1 : 0] + ": " +
           list(shape, relation.parts);
  }
  const auto& r = std::get<Rotation>(relation.detail);
  static constexpr std::array<const char*, 3> about = {"the left-right axis", "the vertical axis",
                                                       "the front-back axis"};
  return count + " parts in a circle about " + about[static_cast<std::size_t>(main_axis(r.axis))] +
         " at equal angles: " + list(shape, relation.parts);
}

const char* joint_words(RelationKind kind) {
  switch (kind) {
    case RelationKind::point:
      return "at a point";
    case RelationKind::line:
      return "along a line";
    case RelationKind::face:
      return "over a face";
    default:
      return "throughout";
  }
}

}  // namespace

bool says_the_same(const std::string& id, const std::string& name) {
  const auto words = [](const std::string& text) {
    std::vector<std::string> out(1);
    for (const char c : text) {
      if (c == '_' || c == ' ' || c == '-') {
        out.emplace_back();
      } else {
        out.back() += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
      }
    }
    std::sort(out.begin(), out.end());
    return out;
  };
  return words(id) == words(name);
}

std::string quoted_name(std::string_view name) {
  std::string text = "\"";
  for (const char c : printable(name, 40)) text += c == '"' || c == '\\' || c == '`' ? '\'' : c;
  return text + "\"";
}

std::string describe(const Shape& shape, RelationIndex index) {
  const Relation& relation = shape.relations[index];
  if (relation.is_group()) return group_words(shape, relation);
  if (relation.kind == RelationKind::ground) return shape.parts[relation.parts[0]].id + " stands on the floor";
  const std::string pair = shape.parts[relation.parts[0]].id + " and " + shape.parts[relation.parts[1]].id;
  if (const auto* r = std::get_if<Reflection>(&relation.detail)) {
    return pair + " are mirror images of each other, " + sides[static_cast<std::size_t>(main_axis(r->normal))];
  }
  return pair + " are joined " + joint_words(relation.kind);
}

std::string describe_ground(const Shape& shape, const std::vector<RelationIndex>& dissolved) {
  std::string text;
  for (const RelationIndex r : active_relations(shape, dissolved)) {
    if (shape.relations[r].kind != RelationKind::ground) continue;
    text +=
        (text.empty() ? "" : ", ") + shape.parts[shape.relations[r].parts[0]].id + " (" + shape.relations[r].id + ")";
  }
  return text.empty() ? text : "On the floor stand (relation): " + text + ".\n";
}

std::string describe(const Shape& shape, const std::vector<RelationIndex>& dissolved) {
  const Whole whole(shape);
  const std::vector<PartIndex> parts = active_parts(shape, dissolved);
  const std::vector<RelationIndex> relations = active_relations(shape, dissolved);
  const double longest = whole.size.maxCoeff();
  std::string text = "The shape " + quoted_name(shape.name) + " has " + std::to_string(parts.size()) +
                     " parts. Its width : height : depth are as " + percent(whole.size[0] / longest) + " : " +
                     percent(whole.size[1] / longest) + " : " + percent(whole.size[2] / longest) + ".\n";
  text +=
      "Parts, as: id \"name where the id does not say it\": width x height x depth at (from right to left, from bottom "
      "to top, from back to front), "
      "all in percent of the whole shape.\n";
  for (const PartIndex p : parts) {
    const Part& part = shape.parts[p];
    text += "- " + part.id;
    if (!says_the_same(part.id, part.name)) text += " " + quoted_name(part.name);
    text += ": " + size_and_place(part, whole);
    if (part.is_virtual()) {
      const Relation& relation = shape.relations[*part.group];
      text += "; stands for relation " + relation.id + ", " + group_words(shape, relation) + "; each " +
              size_and_place(shape.parts[part.members.front()], whole);
    }
    text += "\n";
  }
  std::string mirrors;
  std::map<PartIndex, std::map<RelationKind, std::string>> joints;  // under the first of the two parts
  for (const RelationIndex r : relations) {
    const Relation& relation = shape.relations[r];
    if (relation.kind == RelationKind::reflection) mirrors += "- " + relation.id + ": " + describe(shape, r) + ".\n";
    if (!relation.is_attachment()) continue;
    std::string& list = joints[relation.parts[0]][relation.kind];
    list += (list.empty() ? " " : ", ") + shape.parts[relation.parts[1]].id + " (" + relation.id + ")";
  }
  if (!mirrors.empty()) text += "Mirror images:\n" + mirrors;
  if (!joints.empty()) text += "Joints (relation):\n";
  for (const auto& [part, kinds] : joints) {
    std::string line;
    for (const auto& [kind, list] : kinds) {
      line += (line.empty() ? " is joined " : "; ") + std::string(joint_words(kind)) + " to" + list;
    }
    text += "- " + shape.parts[part].id + line + ".\n";
  }
  return text;
}

}  // namespace parsel
