// Which parts nouns with their sides mean: plain_seed.h.
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

}  // namespace parsel
