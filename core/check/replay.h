// A second, deliberately plain evaluation of programs, for the independent checker alone.
//
// It shares no code with core/edit beyond the program's data types: amounts are read from their text and evaluated
// while being parsed, operators are the matrices of the supplement's table 2, every query starts from the shape at
// rest. Slow, and meant to be checked by reading. The rules are those written at the top of core/edit/evaluate.h.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel::replay {

using Box = std::array<Vec3, 8>;

struct Group {
  std::vector<Box> instances;
  std::vector<int> source;  ///< for each instance the member of the relation that it is a copy of
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();
  Vec3 centre = Vec3::Zero(), axis = Vec3::Zero();
  double radius = 0;
};

struct Scene {
  std::map<std::string, Box> parts;     ///< by part id
  std::map<std::string, Group> groups;  ///< by relation id
};

/// Value of an amount's text at parameter values by name. NaN where undefined or not readable.
double value_of(const std::string& text, const std::map<std::string, double>& parameters);

/// The shape after the first `layers` layers. The program's parts, relations and fields have been found to exist.
Scene scene_of(const Shape& shape, const Program& program, std::size_t layers,
               const std::map<std::string, double>& parameters);

/// Largest deviation of a coordinate from the relation's constraint.
double deviation_of(const Shape& shape, const Relation& relation, const Scene& scene);

/// Smallest volume at a corner (three edges' determinant), relative to the box at rest.
double smallest_volume(const Box& box, const Box& rest);

Box box_of(const Corners& corners);

}  // namespace parsel::replay
