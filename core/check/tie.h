// The checker's own measure of how far a relation is off; see core/prove/deviation.h for the rules.
#pragma once

#include <array>
#include <vector>

#include "core/check/replay.h"

namespace parsel::replay {

/// A relation, to be measured in many scenes.
class Tie {
 public:
  Tie(const Shape& shape, RelationIndex index);

  RelationIndex index() const { return index_; }
  const Relation& relation() const { return *relation_; }
  /// Whether its parts are there: instances of a group are not once their number has changed.
  bool exists(const Scene& scene) const;
  /// Largest deviation of a coordinate from the relation's constraint; 0 when it does not exist.
  double off(const Scene& scene) const;

 private:
  /// A point that two parts share: its weights in both, and how far apart it lies in them at rest.
  struct Joint {
    std::array<double, 8> in_a, in_b;
    Vec3 rest;
    Vec3 between(const Box& a, const Box& b) const;
  };
  /// A point of a foot: its weights in its part, and its height at rest.
  struct Foot {
    std::array<double, 8> in;
    double rest;
    double height(const Box& part) const;
  };

  RelationIndex index_;
  const Relation* relation_;
  std::vector<RelationIndex> instances_of_;
  std::vector<Joint> joints_;
  std::vector<Foot> feet_;
};

}  // namespace parsel::replay
