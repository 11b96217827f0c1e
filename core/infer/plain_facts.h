// What a plain request may take for granted of a shape: what stands on what, what is long, flat or round, which part sets
// the size of the whole. Lengths are in the normalised frame, axes global ones unless said otherwise.
#pragma once

#include <optional>
#include <vector>

#include "core/shape/shape.h"

namespace parsel {

/// The box of a part or of the whole, along the axes.
struct PartBox {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  Vec3 size() const { return high - low; }
  Vec3 centre() const { return (low + high) / 2; }
};

class ShapeFacts {
 public:
  explicit ShapeFacts(const Shape& shape);

  const Shape& shape() const { return shape_; }
  const std::vector<PartIndex>& active() const { return active_; }
  const PartBox& whole() const { return whole_; }
  PartBox extent(PartIndex part) const;
  /// Edge lengths along the part's own axes, of which axis i is the one nearest to global axis i; of a group, those of
  /// an instance.
  Vec3 edges(PartIndex part) const;
  bool is_turned(PartIndex part) const;

  /// The axis of the longest edge; nothing when two are about as long.
  std::optional<int> long_axis(PartIndex part) const;
  /// The axis of the shortest edge of a plate or a beam's side; nothing for bars and cubes.
  std::optional<int> thin_axis(PartIndex part) const;
  /// The axis along which a bar, as thick as it is wide, runs.
  std::optional<int> bar_axis(PartIndex part) const;
  /// Whether it was turned on a lathe, upright, as far as boxes and rings can tell.
  bool is_round(PartIndex part) const;

  /// A plate across the axis of an upright ring of parts: it may be a ring itself, whose thickness a box does not tell.
  bool may_be_ring(PartIndex part) const;

  /// Its lower end rests on the floor or on another part.
  bool stands(PartIndex part) const;
  /// It does not stand, and its upper end is joined to what is above it.
  bool hangs(PartIndex part) const;
  /// The end along the axis (-1 or 1) at which all its joints are; 0 when they are elsewhere as well.
  /// `near`: of half its length from its middle, and more is at an end.
  int joined_end(PartIndex part, int axis, double near = 0.6) const;
  /// The end at which it is held: where its joints are but for those with what is inside it or carried by it.
  int held_end(PartIndex part, int axis, double near = 0.6) const;
  /// What carries it on the floor: an upright part below, the first of several.
  std::optional<PartIndex> support(PartIndex part) const;
  /// The part that sets the whole's width (0) or depth (2). `close`: one that may as well, if there is one.
  std::optional<PartIndex> setting(int axis, std::optional<PartIndex>* close = nullptr) const;
  /// The upright part that sets the whole's height. Nothing when several, or none, may be meant.
  std::optional<PartIndex> upright() const;
  /// Parts that are joined to the rest by these alone, or by others that are.
  std::vector<PartIndex> carried_by(const std::vector<PartIndex>& parts) const;
  /// Which way is out for a part: the horizontal axis and side on which it is nearest to the whole's outside.
  std::pair<int, int> outward(PartIndex part) const;
  /// Which way a drawer goes: to the front where nothing larger that it is joined to is before it, else outwards.
  std::pair<int, int> opening(PartIndex part) const;

  /// The side (1 left, -1 right) on which a door hangs: across from its handle, else away from the whole's middle.
  int hinge(PartIndex door) const;

  /// Mirror images of one another, directly or by others; each set in the shape's order.
  std::vector<std::vector<PartIndex>> mirrored(const std::vector<PartIndex>& parts) const;
  /// Reflections about planes across the axes of those that link a part of the list to one beyond it.
  std::vector<RelationIndex> reflections_leaving(const std::vector<PartIndex>& parts) const;
  std::vector<RelationIndex> reflections_across(int axis) const;

 private:
  struct Joint {
    PartIndex other;
    PartBox at;
  };
  int joined_end(PartIndex part, int axis, double near, const std::vector<PartIndex>& others) const;
  const Shape& shape_;
  std::vector<PartIndex> active_;
  std::vector<RelationIndex> relations_;
  std::vector<std::vector<Joint>> joints_;  ///< by part
  PartBox whole_;
};

/// The global axis that a unit vector is most along.
int main_axis_of(const Vec3& direction);

}  // namespace parsel
