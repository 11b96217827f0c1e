// The structured shape: a graph of parts (hexahedra) and relations. ParSEL §4.1, supplement §3.1.
//
// A shape is immutable once built: edits produce states (core/edit/evaluate.h), never change the shape.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/shape/hexahedron.h"

namespace parsel {

struct Part {
  std::string id;      ///< unique, stable: the label with direction words, `leg_front_left`
  std::string label;   ///< as given in the file, without counters
  std::string name;    ///< for people: "front left leg"
  int node = -1;       ///< glTF node index; -1 for a virtual part
  int primitive = -1;  ///< index of the primitive in the node's mesh; -1 for a virtual part
  Hexahedron hexahedron;
  /// For a virtual part: its instances, in the order of the group. Empty for a real part.
  std::vector<PartIndex> members;
  /// The translation or rotation relation that this part is an instance of, or (virtual part) stands for.
  std::optional<RelationIndex> group;

  bool is_virtual() const { return !members.empty(); }
};

enum class RelationKind { reflection, translation, rotation, point, line, face, volume, ground };

/// parts = {a, b}, mirror images of each other about the plane.
struct Reflection {
  Vec3 origin = Vec3::Zero();   ///< a point of the plane
  Vec3 normal = Vec3::UnitX();  ///< unit, an axis of the normalised frame
  /// Corner k of part b is the mirror image of corner corner_map[k] of part a.
  std::array<int, 8> corner_map = {0, 1, 2, 3, 4, 5, 6, 7};
  /// One above the other: alike in shape, but the floor tells them apart, so a change of height need not mirror.
  bool stacked = false;
};

/// parts = the instances in order, at equal distances. Over-parameterised (supplement §3.2): start, middle (their
/// mean), end, count (number of parts), delta = (end - start) / (count - 1). The points are tied to the virtual parent
/// by their local coordinates in it.
struct Translation {
  PartIndex parent;                               ///< the virtual part
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();  ///< centres of the first and the last instance
  int axis = 0;                                   ///< local axis of the parent that delta is most along
  int direction = 1;                              ///< 1 when delta points along +axis, else -1
  bool touching = false;                          ///< each instance touches the next: what widens one moves the others
};

/// parts = the instances in order of angle, a closed loop: instance k is instance 0 turned by k · 2π/count about the
/// axis (right-handed), corner by corner, so their local axes turn with them.
struct Rotation {
  PartIndex parent;            ///< the virtual part
  Vec3 centre = Vec3::Zero();  ///< on the axis, at the height of the instances' centres
  Vec3 axis = Vec3::UnitY();   ///< unit
  int parent_axis = 1;         ///< local axis of the parent that `axis` is along
  double radius = 0;           ///< distance of the instances' centres from the axis
};

/// Where two parts touch: a rectangle that lies on both surfaces, a line or a point where its half sides are 0. Within
/// it a part may slide along the other without a gap.
struct ContactPatch {
  Vec3 centre = Vec3::Zero();        ///< at rest, in the normalised frame
  Vec3 normal = Vec3::UnitY();       ///< unit, out of part a into part b
  std::array<Vec3, 2> half_sides{};  ///< from the centre to the middle of a side, at right angles to each other
  /// The corners centre ± half_sides[0] ± half_sides[1] in local coordinates of each part; the first sign is that of
  /// bit 0 of the index, the second that of bit 1.
  std::array<Vec3, 4> local_a{}, local_b{};
};

/// A point in which the surfaces of two parts lie against each other.
struct ContactPoint {
  Vec3 point;   ///< at rest, in the normalised frame
  Vec3 normal;  ///< unit, of the larger part's surface
};

/// parts = {a, b}; the same points seen from both.
struct Attachment {
  std::vector<Vec3> points;   ///< 1, 2, 4 or 8 at rest, in the normalised frame
  std::vector<Vec3> local_a;  ///< the same in local coordinates of part a
  std::vector<Vec3> local_b;  ///< … and of part b
  /// None where one part is inside the other, or in a shape of which it is not known.
  std::optional<ContactPatch> patch = std::nullopt;
  /// Of parts whose boxes run into each other, where they do not; see core/shape/contact_points.h.
  std::vector<ContactPoint> contact_points = {};
};

/// parts = {a}; a stands on the floor: these points keep their height. See core/shape/ground.h.
struct Ground {
  std::vector<Vec3> points;  ///< 1, 2 or 4 at rest, in the normalised frame, all at a's lowest height
  std::vector<Vec3> local;   ///< the same in local coordinates of a
};

struct Relation {
  std::string id;
  RelationKind kind;
  std::vector<PartIndex> parts;
  std::variant<Reflection, Translation, Rotation, Attachment, Ground> detail;

  bool is_symmetry() const { return kind <= RelationKind::rotation; }
  bool is_group() const { return kind == RelationKind::translation || kind == RelationKind::rotation; }
  bool is_attachment() const { return kind >= RelationKind::point && kind <= RelationKind::volume; }
};

/// The virtual part of a translation or rotation.
PartIndex parent_of(const Relation& group);

/// Something in the file that was left out or changed, for people to read.
struct Warning {
  std::string place;
  std::string text;
};

struct Shape {
  std::string name;
  std::string sha256;  ///< of the file's bytes, lower-case hex
  Frame frame;
  PartData<Part> parts;
  RelationData<Relation> relations;
  std::vector<Warning> warnings;

  /// By id, or by "node:<glTF node index>".
  std::optional<PartIndex> find_part(std::string_view id) const;
  std::optional<RelationIndex> find_relation(std::string_view id) const;
};

// A shape holds the relations of the instances of a group and those of its virtual parent side by side; which of them
// count depends on whether the group stands or was dissolved (supplement §3.1.2: an edit of one instance dissolves it).
//   * A part is active unless it is an instance of a standing group or the parent of a dissolved one.
//   * A translation or rotation is active while its group stands; it then ties its instances to its parent.
//   * Any other relation is active when all its parts are.
// `dissolved` lists translations and rotations; an empty list means that every group stands.

bool is_active(const Shape& shape, PartIndex part, const std::vector<RelationIndex>& dissolved = {});
bool is_active(const Shape& shape, RelationIndex relation, const std::vector<RelationIndex>& dissolved = {});
std::vector<PartIndex> active_parts(const Shape& shape, const std::vector<RelationIndex>& dissolved = {});
std::vector<RelationIndex> active_relations(const Shape& shape, const std::vector<RelationIndex>& dissolved = {});

std::string_view to_string(RelationKind kind);
std::optional<RelationKind> relation_kind(std::string_view text);

/// Finite numbers, unique ids, non-inverted hexahedra, members and groups that point at each other, relations that hold
/// at rest. Returns the first thing that is wrong.
Status validate(const Shape& shape);

/// Format `parsel/shape` v1.
nlohmann::json to_json(const Shape& shape);
Result<Shape> shape_from_json(const nlohmann::json& json);

}  // namespace parsel
