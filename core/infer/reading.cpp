#include "core/infer/reading.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.h"
#include "core/propagate/edit_request.h"
#include "core/propagate/transfer.h"

namespace parsel {

namespace {

/// The global axis that a direction is most along, and to which side.
struct Way {
  explicit Way(const Vec3& direction) {
    direction.cwiseAbs().maxCoeff(&axis);
    positive = direction[axis] >= 0;
  }
  int axis = 0;
  bool positive = true;
};

constexpr std::array<std::array<const char*, 2>, 3> toward = {
    {{"to the right", "to the left"}, {"down", "up"}, {"backwards", "forwards"}}};
constexpr std::array<const char*, 3> across = {"left and right", "up and down", "front and back"};
/// The quarter turn about +X brings the top forwards; about +Y, seen from above, the front to its left; about +Z the
/// top to its right.
constexpr std::array<std::array<const char*, 2>, 3> turning = {{{"tilt %s backwards", "tilt %s forwards"},
                                                                {"turn %s to the right", "turn %s to the left"},
                                                                {"tilt %s to the left", "tilt %s to the right"}}};
constexpr std::array<std::array<const char*, 2>, 3> sizing = {
    {{"narrow %s", "widen %s"}, {"make %s shorter", "make %s taller"}, {"make %s shallower", "make %s deeper"}}};
constexpr std::array<std::array<const char*, 2>, 3> side_words = {
    {{"right", "left"}, {"bottom", "top"}, {"back", "front"}}};

std::string with(const std::string& pattern, const std::string& name) {
  const std::size_t at = pattern.find("%s");
  return pattern.substr(0, at) + name + pattern.substr(at + 2);
}

std::string name_of(const Part& part) {
  return printable(part.name.empty() ? part.id : part.name, 40);
}

/// "top", "bottom front": a local triple, empty for the whole part or its centre.
std::string triple_words(const LocalTriple& at) {
  std::string text;
  for (const std::size_t axis : {1, 2, 0}) {
    if (at[axis] != 0) text += (text.empty() ? "" : " ") + std::string(side_words[axis][at[axis] > 0 ? 1 : 0]);
  }
  return text;
}

std::string operand(const Part& part, const LocalTriple& feature) {
  const auto sides = std::count_if(feature.begin(), feature.end(), [](int f) { return f != 0; });
  if (sides == 0) return name_of(part);
  constexpr std::array<const char*, 3> kinds = {"face", "edge", "corner"};
  return "the " + triple_words(feature) + " " + kinds[static_cast<std::size_t>(sides - 1)] + " of " + name_of(part);
}

std::string origin_words(const Shape& shape, const Statement& statement) {
  const auto* point = statement.origin ? std::get_if<PartPoint>(&*statement.origin) : nullptr;
  if (point == nullptr) return statement.origin ? " about a point" : "";
  const std::string where = triple_words(point->at).empty() ? "centre" : triple_words(point->at);
  if (point->part == statement.part) return " about its " + where;
  return " about the " + where + " of " + name_of(shape.parts[*shape.find_part(point->part)]);
}

/// Whether the amount grows with the slider.
bool grows(const Statement& statement) {
  const double high = 0.3;
  return statement.amount.compile({edit_parameter})(&high) >= 0;
}

std::string group_words(const Shape& shape, const Statement& statement) {
  const Relation& group = shape.relations[*shape.find_relation(statement.relation)];
  const std::string name = name_of(shape.parts[parent_of(group)]) + " (" + group.id + ")";
  const bool more = grows(statement);
  std::string text;
  if (statement.op == Op::change_count) {
    text = (more ? "more of " : "fewer of ") + name;
  } else if (group.kind == RelationKind::rotation) {
    text = with(more ? "widen the circle of %s" : "narrow the circle of %s", name);
  } else {
    text = with(more ? "space %s further apart" : "bring %s closer together", name);
  }
  if (statement.anchor == Anchor::fit) return text + ", in the same space";
  if (group.kind == RelationKind::rotation) return text;
  return text + ", from the " + std::string(to_string(statement.anchor));
}

std::string statement_words(const Shape& shape, const Statement& statement) {
  if (!is_geometric(statement.op)) return group_words(shape, statement);
  const Part& part = shape.parts[*shape.find_part(statement.part)];
  const std::string what = operand(part, statement.feature);
  if (statement.op == Op::keep_fixed) return "keep " + what + " as it is";
  const ResolvedOperator at_rest = to_step(shape, statement).what;
  const bool more = grows(statement);
  const Way way(more ? at_rest.direction : Vec3(-at_rest.direction));
  const auto axis = static_cast<std::size_t>(way.axis);
  const std::string about = origin_words(shape, statement);
  switch (statement.op) {
    case Op::translate:
      return "move " + what + " " + toward[axis][way.positive ? 1 : 0];
    case Op::rotate:
      return with(turning[axis][way.positive ? 1 : 0], what) + about;
    case Op::scale_1d:
      return with(sizing[axis][more ? 1 : 0], what) + about + ", " + across[axis];
    case Op::scale_2d: {
      const auto normal = static_cast<std::size_t>(Way(at_rest.normal).axis);
      return with(more ? "enlarge %s" : "shrink %s", what) + about + ", " + across[normal == 0 ? 1 : 0] + " and " +
             across[normal == 2 ? 1 : 2];
    }
    case Op::scale_3d:
      return with(more ? "enlarge %s" : "shrink %s", what) + about + ", in all directions";
    case Op::shear: {
      const Way normal(at_rest.normal);
      const bool same = normal.positive == way.positive;
      return "slant " + what + about + ": its " + side_words[static_cast<std::size_t>(normal.axis)][1] + " goes " +
             toward[axis][same ? 1 : 0];
    }
    case Op::keep_fixed:
    case Op::change_count:
    case Op::change_delta:
      break;
  }
  PARSEL_ASSERT(false, "what moves no points has been put into words");
  return "";
}

std::string signature(const Shape& shape, const Statement& statement) {
  std::string text = std::string(to_string(statement.op)) + " " + statement.part + statement.relation;
  if (statement.op == Op::keep_fixed) return text;
  for (const int f : statement.feature) text += " " + std::to_string(f);
  const bool more = grows(statement);
  if (!is_geometric(statement.op)) return text + (more ? " +" : " -");
  const ResolvedOperator at_rest = to_step(shape, statement).what;
  bool positive = more;
  if (needs_normal(statement.op)) {
    const Way normal(at_rest.normal);
    text += " n" + std::to_string(normal.axis);
    if (statement.op == Op::shear && !normal.positive) positive = !positive;
  }
  if (needs_direction(statement.op)) {
    const Way direction(at_rest.direction);
    text += " d" + std::to_string(direction.axis);
    if (statement.op != Op::scale_1d && !direction.positive) positive = !positive;
  }
  return text + (positive ? " +" : " -");
}

}  // namespace

std::string reading_words(const Shape& shape, const std::vector<Statement>& statements) {
  std::string text;
  for (const Statement& statement : statements) {
    text += (text.empty() ? "" : "; ") + statement_words(shape, statement);
  }
  return text;
}

std::string reading_signature(const Shape& shape, const std::vector<Statement>& statements) {
  std::vector<std::string> lines;
  for (const Statement& statement : statements) lines.push_back(signature(shape, statement));
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace parsel
