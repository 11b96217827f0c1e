// Which parts nouns with their sides mean, and what shall be kept: plain_seed.h.
#include <algorithm>
#include <cmath>

#include "core/infer/plain_part.h"

namespace parsel {

namespace {

constexpr double beside = 0.02;  ///< and more is on a side, in half-diagonals

/// Instances of a group by place along an axis, the foremost to that side first.
std::vector<PartIndex> along(const ShapeFacts& facts, const std::vector<PartIndex>& members, const Side& side) {
  std::vector<PartIndex> order = members;
  std::stable_sort(order.begin(), order.end(), [&](PartIndex a, PartIndex b) {
    return facts.extent(a).centre()[side.axis] * side.sign > facts.extent(b).centre()[side.axis] * side.sign + 1e-9;
  });
  return order;
}

}  // namespace

std::vector<PartIndex> chosen(const ShapeFacts& facts, const Noun& noun) {
  const Shape& shape = facts.shape();
  std::vector<PartIndex> parts = noun.parts;
  if (noun.sides.empty() && !noun.middle) return parts;
  if (parts.size() == 1) {
    const Part& group = shape.parts[parts.front()];
    if (!group.is_virtual() || noun.plural) return {};
    std::vector<PartIndex> members = group.members;
    if (noun.middle) {
      if (members.size() % 2 == 0 || shape.relations[*group.group].kind != RelationKind::translation) return {};
      return {members[members.size() / 2]};
    }
    members = along(facts, members, noun.sides.front());
    const int axis = noun.sides.front().axis;
    const double gap = facts.extent(members[0]).centre()[axis] - facts.extent(members[1]).centre()[axis];
    return noun.sides.size() == 1 && std::abs(gap) > beside / 2 ? std::vector<PartIndex>{members.front()}
                                                                : std::vector<PartIndex>{};
  }
  for (const Side& side : noun.sides) {
    double middle = 0;
    for (const PartIndex p : noun.parts)
      middle += facts.extent(p).centre()[side.axis] / static_cast<double>(noun.parts.size());
    std::erase_if(parts,
                  [&](PartIndex p) { return (facts.extent(p).centre()[side.axis] - middle) * side.sign < beside; });
  }
  if (noun.middle) return {};
  return parts;
}

std::string keep(const ShapeFacts& facts, const Clause& clause, PlainEdit& edit) {
  if (!clause.fault.empty()) return clause.fault;
  if (clause.change != Change::none || clause.how_much || clause.where) return "it is not clear what shall stay";
  const Shape& shape = facts.shape();
  std::set<PartIndex> changed;
  double lifted_above = 2;  // of what goes up, the middle; nothing does
  for (const Statement& s : edit.statements) {
    const PartIndex part = *part_of(shape, s);
    changed.insert(part);
    const auto* way = s.direction ? std::get_if<Vec3>(&*s.direction) : nullptr;
    const bool upright = way != nullptr && main_axis_of(*way) == 1;
    if (upright && (s.op == Op::scale_1d || s.op == Op::translate))
      lifted_above = std::min(lifted_above, facts.extent(part).centre()[1]);
  }
  std::vector<PartIndex> parts;
  for (const Noun& noun : clause.nouns) {
    const auto some = chosen(facts, noun);
    parts.insert(parts.end(), some.begin(), some.end());
  }
  const bool whole = parts.empty() && clause.whole;
  if (whole) {
    if (lifted_above > 1.5) return "the whole cannot both change and stay";
    for (const PartIndex p : facts.active()) {
      if (changed.count(p) == 0 && facts.extent(p).centre()[1] > lifted_above) parts.push_back(p);
    }
  }
  if (parts.empty()) return "it does not say what shall stay";
  for (const PartIndex p : parts) {
    const auto twin = facts.mirrored(facts.active());
    const bool in_seed = std::any_of(twin.begin(), twin.end(), [&](const std::vector<PartIndex>& set) {
      return std::count(set.begin(), set.end(), p) > 0 &&
             std::any_of(set.begin(), set.end(), [&](PartIndex q) { return changed.count(q) > 0; });
    });
    if (in_seed) return name_of(shape, p) + " cannot both change and stay";
    const bool carried = facts.extent(p).centre()[1] > lifted_above;
    edit.hints[shape.parts[p].id] = clause.same_size || carried ? Hint::translate : Hint::keep_fixed;
  }
  return "";
}

}  // namespace parsel
