#include "core/cad/model.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text.h"
#include "core/base/tolerance.h"
#include "core/cad/label_note.h"
#include "core/shape/label.h"

namespace parsel::cad {

std::string_view to_string(Kind kind) {
  constexpr std::string_view words[] = {"box", "cylinder", "cone", "sphere", "opaque"};
  return words[static_cast<std::size_t>(kind)];
}

std::string_view to_string(Role role) {
  constexpr std::string_view words[] = {"add", "cut", "meet"};
  return words[static_cast<std::size_t>(role)];
}

Extent extent(const Part& part) {
  Extent box{-part.size / 2, part.size / 2};
  if (part.kind != Kind::cylinder && part.kind != Kind::cone) return box;
  const int u = (part.axis + 1) % 3, v = (part.axis + 2) % 3;
  const double wider = std::max(1.0, part.top / part.size[u]);
  for (const int i : {u, v}) {
    double low = -0.5, high = 0.5;
    if (part.sides > 0) {
      low = high = 0;
      for (int k = 0; k < part.sides; ++k) {
        const double angle = pi / 2 * part.phase + 2 * pi * k / part.sides;
        const double reach = (i == u ? std::cos(angle) : std::sin(angle)) / 2;
        low = std::min(low, reach);
        high = std::max(high, reach);
      }
    }
    box.low[i] = low * wider * part.size[i];
    box.high[i] = high * wider * part.size[i];
  }
  return box;
}

namespace {

void set_roles(const Node& node, Role role, std::vector<Part>& parts) {
  if (node.op == Node::Op::leaf) parts[node.part].role = role;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    const bool is_tail = i > 0 && role == Role::add;
    const Role own = is_tail && node.op == Node::Op::subtract    ? Role::cut
                     : is_tail && node.op == Node::Op::intersect ? Role::meet
                                                                 : role;
    set_roles(node.children[i], own, parts);
  }
}

/// Leaves in order; false when the tree is deeper than a program can be.
bool collect(const Node& node, std::vector<std::size_t>& leaves, std::size_t depth) {
  if (depth > Limits::depth) return false;
  if (node.op == Node::Op::leaf) leaves.push_back(node.part);
  return std::all_of(node.children.begin(), node.children.end(),
                     [&](const Node& child) { return collect(child, leaves, depth + 1); });
}

Error fault(const Part& part, std::string cause, std::string fix) {
  const std::string place = part.place.line > 0 ? to_string(part.place) : "part \"" + printable(part.id) + "\"";
  return {"cad/model", place, std::move(cause), std::move(fix)};
}

}  // namespace

bool Model::is_plain_union() const {
  if (tree.op == Node::Op::leaf) return true;
  return tree.op == Node::Op::unite &&
         std::all_of(tree.children.begin(), tree.children.end(), [](const Node& n) { return n.op == Node::Op::leaf; });
}

const Part* Model::find(std::string_view id) const {
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.id == id; });
  return found == parts.end() ? nullptr : &*found;
}

std::string stem(const Part& part) {
  return grouping_key(part.label);
}

void name_and_place(Model& model) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Part& part : model.parts) {
    const Extent box = extent(part);
    low = low.cwiseMin(part.centre + box.low);
    high = high.cwiseMax(part.centre + box.high);
  }
  const double scale = std::max((high - low).norm() / 2, 1e-300);
  std::vector<std::string> labels;
  std::vector<Vec3> centres;
  for (Part& part : model.parts) {
    part.label = label_from_note(clean_label(part.label));
    if (part.label.empty()) part.label = to_string(part.kind);
    labels.push_back(part.label);
    centres.push_back((part.centre - (low + high) / 2) / scale);
  }
  const std::vector<PartName> names = name_parts(labels, centres);
  for (std::size_t i = 0; i < names.size(); ++i) {
    model.parts[i].id = names[i].id;
    model.parts[i].name = names[i].name;
  }
  set_roles(model.tree, Role::add, model.parts);
}

Status validate(const Model& model) {
  if (model.parts.empty()) return Error{"cad/model", "", "it has no parts", "add a cube"};
  if (model.parts.size() > Limits::parts) {
    return Error{"cad/model", "", "it has more than " + std::to_string(Limits::parts) + " parts", "use fewer"};
  }
  std::set<std::string_view> ids;
  for (const Part& part : model.parts) {
    if (part.id.empty() || part.id.size() > 200 || !is_utf8(part.id)) {
      return fault(part, "its id is empty, too long or no UTF-8", "give it a short id");
    }
    if (!ids.insert(part.id).second) return fault(part, "its id is used twice", "give it another id");
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(part.centre[i]) <= Limits::coordinate)) {
        return fault(part, "it lies further than a million from the origin", "move it nearer");
      }
      if (!(part.size[i] > 0 && part.size[i] <= Limits::coordinate)) {
        return fault(part, "its size is not between 0 and a million", "give it a positive size");
      }
    }
    const bool is_cone = part.kind == Kind::cone;
    if (!(part.top >= 0 && part.top <= Limits::coordinate) || (!is_cone && part.top != 0)) {
      return fault(part, "the size of its top does not fit its kind", "give a top to cones alone, of at least 0");
    }
    if (part.axis < 0 || part.axis > 2 || std::abs(part.towards) != 1 || part.phase < 0 || part.phase > 3 ||
        (part.sides != 0 && (part.sides < 3 || part.sides > 15))) {
      return fault(part, "its axis or its number of sides is out of range", "use 3 to 15 sides, or 0 for round");
    }
  }
  std::vector<std::size_t> leaves;
  if (!collect(model.tree, leaves, 0)) return Error{"cad/model", "/tree", "it is nested too deeply", "make it flatter"};
  bool is_in_order = leaves.size() == model.parts.size();
  for (std::size_t i = 0; is_in_order && i < leaves.size(); ++i) is_in_order = leaves[i] == i;
  if (!is_in_order) {
    return Error{"cad/model", "/tree", "it does not name every part once, in order", "name them as they are listed"};
  }
  return success();
}

}  // namespace parsel::cad
