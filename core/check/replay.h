// A second, deliberately plain evaluation of programs, for the independent checker alone.
//
// It shares no code with core/edit beyond the program's data types: amounts are read from their text and evaluated
// while being parsed, operators are the matrices of the supplement's table 2, every query starts from the shape at
// rest. Meant to be checked by reading: only names are looked up once, and the joints' weights. The rules are those
// written at the top of core/edit/evaluate.h.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel::replay {

using Box = std::array<Vec3, 8>;
using Values = std::map<std::string, double>;  ///< of parameters, by name

struct Group {
  std::vector<Box> instances;
  std::vector<int> source;  ///< for each instance the member of the relation that it is a copy of
  bool recounted = false;   ///< the number of instances has changed
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();
  Vec3 centre = Vec3::Zero(), axis = Vec3::Zero();
  double radius = 0;
};

struct Scene {
  PartData<Box> parts;
  RelationData<Group> groups;  ///< without instances for relations that are no group
};

/// Value of an amount's text at parameter values by name. NaN where undefined or not readable.
double value_of(const std::string& text, const Values& parameters);

/// Runs a program on a shape; both must outlive this object. Whoever asks for a scene has found the program's parts,
/// relations and fields to exist.
class Replay {
 public:
  Replay(const Shape& shape, const Program& program);

  const Shape& shape() const { return *shape_; }
  const Program& program() const { return *program_; }
  /// By id or "node:<n>".
  std::optional<PartIndex> part(const std::string& name) const;
  std::optional<RelationIndex> relation(const std::string& id) const;
  /// The number of an instance in its group.
  std::size_t place(PartIndex instance) const { return places_[instance]; }

  /// What value_of() says of a statement's amount.
  double amount(std::size_t layer, std::size_t statement, const Values& parameters) const;

  Scene rest() const;
  /// The shape after the first `layers` layers.
  Scene scene(std::size_t layers, const Values& parameters) const;
  /// One statement of a layer that began with `start`.
  void run(std::size_t layer, std::size_t statement, const Scene& start, const Values& parameters, Scene& scene) const;

 private:
  const Shape* shape_;
  const Program* program_;
  std::unordered_map<std::string, PartIndex> parts_;
  std::unordered_map<std::string, RelationIndex> relations_;
  PartData<std::size_t> places_;
  std::vector<std::vector<std::string>> texts_;  ///< of the amounts, layer by layer: printing them takes long
};

/// Smallest volume at a corner (three edges' determinant), relative to the box at rest.
double smallest_volume(const Box& box, const Box& rest);

Box box_of(const Corners& corners);

/// Weights of the corners at a point in local coordinates.
std::array<double, 8> blend(const Vec3& u);

}  // namespace parsel::replay
