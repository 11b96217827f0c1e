#include "core/export/apply_mesh.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

namespace parsel::apply {
namespace {

using gltf::File;
using gltf::JsonText;
using Maps = std::vector<std::optional<CageMap>>;  ///< one a slot

struct Variant {
  const NodeEdit* first;  ///< whose slots say which primitives are kept
  Maps maps;
  std::vector<std::size_t> nodes;
};

bool same_variant(const Variant& variant, const NodeEdit& edit, const Maps& maps) {
  if (variant.first->target_names != edit.target_names) return false;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (variant.first->slots[i].keep != edit.slots[i].keep) return false;
    if (variant.maps[i].has_value() != maps[i].has_value()) return false;
    if (maps[i] && !same_map(*variant.maps[i], *maps[i])) return false;
  }
  return true;
}

Maps cage_maps(const gltf::Scene& scene, const Frame& frame, const NodeEdit& edit) {
  Maps maps(edit.slots.size());
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Slot& slot = edit.slots[i];
    if (!slot.keep || (!slot.moves && slot.targets.empty())) continue;
    const Eigen::Affine3d& world = scene.world[edit.node];
    maps[i] = make_cage_map(frame, slot.rest, edit.rest_world, slot.shown, world, slot.moves);
    PARSEL_ASSERT(maps[i].has_value(), "parts that cannot be edited are set aside before");
    for (const Corners& target : slot.targets) add_target(*maps[i], frame, target, world);
  }
  return maps;
}

/// Writes one variant as mesh `index`, whose JSON is still that of the original.
void write_variant(File& file, std::size_t index, const Variant& variant, MeshEdits& out) {
  JsonText* primitives = file.find_item("meshes", index)->find("primitives");
  std::size_t kept = 0;
  for (std::size_t i = 0; i < variant.maps.size(); ++i) {
    if (!variant.first->slots[i].keep) {
      primitives->erase_at(kept);
      continue;
    }
    if (const auto& map = variant.maps[i]) {
      out.maps.emplace(PrimitiveKey{index, kept}, *map);
      if (!map->targets.empty()) out.new_targets[index] = map->targets.size();
    }
    ++kept;
  }
  if (!variant.first->target_names.empty()) out.target_names[index] = variant.first->target_names;
}

}  // namespace

MeshEdits assign_meshes(File& file, const gltf::Scene& scene, const Frame& frame, const std::vector<NodeEdit>& edits) {
  std::map<std::size_t, std::vector<Variant>> variants;  // of each mesh
  std::set<std::size_t> edited;
  for (const NodeEdit& edit : edits) {
    const bool gone = std::none_of(edit.slots.begin(), edit.slots.end(), [](const Slot& s) { return s.keep; });
    const bool filtered = std::any_of(edit.slots.begin(), edit.slots.end(), [](const Slot& s) { return !s.keep; });
    if (gone) {
      edited.insert(edit.node);
      continue;
    }
    Maps maps = cage_maps(scene, frame, edit);
    const bool mapped = std::any_of(maps.begin(), maps.end(), [](const auto& m) { return m.has_value(); });
    if (!filtered && !mapped) continue;
    edited.insert(edit.node);
    std::vector<Variant>& known = variants[edit.mesh];
    auto same = std::find_if(known.begin(), known.end(), [&](const Variant& v) { return same_variant(v, edit, maps); });
    if (same == known.end()) same = known.insert(same, {&edit, std::move(maps), {}});
    same->nodes.push_back(edit.node);
  }

  // A mesh that some node shows unedited stays as it is.
  std::set<std::size_t> taken;
  for (std::size_t n = 0; n < file.size("nodes"); ++n) {
    const auto mesh = file.item("nodes", n).get("mesh").index();
    if (mesh && edited.count(n) == 0) taken.insert(*mesh);
  }
  MeshEdits out;
  for (const auto& [mesh, all] : variants) {
    const JsonText original = file.item("meshes", mesh);
    for (const Variant& variant : all) {
      const std::size_t index = taken.insert(mesh).second ? mesh : file.append("meshes", original);
      write_variant(file, index, variant, out);
      if (index == mesh) continue;
      for (const std::size_t node : variant.nodes) file.find_item("nodes", node)->set("mesh", JsonText(index));
    }
  }
  return out;
}

}  // namespace parsel::apply
