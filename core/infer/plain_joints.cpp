// Which joints give way to what is moved, opened or made taller, and what goes along with it: plain_part.h. Propagation keeps
// a joint where it is on both parts, so that a shelf that is moved up between two walls would take the walls with it. Here
// a part slides along what it touches as long as it still touches it.
#include <algorithm>
#include <cmath>

#include "core/infer/plain_part.h"

namespace parsel {

namespace {

constexpr double beyond = 0.03;   ///< half-diagonals, and more is left to slide along
constexpr double at_end = 0.1;    ///< of a part's length: the end of it
constexpr double stacked = 0.02;  ///< half-diagonals that one part on another may reach into it
constexpr double flush = 0.04;    ///< half-diagonals
constexpr double smaller = 1.05;  ///< of its volume, and less may go along with what is opened

struct Touch {
  RelationIndex relation;
  PartIndex other;
  PartBox at;
};

class Loosening {
 public:
  Loosening(const ShapeFacts& facts, const std::vector<PartIndex>& parts)
      : facts_(facts), shape_(facts.shape()), parts_(parts) {
    // A seed on an instance takes its group apart.
    single_ = std::any_of(parts.begin(), parts.end(), [&](PartIndex p) {
      return shape_.parts[p].group.has_value() && !shape_.parts[p].is_virtual();
    });
    active_.insert(facts.active().begin(), facts.active().end());
  }

  void moved(int axis, int sign, PartIndex seed, PlainEdit& edit) const {
    std::vector<PartIndex> open = parts_;
    std::set<PartIndex> along(parts_.begin(), parts_.end());
    const bool mirrored = opposite(axis, seed);
    while (!open.empty()) {
      const PartIndex p = open.back();
      open.pop_back();
      const double side = facts_.extent(p).centre()[axis] - facts_.extent(seed).centre()[axis];
      const int way = mirrored && std::abs(side) > beyond ? -sign : sign;
      for (const Touch& touch : touches(p)) {
        if (along.count(touch.other) > 0) continue;
        if (slides(p, touch, axis, way)) {
          edit.loose.insert(touch.relation);
        } else if (!on_floor(touch.other) && volume(touch.other) < volume(p)) {
          along.insert(touch.other);
          open.push_back(touch.other);
        }
      }
    }
  }

  /// `axis`: along which it opens; what lies within its face and is smaller goes along.
  void opened(int axis, Hint hint, PlainEdit& edit) const {
    std::set<PartIndex> along(parts_.begin(), parts_.end());
    std::vector<PartIndex> open = parts_;
    while (!open.empty()) {
      const PartIndex p = open.back();
      open.pop_back();
      for (const Touch& touch : touches(p)) {
        if (along.count(touch.other) > 0 || !hangs_on(touch.other, axis)) continue;
        along.insert(touch.other);
        open.push_back(touch.other);
        edit.hints[shape_.parts[touch.other].id] = hint;
      }
    }
    for (const PartIndex p : along) {
      for (const Touch& touch : touches(p)) {
        if (along.count(touch.other) == 0 || !of_one(p, touch.other, axis)) edit.loose.insert(touch.relation);
      }
    }
    if (hint == Hint::rotate) loosen_turned(along, axis, edit);
  }

  /// `end`: the one along the axis that stays where it is. What lies beside a part whose other end is free stays as well.
  void grown(int axis, int end, PlainEdit& edit) const {
    const auto past = [&](PartIndex p, const PartBox& other) {  // how far it reaches beyond the free end
      const PartBox own = facts_.extent(p);
      return end < 0 ? other.high[axis] - own.high[axis] : own.low[axis] - other.low[axis];
    };
    for (const PartIndex p : parts_) {
      const double slack = at_end * facts_.extent(p).size()[axis];
      for (const Touch& touch : touches(p)) {
        const Vec3 joint = touch.at.centre(), other = facts_.extent(touch.other).centre();
        if (past(p, {joint, joint}) > -slack && past(p, {other, other}) > -slack) return;
      }
    }
    for (const PartIndex p : parts_) {
      const PartBox own = facts_.extent(p);
      for (const Touch& touch : touches(p)) {
        const bool is_own = std::find(parts_.begin(), parts_.end(), touch.other) != parts_.end();
        const double from_end =
            end < 0 ? touch.at.centre()[axis] - own.low[axis] : own.high[axis] - touch.at.centre()[axis];
        const bool at_fixed_end = from_end < at_end * own.size()[axis];
        // What ends where it ends and is less, as a cushion on a back, goes along.
        const bool is_lining = std::abs(past(p, facts_.extent(touch.other))) < flush && volume(touch.other) < volume(p);
        if (!is_own && !at_fixed_end && !is_lining) edit.loose.insert(touch.relation);
      }
    }
  }

  /// What is on one axis with a part that gets wider or narrower across it, and above or below, stays as it is and is still
  /// joined to it: the foot of a column. What ends where the part ends, as a mattress does, goes along.
  void widened(int axis, PlainEdit& edit) const {
    for (const PartIndex p : parts_) {
      const PartBox own = facts_.extent(p);
      for (const Touch& touch : touches(p)) {
        const PartBox other = facts_.extent(touch.other);
        // Of a column that is let into its foot less than half of the lower of the two is inside.
        const double inside = std::min(own.high[axis], other.high[axis]) - std::max(own.low[axis], other.low[axis]);
        bool on_axis = inside < std::min(own.size()[axis], other.size()[axis]) / 2, is_flush = true;
        for (const int across : {0, 1, 2}) {
          if (across == axis) continue;
          on_axis = on_axis && std::abs(other.centre()[across] - own.centre()[across]) < beyond;
          is_flush = is_flush && std::abs(other.size()[across] - own.size()[across]) < at_end * own.size()[across];
        }
        if (on_axis && !is_flush) edit.loose.insert(touch.relation);
      }
    }
  }

  /// What grows about its middle along a larger part that reaches on to both sides, as a door on a wall, leaves that alone.
  void spread(int axis, PlainEdit& edit) const {
    for (const PartIndex p : parts_) {
      const PartBox own = facts_.extent(p);
      for (const Touch& touch : touches(p)) {
        const PartBox other = facts_.extent(touch.other);
        const double room = std::min(other.high[axis] - own.high[axis], own.low[axis] - other.low[axis]);
        if (room > beyond && volume(other) > volume(own)) edit.loose.insert(touch.relation);
      }
    }
  }

  /// What is inside a part that gets larger stays as large as it is; so does what holds it, where it `is_held` at the end
  /// that stays.
  void enlarged(bool is_held, PlainEdit& edit) const {
    const std::vector<PartIndex> carried = facts_.carried_by(parts_);
    for (const PartIndex p : parts_) {
      const PartBox own = facts_.extent(p);
      for (const Touch& touch : touches(p)) {
        const PartBox inner = facts_.extent(touch.other);
        const bool is_inside =
            (inner.low - own.low).minCoeff() >= -beyond && (own.high - inner.high).minCoeff() >= -beyond;
        const bool holds = is_held && std::find(carried.begin(), carried.end(), touch.other) == carried.end();
        if (holds || (is_inside && volume(touch.other) < volume(p))) edit.loose.insert(touch.relation);
      }
    }
  }

 private:
  /// The two handles of a door are no mirror images in the room once it is open.
  void loosen_turned(const std::set<PartIndex>& along, int axis, PlainEdit& edit) const {
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      const auto* mirror = std::get_if<Reflection>(&relation.detail);
      if (mirror == nullptr || main_axis_of(mirror->normal) == 1) continue;
      const PartIndex a = relation.parts[0], b = relation.parts[1];
      if (along.count(a) > 0 && along.count(b) > 0 && of_one(a, b, axis)) edit.loose.insert(r);
    }
  }

  /// Whether both are of the same door.
  bool of_one(PartIndex a, PartIndex b, int axis) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](PartIndex p) {
      return (a == p || within_face(a, p, axis)) && (b == p || within_face(b, p, axis));
    });
  }

  bool hangs_on(PartIndex other, int axis) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](PartIndex p) {
      if (!within_face(other, p, axis)) return false;
      // A handle before it and a pane in it, not the board below it; and what else is called a drawer.
      const PartBox face = facts_.extent(p);
      const double middle = facts_.extent(other).centre()[axis];
      const bool is_at_face = middle > face.high[axis] - beyond || middle < face.low[axis] + beyond;
      const auto joints = touches(other);
      const bool has_no_other = std::all_of(joints.begin(), joints.end(), [&](const Touch& t) { return t.other == p; });
      return is_at_face || has_no_other || (is_drawer(shape_, p) && is_drawer(shape_, other));
    });
  }
  double volume(PartIndex p) const { return volume(facts_.extent(p)); }
  static double volume(const PartBox& box) { return box.size().cwiseMax(1e-3).prod(); }
  bool on_floor(PartIndex p) const { return facts_.extent(p).low[1] - facts_.whole().low[1] < beyond; }

  bool counts(PartIndex p) const { return single_ ? !shape_.parts[p].is_virtual() : active_.count(p) > 0; }

  std::vector<Touch> touches(PartIndex p) const {
    std::vector<Touch> found;
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      const auto* joint = std::get_if<Attachment>(&relation.detail);
      if (joint == nullptr || joint->points.empty()) continue;
      if (relation.parts[0] != p && relation.parts[1] != p) continue;
      const PartIndex other = relation.parts[relation.parts[0] == p ? 1 : 0];
      if (!counts(p) || !counts(other)) continue;
      PartBox at{joint->points.front(), joint->points.front()};
      for (const Vec3& point : joint->points) {
        at.low = at.low.cwiseMin(point);
        at.high = at.high.cwiseMax(point);
      }
      found.push_back({r, other, at});
    }
    return found;
  }

  /// Whether a mirror image of the seed among the parts goes the other way.
  bool opposite(int axis, PartIndex seed) const {
    const auto across = facts_.reflections_across(axis);
    return std::any_of(across.begin(), across.end(), [&](RelationIndex r) {
      const auto& pair = shape_.relations[r].parts;
      const auto listed = [&](PartIndex p) { return std::find(parts_.begin(), parts_.end(), p) != parts_.end(); };
      return (pair[0] == seed || pair[1] == seed) && listed(pair[0]) && listed(pair[1]);
    });
  }

  /// Whether they still touch when the part goes that way: ahead the other one goes on, or behind the part itself does.
  bool slides(PartIndex part, const Touch& touch, int axis, int sign) const {
    const PartBox own = facts_.extent(part), other = facts_.extent(touch.other);
    const bool is_stacked = other.low[axis] > own.high[axis] - stacked || own.low[axis] > other.high[axis] - stacked;
    if (is_stacked) return false;
    const double ahead = sign > 0 ? other.high[axis] - touch.at.high[axis] : touch.at.low[axis] - other.low[axis];
    const double behind = sign > 0 ? touch.at.low[axis] - own.low[axis] : own.high[axis] - touch.at.high[axis];
    return ahead > beyond || behind > beyond;
  }

  bool within_face(PartIndex other, PartIndex p, int axis) const {
    const PartBox inner = facts_.extent(other), face = facts_.extent(p);
    for (const int across : {0, 1, 2}) {
      if (across == axis) continue;
      if (inner.low[across] < face.low[across] - beyond || inner.high[across] > face.high[across] + beyond)
        return false;
    }
    return volume(other) < smaller * volume(p);
  }

  const ShapeFacts& facts_;
  const Shape& shape_;
  const std::vector<PartIndex>& parts_;
  std::set<PartIndex> active_;
  bool single_ = false;
};

}  // namespace

void loosen(const ShapeFacts& facts, const Clause& clause, const std::vector<PartIndex>& parts, PlainEdit& edit) {
  if (edit.statements.empty() || clause.serves) return;
  const Statement& seed = edit.statements.front();
  const auto* origin = seed.origin ? std::get_if<PartPoint>(&*seed.origin) : nullptr;
  // What is made larger all round stays another thing than what is in it; a wider shade has its bulb as it would propagate.
  const bool grows = clause.change == Change::size;
  if (grows && seed.feature == LocalTriple{0, 0, 0}) {
    const bool is_held = seed.op == Op::scale_3d && origin != nullptr && origin->at != LocalTriple{0, 0, 0};
    Loosening(facts, parts).enlarged(is_held, edit);
  }
  const auto axis_of = [](const DirectionReference& reference) {
    const auto* own = std::get_if<PartAxis>(&reference);
    return own != nullptr ? Vec3(Vec3::Unit(own->axis)) : std::get<Vec3>(reference);
  };
  if (seed.op == Op::scale_2d && seed.normal && seed.feature == LocalTriple{0, 0, 0})
    Loosening(facts, parts).widened(main_axis_of(axis_of(*seed.normal)), edit);
  if (!seed.direction || seed.feature != LocalTriple{0, 0, 0}) return;
  const Vec3 way = axis_of(*seed.direction);
  const auto part = facts.shape().find_part(seed.part);
  if (!part || std::find(parts.begin(), parts.end(), *part) == parts.end()) return;
  const int axis = main_axis_of(way);
  const Loosening loosening(facts, parts);
  const bool opens =
      clause.change == Change::open || clause.knows_way || (clause.out != 0 && is_drawer(facts.shape(), *part));
  if (seed.op == Op::rotate && clause.change == Change::open) {
    const Vec3 size = facts.extent(*part).size();
    loosening.opened(size[0] < size[2] ? 0 : 2, Hint::rotate, edit);
  } else if (seed.op == Op::translate && opens) {
    loosening.opened(axis, Hint::translate, edit);
  } else if (seed.op == Op::translate) {
    loosening.moved(axis, way[axis] > 0 ? 1 : -1, *part, edit);
  } else if (seed.op == Op::scale_1d) {
    const int end = origin != nullptr ? origin->at[static_cast<std::size_t>(axis)] : 0;
    if (end != 0) {
      loosening.grown(axis, end, edit);
    } else if (clause.change != Change::thick) {
      loosening.spread(axis, edit);
    }
  }
}

}  // namespace parsel
