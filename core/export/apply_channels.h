// The animations that a file already has: which nodes they move, and how they go on when a node gets a new place.
#pragma once

#include <map>
#include <vector>

#include "core/export/apply_file.h"
#include "core/export/apply_scene.h"

namespace parsel::apply {

class Channels {
 public:
  explicit Channels(gltf::File& file);

  /// Whether a channel sets the node's translation, rotation or scale.
  bool moves(std::size_t node) const { return channels_.count(node) > 0; }
  /// Whether a channel turns or scales the node about its origin.
  bool turns(std::size_t node) const;

  /// Lets the node be animated as before, then moved by `by` (in the coordinates of its parent): keys of translations
  /// and rotations are moved along. False, and nothing changed, when `by` is not rigid or keys cannot be read.
  bool move(std::size_t node, const Eigen::Affine3d& by);

 private:
  struct Channel {
    std::size_t animation = 0, channel = 0, sampler = 0;
    std::string path;
  };
  /// The moved keys of a channel; none when they cannot be read.
  std::optional<std::vector<float>> moved_keys(const Channel& channel, const Eigen::Affine3d& by) const;

  gltf::File& file_;
  std::map<std::size_t, std::vector<Channel>> channels_;  ///< by node
};

}  // namespace parsel::apply
