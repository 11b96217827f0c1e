// Symmetry relations among parts of one label. ParSEL, supplement §3.1.1 and §3.3.
//
// Parts are compared when their labels agree after direction words are stripped (grouping_key). What agrees is then
// verified on the surfaces: samples of one part, carried over, lie on the other's triangles, and the other way round.
//
// Rules, in this order:
//   1. Rotation: at least three congruent parts on a circle at equal angles (closed loop), each the turned image of the
//      first. The axis is a global axis, or the normal of the parts' common plane.
//      Four parts are a rotation only when they point along the radius (the blades of a fan, the feet of a star base)
//      or when they are not mirror images of each other; four legs at the corners of a table, or four rails along its
//      edges, are reflections, because widening the table keeps those and breaks a rotation.
//   2. Translation: at least three congruent parts at equal distances on a line; the longest line first. A line that is
//      not along a global axis (a stair, a leaning ladder) counts only when no other line crosses it: five legs, one of
//      them in the middle, are no two diagonals.
//      A part is in at most one translation or rotation group; there are no groups of groups.
//   3. Reflection about planes x, y or z = constant, pair by pair. For each kind and axis, the middle plane of the
//      shape takes what it pairs; parts in line with each other of which it pairs none are paired about their own middle when
//      all of them have an image there. Parts of one group are not paired with each other; two groups are paired when
//      all their instances are, about one plane; a pair of an instance and a part of no group counts once an edit
//      dissolves the group.
// Parts are of one kind when their grouping keys are equal. What nothing ties then is looked at once more for mirror
// images among parts of one size whose keys differ by little (alike()): "lega" and "legb", "side" and "sideboard".
#pragma once

#include <string>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/index.h"
#include "core/shape/hexahedron.h"
#include "core/shape/part.h"
#include "core/shape/symmetry_options.h"

namespace parsel {

/// Part b is the image of part a about the plane `coordinate[axis] = offset`; a < b.
struct MirrorPair {
  PartIndex a, b;
  int axis;
  double offset;
};

/// Instance k is instance 0 translated by k · delta (translation) or turned by k · 2π/n about the axis (rotation).
struct SymmetryGroup {
  enum class Kind { translation, rotation };
  Kind kind = Kind::translation;
  std::vector<PartIndex> parts;
  Vec3 delta = Vec3::Zero();
  Vec3 centre = Vec3::Zero(), axis = Vec3::Zero();
};

struct Symmetries {
  std::vector<SymmetryGroup> groups;
  std::vector<MirrorPair> mirrors;
};

/// `keys` are grouping keys, `boxes` oriented boxes of the parts. Deterministic.
Symmetries find_symmetries(const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes,
                           const PartData<std::string>& keys, const SymmetryOptions& options = {});

/// The mirror image of a hexahedron about coordinate[axis] = offset, its local axis `axis` reversed so that it stays
/// right-handed: corner k is the image of corner k ^ (1 << axis).
Hexahedron mirrored(const Hexahedron& hexahedron, int axis, double offset);

/// Makes the boxes of parts that are tied by symmetry exact images of each other, starting from the first of each set.
PartData<Hexahedron> align_boxes(const PartData<Hexahedron>& boxes, const Symmetries& symmetries);

}  // namespace parsel
