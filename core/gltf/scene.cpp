#include "core/gltf/scene.h"

#include "core/gltf/refusal.h"

namespace parsel::gltf {
namespace {

std::vector<std::size_t> roots_of(const Document& document) {
  if (document.roots) return *document.roots;
  std::vector<bool> is_child(document.nodes.size(), false);
  for (const Node& node : document.nodes) {
    for (const std::size_t child : node.children) {
      if (child < is_child.size()) is_child[child] = true;
    }
  }
  std::vector<std::size_t> roots;
  for (std::size_t n = 0; n < is_child.size(); ++n) {
    if (!is_child[n]) roots.push_back(n);
  }
  return roots;
}

}  // namespace

Eigen::Affine3d Scene::parent_world(std::size_t node) const {
  return parent[node] ? world[*parent[node]] : Eigen::Affine3d::Identity();
}

Result<Scene> read_scene(const Document& document) {
  const std::size_t count = document.nodes.size();
  Scene scene;
  scene.index = document.scene;
  scene.parent.resize(count);
  scene.children.resize(count);
  scene.world.assign(count, Eigen::Affine3d::Identity());
  scene.shown.assign(count, false);
  scene.hidden.assign(count, false);
  // Depth first, without recursion: the depth of the graph is the file's to choose.
  std::vector<std::size_t> stack;
  const auto push = [&](const std::vector<std::size_t>& nodes, std::optional<std::size_t> parent) -> Status {
    for (auto n = nodes.rbegin(); n != nodes.rend(); ++n) {
      const std::string place = "node " + std::to_string(*n);
      if (*n >= count) return refused(place, "it does not exist but is referred to");
      if (scene.shown[*n]) return refused(place, "it occurs twice in the scene, or contains itself");
      const Node& node = document.nodes[*n];
      if (!node.transform.sound) {
        return refused(place, "its rotation is not a quaternion of length 1, or its transform is not finite");
      }
      scene.shown[*n] = true;
      scene.parent[*n] = parent;
      scene.hidden[*n] = !node.visible || (parent && scene.hidden[*parent]);
      scene.world[*n] = scene.parent_world(*n) * node.transform.affine();
      stack.push_back(*n);
    }
    if (parent) scene.children[*parent] = nodes;
    return success();
  };
  if (Status s = push(roots_of(document), std::nullopt); !s.ok()) return s.error();
  while (!stack.empty()) {
    const std::size_t n = stack.back();
    stack.pop_back();
    scene.order.push_back(n);
    if (Status s = push(document.nodes[n].children, n); !s.ok()) return s.error();
  }
  return scene;
}

std::string why_fixed(const Document& document, const Scene& scene, std::size_t node) {
  if (document.nodes[node].skinned) return "it is bound to a skeleton";
  if (document.nodes[node].instanced) return "its node is GPU-instanced";
  if (!independent_columns(scene.world[node].linear())) return "the transform of its node is too flat";
  return "";
}

}  // namespace parsel::gltf
