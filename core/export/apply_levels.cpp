#include "core/export/apply_levels.h"

#include <algorithm>

#include "core/gltf/primitive.h"

namespace parsel::apply {
namespace {

using gltf::File;

/// What the level's primitive `i` is edited as; null when nothing says.
const Slot* slot_like(const NodeEdit& edit, std::size_t primitives, std::size_t i) {
  const auto is_part = [](const Slot& s) { return s.is_part && s.keep; };
  if (edit.slots.size() == primitives) return is_part(edit.slots[i]) ? &edit.slots[i] : nullptr;
  const auto only = std::find_if(edit.slots.begin(), edit.slots.end(), is_part);
  const auto parts = std::count_if(edit.slots.begin(), edit.slots.end(), is_part);
  return parts == 1 ? &*only : nullptr;
}

/// The edit of a level's mesh; none when a primitive of it cannot follow.
std::optional<NodeEdit> edit_like(const File& file, const NodeEdit& edit, std::size_t level) {
  const gltf::Node& node = file.original.nodes[level];
  if (!node.mesh || *node.mesh >= file.original.meshes.size() || node.skinned || node.instanced) return std::nullopt;
  const std::vector<gltf::Primitive>& primitives = file.original.meshes[*node.mesh].primitives;
  NodeEdit out;
  out.node = level;
  out.mesh = *node.mesh;
  out.rest_world = Eigen::Affine3d::Identity();
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const Slot* like = slot_like(edit, primitives.size(), i);
    if (like == nullptr || !gltf::has_positions(file.original, primitives[i])) return std::nullopt;
    out.slots.push_back(*like);
    out.slots.back().samples.clear();
  }
  return out;
}

}  // namespace

void add_levels(File& file, gltf::Scene& scene, const Frame& frame, const std::vector<CarriedLevels>& carried,
                std::vector<NodeEdit>& edits, std::vector<Warning>& warnings) {
  if (carried.empty()) return;
  const std::vector<NodeEdit> before = edits;
  std::vector<bool> done(scene.size(), false);
  for (const CarriedLevels& of : carried) {
    const auto edit = std::find_if(before.begin(), before.end(), [&](const NodeEdit& e) { return e.node == of.node; });
    const bool changes = edit != before.end() &&
                         std::any_of(edit->slots.begin(), edit->slots.end(), [](const Slot& s) { return s.moves; });
    for (const std::size_t level : file.original.nodes[of.node].levels) {
      if (level >= file.original.nodes.size() || scene.shown[level] || done[level]) continue;
      done[level] = true;
      const auto stays = [&] {
        warnings.push_back({"node " + std::to_string(level),
                            "this lower level of detail stays as it was: it is not built like its node"});
      };
      const gltf::Transform rest = file.original.nodes[level].transform;
      const bool placed = of.by.matrix() != Eigen::Matrix4d(Eigen::Matrix4d::Identity());
      if (!rest.sound || (placed && !set_local_transform(*file.find_item("nodes", level), of.by * rest.affine()))) {
        stays();
        continue;
      }
      if (!changes) continue;
      scene.world[level] = scene.parent_world(of.node) * of.by * rest.affine();
      auto like = edit_like(file, *edit, level);
      if (like) {
        like->rest_world = of.rest_parent * rest.affine();
        const bool possible = std::all_of(like->slots.begin(), like->slots.end(), [&](const Slot& s) {
          return make_cage_map(frame, s.rest, like->rest_world, s.shown, scene.world[level], s.moves).has_value();
        });
        if (!possible) like.reset();
      }
      if (like) {
        edits.push_back(std::move(*like));
      } else {
        stays();
      }
    }
  }
}

}  // namespace parsel::apply
