#include "core/export/apply.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/export/apply_carry.h"
#include "core/export/apply_morph.h"
#include "core/export/apply_nodes.h"
#include "core/export/apply_sweep.h"
#include "core/export/apply_vertices.h"

namespace parsel {
namespace {

using gltf::JsonText;

void warn_of_missing_images(const gltf::File& file, std::vector<Warning>& warnings) {
  for (std::size_t i = 0; i < file.size("images"); ++i) {
    const auto uri = file.item("images", i).get("uri").string();
    if (!uri || gltf::is_data_uri(*uri)) continue;
    warnings.push_back({"image " + std::to_string(i), "it stays outside of the file: " + *uri});
  }
}

/// Nodes that only the animation shows start invisible.
void hide(gltf::File& file, const std::vector<apply::NodeEdit>& edits) {
  for (const apply::NodeEdit& edit : edits) {
    const bool hidden =
        std::any_of(edit.slots.begin(), edit.slots.end(), [](const apply::Slot& s) { return s.keep; }) &&
        std::all_of(edit.slots.begin(), edit.slots.end(), [](const apply::Slot& s) { return !s.keep || s.hidden; });
    JsonText* node = file.find_item("nodes", edit.node);
    if (hidden && !node->has("matrix")) node->set("scale", JsonText(nlohmann::ordered_json{0, 0, 0}));
  }
}

}  // namespace

Result<Applied> apply_state(std::string_view bytes, const Shape& shape, const State& state,
                            const ApplyOptions& options) {
  for (const PartIndex p : options.only_parts) PARSEL_ASSERT(p.value() < shape.parts.size(), "no part of this shape");
  PARSEL_ASSERT(!options.sweep || options.sweep->samples.size() >= 2, "a sweep has two ends");
  PARSEL_ASSERT(!options.sweep || options.poses.empty(), "either an animation or morph targets");
  auto read = gltf::read_file(bytes, options.external);
  if (!read) return read.error();
  gltf::File file = std::move(read).value();
  auto scene = gltf::read_scene(file.original);
  if (!scene) return scene.error();

  Applied out;
  auto edits = apply::plan_nodes(file, *scene, shape, state, options, out.warnings);
  if (!edits) return edits.error();
  apply::carry_nodes(file, *scene, shape.frame, edits->nodes, out.warnings);
  std::vector<apply::Track> tracks;
  if (options.sweep) {
    tracks = apply::plan_tracks(file, *scene, shape.frame, edits->nodes, out.warnings);
    if (tracks.empty())
      out.warnings.push_back({"animation " + options.sweep->name, "nothing moves, so it is left out"});
  }
  const bool morphs = apply::plan_targets(file, options.poses, edits->nodes, out.warnings);
  if (file.original.container.is_glb && !edits->any && tracks.empty() && !morphs) {
    out.glb = std::string(bytes);
    return out;
  }
  apply::remove_nodes(file, *scene, edits->nodes, out.warnings);
  const apply::MeshEdits meshes = apply::assign_meshes(file, *scene, shape.frame, edits->nodes);
  if (Status s = apply::write_vertices(file, meshes, out.warnings); !s.ok()) return s.error();
  if (morphs) apply::describe_targets(file, meshes, out.warnings);
  if (options.sweep) {
    apply::write_animation(file, options.sweep->name, options.sweep->seconds, tracks);
    hide(file, edits->nodes);
  }
  gltf::embed(file, options.external);
  warn_of_missing_images(file, out.warnings);
  auto glb = gltf::write_glb(std::move(file));
  if (!glb) return glb.error();
  out.glb = std::move(glb).value();
  return out;
}

}  // namespace parsel
