// What becomes of one element of a vertex attribute.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/export/apply_cage.h"
#include "core/export/apply_file.h"

namespace parsel::apply {

using Vec4 = Eigen::Vector4d;

enum class Role { untouched, position, normal, tangent, target_position, target_normal, target_tangent };

/// What to do with the elements of an accessor. Other accessors that it takes are named by index.
struct Change {
  Role role = Role::untouched;
  const CageMap* map = nullptr;
  std::optional<std::size_t> position, base, target_position;  ///< base: the normal or tangent that a delta adds to

  /// Whether both make the same of every element.
  bool agrees(const Change& other) const;
};

/// The accessors as they came, decoded once.
class Source {
 public:
  explicit Source(const gltf::Document& document) : document_(document) {}

  /// Error: as gltf::read_accessor(). The other functions are for what has been loaded.
  Status load(std::size_t accessor);
  std::size_t components(std::size_t accessor) const { return values_.at(accessor).first; }
  std::size_t count(std::size_t accessor) const { return values_.at(accessor).second.size() / components(accessor); }
  /// Missing components are 0.
  Vec4 element(std::size_t accessor, std::size_t i) const;

 private:
  const gltf::Document& document_;
  std::map<std::size_t, std::pair<std::size_t, std::vector<double>>> values_;
};

/// Element i of the accessor after the change.
Vec4 changed(const Source& source, const Change& change, std::size_t accessor, std::size_t i);

}  // namespace parsel::apply
