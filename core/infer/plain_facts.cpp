#include "core/infer/plain_facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace parsel {

namespace {

// Shares of a length, found on the gallery and on real furniture: boxes of real models are some percent off.
constexpr double clearly_longer = 1.15;
constexpr double as_thick_as_wide = 1.35;  ///< and less is a bar's section
constexpr double bar_length = 1.5;         ///< and more of its section is a bar
constexpr double plate = 1.6;              ///< and more of its thickness is a plate
constexpr double square = 0.02;
constexpr double on_floor = 0.02;      ///< of the whole's height
constexpr double near_floor = 0.15;    ///< likewise: a pole on a base
constexpr double tall_support = 0.25;  ///< likewise
constexpr double tall_whole = 0.40;    ///< likewise: what sets it

PartBox box_of(const Corners& corners) {
  return {corners.colwise().minCoeff().transpose(), corners.colwise().maxCoeff().transpose()};
}

std::array<int, 3> by_length(const Vec3& edges) {
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return edges[a] < edges[b]; });
  return order;
}

}  // namespace

int main_axis_of(const Vec3& direction) {
  int axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return axis;
}

ShapeFacts::ShapeFacts(const Shape& shape)
    : shape_(shape), active_(active_parts(shape)), relations_(active_relations(shape)), joints_(shape.parts.size()) {
  bool first = true;
  for (const PartIndex p : shape.parts.indices()) {
    if (shape.parts[p].is_virtual()) continue;
    const PartBox box = extent(p);
    whole_.low = first ? box.low : Vec3(whole_.low.cwiseMin(box.low));
    whole_.high = first ? box.high : Vec3(whole_.high.cwiseMax(box.high));
    first = false;
  }
  for (const RelationIndex r : relations_) {
    const Relation& relation = shape.relations[r];
    const auto* joint = std::get_if<Attachment>(&relation.detail);
    if (joint == nullptr || joint->points.empty()) continue;
    PartBox at{joint->points.front(), joint->points.front()};
    for (const Vec3& point : joint->points) {
      at.low = at.low.cwiseMin(point);
      at.high = at.high.cwiseMax(point);
    }
    joints_[relation.parts[0].value()].push_back({relation.parts[1], at});
    joints_[relation.parts[1].value()].push_back({relation.parts[0], at});
  }
}

PartBox ShapeFacts::extent(PartIndex part) const {
  return box_of(shape_.parts[part].hexahedron.corners);
}

Vec3 ShapeFacts::edges(PartIndex part) const {
  const Part& named = shape_.parts[part];
  return 2 * shape_.parts[named.is_virtual() ? named.members.front() : part].hexahedron.half_extents();
}

bool ShapeFacts::is_turned(PartIndex part) const {
  return (shape_.parts[part].hexahedron.axes - Mat3::Identity()).cwiseAbs().maxCoeff() > 0.02;
}

std::optional<int> ShapeFacts::long_axis(PartIndex part) const {
  const Vec3 e = edges(part);
  const auto order = by_length(e);
  if (e[order[2]] < clearly_longer * e[order[1]]) return std::nullopt;
  return order[2];
}

std::optional<int> ShapeFacts::bar_axis(PartIndex part) const {
  const Vec3 e = edges(part);
  const auto order = by_length(e);
  const bool is_bar = e[order[1]] < as_thick_as_wide * e[order[0]] && e[order[2]] > bar_length * e[order[1]];
  return is_bar ? std::optional(order[2]) : std::nullopt;
}

std::optional<int> ShapeFacts::thin_axis(PartIndex part) const {
  const Vec3 e = edges(part);
  const auto order = by_length(e);
  return e[order[1]] > plate * e[order[0]] ? std::optional(order[0]) : std::nullopt;
}

bool ShapeFacts::is_round(PartIndex part) const {
  const auto is_square = [&](PartIndex p) {
    const Vec3 size = extent(p).size();
    return std::abs(size[0] - size[2]) <= square * std::max(size[0], size[2]);
  };
  if (!is_square(part)) return false;
  const Vec3 centre = extent(part).centre();
  const auto same_axis = [&](const Vec3& other) {
    return std::hypot(other[0] - centre[0], other[2] - centre[2]) <=
           square * std::max(whole_.size()[0], whole_.size()[2]);
  };
  for (const RelationIndex r : relations_) {
    const auto* ring = std::get_if<Rotation>(&shape_.relations[r].detail);
    if (ring != nullptr && main_axis_of(ring->axis) == 1 && same_axis(ring->centre)) return true;
  }
  // A lamp: everything square about one axis.
  return active_.size() > 1 && std::all_of(active_.begin(), active_.end(),
                                           [&](PartIndex p) { return is_square(p) && same_axis(extent(p).centre()); });
}

bool ShapeFacts::may_be_ring(PartIndex part) const {
  const auto thin = thin_axis(part);
  return thin && *thin != 1 && std::any_of(relations_.begin(), relations_.end(), [&](RelationIndex r) {
           const auto* ring = std::get_if<Rotation>(&shape_.relations[r].detail);
           return ring != nullptr && main_axis_of(ring->axis) == *thin;
         });
}

bool ShapeFacts::stands(PartIndex part) const {
  const PartBox own = extent(part);
  const double height = own.size()[1];
  if (own.low[1] - whole_.low[1] <= on_floor * whole_.size()[1]) return true;
  return std::any_of(joints_[part.value()].begin(), joints_[part.value()].end(), [&](const Joint& joint) {
    const PartBox other = extent(joint.other);
    return other.centre()[1] < own.low[1] + 0.1 * height &&
           std::abs(other.high[1] - own.low[1]) <= 0.15 * height + 0.01;
  });
}

bool ShapeFacts::hangs(PartIndex part) const {
  if (stands(part)) return false;
  const PartBox own = extent(part);
  const double height = own.size()[1];
  return std::any_of(joints_[part.value()].begin(), joints_[part.value()].end(), [&](const Joint& joint) {
    const PartBox other = extent(joint.other);
    return other.centre()[1] > own.high[1] - 0.1 * height &&
           std::abs(other.low[1] - own.high[1]) <= 0.15 * height + 0.01;
  });
}

int ShapeFacts::joined_end(PartIndex part, int axis, double near) const {
  return joined_end(part, axis, near, {});
}

int ShapeFacts::held_end(PartIndex part, int axis, double near) const {
  const PartBox own = extent(part);
  std::vector<PartIndex> others = carried_by({part});
  for (const Joint& joint : joints_[part.value()]) {
    const PartBox inner = extent(joint.other);
    if ((inner.low - own.low).minCoeff() >= 0 && (own.high - inner.high).minCoeff() >= 0) others.push_back(joint.other);
  }
  return joined_end(part, axis, near, others);
}

int ShapeFacts::joined_end(PartIndex part, int axis, double near, const std::vector<PartIndex>& others) const {
  const PartBox own = extent(part);
  int end = 0;
  for (const Joint& joint : joints_[part.value()]) {
    if (std::find(others.begin(), others.end(), joint.other) != others.end()) continue;
    const double at = (joint.at.centre()[axis] - own.centre()[axis]) / std::max(own.size()[axis] / 2, 1e-9);
    const int here = at > near ? 1 : at < -near ? -1 : 0;
    if (here == 0 || here == -end) return 0;
    end = here;
  }
  return end;
}

std::optional<PartIndex> ShapeFacts::support(PartIndex part) const {
  const PartBox own = extent(part);
  const double height = whole_.size()[1];
  for (const PartIndex p : active_) {
    const bool joined = std::any_of(joints_[part.value()].begin(), joints_[part.value()].end(),
                                    [&](const Joint& joint) { return joint.other == p; });
    if (!joined) continue;
    const PartBox other = extent(p);
    const bool below =
        other.centre()[1] < own.low[1] && std::abs(other.high[1] - own.low[1]) <= 0.04 * height + 0.5 * own.size()[1];
    const bool carries =
        other.size()[1] >= tall_support * height && other.low[1] - whole_.low[1] <= near_floor * height;
    if (below && carries) return p;
  }
  return std::nullopt;
}

std::optional<PartIndex> ShapeFacts::setting(int axis, std::optional<PartIndex>* close) const {
  constexpr double margin = 0.15;
  std::optional<PartIndex> best;
  double most = 0, second = 0;
  const Vec3 size = whole_.size();
  for (const PartIndex p : active_) {
    if (is_turned(p)) continue;
    const Vec3 own = extent(p).size();
    const double cover = own[axis] / size[axis];
    if (cover < 0.5) continue;
    // What many others are joined to, and what one sits on, lies under or stands behind: large and level.
    const double joints = 0.1 * static_cast<double>(std::min<std::size_t>(joints_[p.value()].size(), 5));
    const double level = 0.3 * own[0] * own[2] / (size[0] * size[2]);
    const double score = cover + joints + level - (shape_.parts[p].is_virtual() ? 0.3 : 0.0);
    if (score > most + 1e-6) {
      second = most;
      if (close != nullptr) *close = best;
      most = score;
      best = p;
    } else if (score > second + 1e-6) {
      second = score;
      if (close != nullptr) *close = p;
    }
  }
  if (close != nullptr && second < most - margin) close->reset();
  return best;
}

std::optional<PartIndex> ShapeFacts::upright() const {
  const double height = whole_.size()[1];
  std::vector<PartIndex> found;
  for (const PartIndex p : active_) {
    const PartBox own = extent(p);
    // A group is as tall as its instances: shelves are not, columns are.
    const double tall = shape_.parts[p].is_virtual() ? edges(p)[1] : own.size()[1];
    if (own.low[1] - whole_.low[1] <= near_floor * height && tall >= tall_whole * height) found.push_back(p);
  }
  if (found.empty()) return std::nullopt;
  // A part that reaches less far up is not what sets the height; two that do and are not alike may both be meant.
  double top = 0;
  for (const PartIndex p : found) top = std::max(top, extent(p).high[1]);
  for (const PartIndex p : found) {
    const bool much_lower = top - extent(p).high[1] > 0.1 * height;
    if (much_lower && !is_turned(p)) return std::nullopt;
  }
  // Supports come in pairs, or are groups; then the bulkiest.
  const auto weight = [&](PartIndex p) {
    const bool paired =
        shape_.parts[p].is_virtual() || std::any_of(relations_.begin(), relations_.end(), [&](RelationIndex r) {
          const Relation& relation = shape_.relations[r];
          return relation.kind == RelationKind::reflection && (relation.parts[0] == p || relation.parts[1] == p);
        });
    return (paired ? 100.0 : 0.0) + extent(p).size().prod();
  };
  return *std::max_element(found.begin(), found.end(),
                           [&](PartIndex a, PartIndex b) { return weight(a) + 1e-9 < weight(b); });
}

std::vector<PartIndex> ShapeFacts::carried_by(const std::vector<PartIndex>& parts) const {
  const std::set<PartIndex> carriers(parts.begin(), parts.end());
  // Without the carriers the shape falls apart; what is joined to the largest piece needs none of them.
  std::vector<std::set<PartIndex>> pieces;
  std::set<PartIndex> seen = carriers;
  for (const PartIndex start : active_) {
    if (!seen.insert(start).second) continue;
    std::set<PartIndex> piece = {start};
    std::vector<PartIndex> open = {start};
    while (!open.empty()) {
      const PartIndex p = open.back();
      open.pop_back();
      for (const Joint& joint : joints_[p.value()]) {
        if (!seen.insert(joint.other).second) continue;
        piece.insert(joint.other);
        open.push_back(joint.other);
      }
    }
    pieces.push_back(std::move(piece));
  }
  if (pieces.empty()) return {};
  // What stands on the floor carries, and nothing carries it.
  const auto feet = [&](const std::set<PartIndex>& piece) {
    return std::count_if(piece.begin(), piece.end(),
                         [&](PartIndex p) { return extent(p).low[1] - whole_.low[1] <= on_floor * whole_.size()[1]; });
  };
  const auto largest = std::max_element(pieces.begin(), pieces.end(), [&](const auto& a, const auto& b) {
    return std::pair(feet(a), a.size()) < std::pair(feet(b), b.size());
  });
  std::vector<PartIndex> carried;
  for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
    const bool hangs_on = std::any_of(piece->begin(), piece->end(), [&](PartIndex p) {
      return std::any_of(joints_[p.value()].begin(), joints_[p.value()].end(),
                         [&](const Joint& joint) { return carriers.count(joint.other) > 0; });
    });
    if (piece != largest && feet(*piece) == 0 && hangs_on) carried.insert(carried.end(), piece->begin(), piece->end());
  }
  return carried;
}

std::pair<int, int> ShapeFacts::outward(PartIndex part) const {
  const PartBox own = extent(part);
  std::pair<int, int> best = {2, 1};
  double least = 2;
  for (const int axis : {2, 0}) {
    for (const int sign : {1, -1}) {
      const double gap = sign > 0 ? whole_.high[axis] - own.high[axis] : own.low[axis] - whole_.low[axis];
      const double share = gap / std::max(whole_.size()[axis], 1e-9);
      if (share < least - 0.01) least = share, best = {axis, sign};
    }
  }
  return best;
}

std::pair<int, int> ShapeFacts::opening(PartIndex part) const {
  constexpr double before = 0.05;  // half-diagonals
  const PartBox own = extent(part);
  const std::vector<Joint>& joints = joints_[part.value()];
  const bool is_free = std::none_of(joints.begin(), joints.end(), [&](const Joint& joint) {
    const PartBox other = extent(joint.other);
    return other.size().prod() > own.size().prod() && other.high[2] - own.high[2] > before;
  });
  return !joints.empty() && is_free ? std::pair(2, 1) : outward(part);
}

int ShapeFacts::hinge(PartIndex door) const {
  const PartBox own = extent(door);
  for (const Joint& joint : joints_[door.value()]) {
    const PartBox other = extent(joint.other);
    const bool small = other.size()[0] < 0.4 * own.size()[0] && other.size()[1] < 0.8 * own.size()[1];
    const double offset = other.centre()[0] - own.centre()[0];
    if (small && std::abs(offset) > 0.1 * own.size()[0]) return offset > 0 ? -1 : 1;
  }
  return own.centre()[0] >= whole_.centre()[0] ? 1 : -1;
}

std::vector<std::vector<PartIndex>> ShapeFacts::mirrored(const std::vector<PartIndex>& parts) const {
  std::vector<std::vector<PartIndex>> sets;
  std::set<PartIndex> seen;
  for (const PartIndex start : parts) {
    if (seen.count(start) > 0) continue;
    std::set<PartIndex> set = {start};
    for (bool grew = true; grew;) {
      grew = false;
      for (const RelationIndex r : relations_) {
        const Relation& relation = shape_.relations[r];
        if (relation.kind != RelationKind::reflection) continue;
        for (const int i : {0, 1}) {
          const PartIndex here = relation.parts[static_cast<std::size_t>(i)],
                          there = relation.parts[static_cast<std::size_t>(1 - i)];
          const bool listed = std::find(parts.begin(), parts.end(), there) != parts.end();
          if (set.count(here) > 0 && listed && set.insert(there).second) grew = true;
        }
      }
    }
    seen.insert(set.begin(), set.end());
    sets.emplace_back(set.begin(), set.end());
  }
  return sets;
}

std::vector<RelationIndex> ShapeFacts::reflections_across(int axis) const {
  std::vector<RelationIndex> found;
  for (const RelationIndex r : relations_) {
    const auto* mirror = std::get_if<Reflection>(&shape_.relations[r].detail);
    if (mirror != nullptr && main_axis_of(mirror->normal) == axis) found.push_back(r);
  }
  return found;
}

std::vector<RelationIndex> ShapeFacts::reflections_leaving(const std::vector<PartIndex>& parts) const {
  const auto listed = [&](PartIndex p) { return std::find(parts.begin(), parts.end(), p) != parts.end(); };
  std::set<RelationIndex> found;
  for (const RelationIndex r : relations_) {
    const Relation& relation = shape_.relations[r];
    const auto* mirror = std::get_if<Reflection>(&relation.detail);
    if (mirror == nullptr || listed(relation.parts[0]) == listed(relation.parts[1])) continue;
    for (const RelationIndex other : reflections_across(main_axis_of(mirror->normal))) found.insert(other);
  }
  return {found.begin(), found.end()};
}

}  // namespace parsel
