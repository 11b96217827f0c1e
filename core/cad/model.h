// A CAD program, flattened: parts along the axes with literal numbers, and how they are combined.
//
// Frame: glTF's (+Y up, front towards +Z, own left +X), in the program's own unit. OpenSCAD's point (x, y, z) is
// (x, z, -y) here: its up is +z and its front view looks along +y.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/result.h"

namespace parsel::cad {

/// Of a program's text, both from 1, columns in characters; line 0 is nowhere.
struct Place {
  int line = 0, column = 0;
  bool operator==(const Place&) const = default;
};
std::string to_string(const Place& place);

/// `opaque` stands for something that has a known box but no parameters of its own; it is drawn as the box.
enum class Kind { box, cylinder, cone, sphere, opaque };

/// What a part does to the solid: it belongs to it, is taken away from it, or limits it.
enum class Role { add, cut, meet };

struct Part {
  std::string id;     ///< unique, as core/shape would name a part of this label and place
  std::string label;  ///< from a comment, a module or the kind: not unique
  std::string name;   ///< for people
  Kind kind = Kind::box;
  int axis = 1;                ///< cylinder, cone: of revolution
  int towards = 1;             ///< cone: the side of the axis on which its top lies, -1 or 1
  Vec3 centre = Vec3::Zero();  ///< of the box that size spans; of a cone: of its base's section along its height
  Vec3 size = Vec3::Ones();    ///< > 0; cylinder, cone: base diameters across the axis, height along it
  double top =
      0;  ///< cone: its top's diameter along axis (axis + 1) % 3, ≥ 0; along the third in the base's proportion
  int sides = 0;  ///< cylinder, cone: 0 round, else of the regular polygon inscribed in the diameters
  int phase = 0;  ///< of the polygon's first corner, in quarter turns from (axis + 1) % 3 about the axis
  std::array<double, 4> colour{0, 0, 0, 0};  ///< sRGB and opacity in [0, 1]; opacity 0: none given
  Role role = Role::add;
  Place place;                         ///< of the statement that made it
  std::array<Place, 3> size_places;    ///< of the literals that its size comes from, by axis; line 0: computed
  std::array<Place, 3> centre_places;  ///< … and of the last translation along that axis
};

/// Lowest and highest coordinate along each axis of the part's bounding box relative to its centre.
struct Extent {
  Vec3 low, high;
};
Extent extent(const Part& part);

/// How parts are combined: a leaf names a part.
struct Node {
  enum class Op { leaf, unite, subtract, intersect };
  Op op = Op::unite;
  std::size_t part = 0;
  std::vector<Node> children;
};

/// A variable that the program offers to OpenSCAD's Customizer with a range.
struct CustomizerRange {
  std::string name, section;
  double value = 0, min = 0, step = 0, max = 0;  ///< step 0: none given
  Place place;
};

struct Notice {
  Place place;
  std::string text;
};

struct Model {
  std::string name;
  std::string unit = "mm";  ///< a word for people; "mm" and "m" are known to writers of glTF, which counts in metres
  std::vector<Part> parts;
  Node tree;  ///< every part is in it exactly once, in order
  std::vector<CustomizerRange> ranges;
  std::vector<Notice> echoes, warnings;

  bool is_plain_union() const;
  const Part* find(std::string_view id) const;
};

/// What a program may hold.
struct Limits {
  static constexpr std::size_t bytes = std::size_t{1} << 20;  ///< of source text: 2,000 parts take 0.2 MB
  static constexpr std::size_t parts = 2'000;                 ///< as many as a shape
  static constexpr std::size_t steps = 500'000;               ///< of the interpreter: well under a second
  static constexpr std::size_t depth = 1'000;                 ///< nested calls and expressions, for the stack's sake
  static constexpr std::size_t nesting = 300;                 ///< of brackets, statements and operators in the text
  static constexpr std::size_t notices = 100;                 ///< kept echoes, and kept warnings
  static constexpr double coordinate = 1e6;
};

/// The label without direction words, as parts that belong together share it: "leg" of "left front leg".
std::string stem(const Part& part);

/// Gives ids and names from labels and places, and roles from the tree. Labels are cleaned first.
void name_and_place(Model& model);

/// Finite numbers within Limits, positive sizes, unique ids, a tree that holds every part once.
Status validate(const Model& model);

std::string_view to_string(Kind kind);
std::string_view to_string(Role role);

/// Format `parsel/cad` v1, canonical: the same model gives the same bytes. {"format","version","name","unit","parts":
/// [{"id","label","name","kind","axis"?:"x|y|z" with a sign for a cone,"centre":[3],"size":[3],"top"?,"sides"?,
/// "phase"?,"colour"?:[4],"role","place"?:[line, column],"places"?:{"size":[3×[2]],"centre":[3×[2]]}}],"tree"?:nested
/// ["union"|"difference"|"intersection", part id or list…] unless it is a plain union of the parts in order,"ranges"?,
/// "warnings"?}
nlohmann::json to_json(const Model& model);
/// Error place is a JSON pointer.
Result<Model> model_from_json(const nlohmann::json& json);

/// A flat OpenSCAD program of literal numbers, canonical: reading it gives the same model but for places.
std::string to_scad(const Model& model);

}  // namespace parsel::cad
