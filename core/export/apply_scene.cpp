#include "core/export/apply_scene.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace parsel::gltf {
namespace {

using nlohmann::ordered_json;

Error refusal(std::size_t node, std::string cause) {
  return {"edit/apply_scene", "node " + std::to_string(node), std::move(cause), "export the file again"};
}

template <int N>
std::optional<Eigen::Matrix<double, N, 1>> numbers(const JsonText& json) {
  if (json.size() != N) return std::nullopt;
  Eigen::Matrix<double, N, 1> out;
  for (int i = 0; i < N; ++i) out[i] = json.item(static_cast<std::size_t>(i)).number().value_or(std::nan(""));
  return out;
}

template <class Vector>
JsonText json_of(const Vector& vector) {
  ordered_json json = ordered_json::array();
  for (Eigen::Index i = 0; i < vector.size(); ++i) json.push_back(vector[i]);
  return JsonText(json);
}

void remove_indices(JsonText& owner, const char* key, const std::set<std::size_t>& removed) {
  JsonText* list = owner.find(key);
  if (list == nullptr || !list->is_array()) return;
  const std::size_t before = list->size();
  for (std::size_t i = list->size(); i-- > 0;) {
    const auto index = list->item(i).index();
    if (index && removed.count(*index) > 0) list->erase_at(i);
  }
  if (list->size() == 0 && before > 0) owner.erase(key);  // glTF forbids empty lists
}

/// A name without its number: {"slat_", 2 digits, 7} of "slat_07".
struct NumberedName {
  std::string stem;
  std::size_t digits = 0;
  std::size_t number = 0;
};

NumberedName split_number(const std::string& name) {
  std::size_t at = name.size();
  while (at > 0 && name[at - 1] >= '0' && name[at - 1] <= '9' && name.size() - at < 9) --at;
  NumberedName out{name.substr(0, at), name.size() - at, 0};
  if (out.digits > 0) out.number = std::stoul(name.substr(at));
  return out;
}

}  // namespace

Eigen::Affine3d Scene::parent_world(std::size_t node) const {
  return parent[node] ? world[*parent[node]] : Eigen::Affine3d::Identity();
}

Result<Scene> read_scene(const File& file) {
  Scene scene;
  const std::size_t count = file.size("nodes");
  scene.index = file.json.get("scene").index().value_or(0);
  scene.parent.resize(count);
  scene.children.resize(count);
  scene.world.resize(count);
  scene.shown.assign(count, false);
  for (std::size_t n = 0; n < count; ++n) {
    const JsonText& children = file.item("nodes", n).get("children");
    for (std::size_t i = 0; i < children.size(); ++i) {
      const auto child = children.item(i).index();
      if (!child || *child >= count) return refusal(n, "one of its children does not exist");
      if (scene.parent[*child] || *child == n) return refusal(*child, "it is a child more than once");
      scene.parent[*child] = n;
      scene.children[n].push_back(*child);
    }
  }
  // With one parent each, a walk from the roots reaches all nodes unless some are in a cycle.
  std::vector<std::size_t> pending;
  for (std::size_t n = 0; n < count; ++n) {
    if (!scene.parent[n]) pending.push_back(n);
  }
  for (std::size_t i = 0; i < pending.size(); ++i) {
    const std::size_t n = pending[i];
    scene.world[n] = scene.parent_world(n) * local_transform(file.item("nodes", n));
    if (!scene.world[n].matrix().allFinite()) return refusal(n, "its transform is not made of finite numbers");
    pending.insert(pending.end(), scene.children[n].begin(), scene.children[n].end());
  }
  if (pending.size() != count) return Error{"edit/apply_scene", "nodes", "a node is its own ancestor", "export again"};
  if (file.size("scenes") == 0) {
    for (std::size_t n = 0; n < count; ++n) scene.shown[n] = !scene.parent[n];
  }
  const JsonText& roots = file.item("scenes", scene.index).get("nodes");
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const auto root = roots.item(i).index();
    if (!root || *root >= count) return Error{"edit/apply_scene", "scene", "a root does not exist", "export again"};
    if (scene.parent[*root]) return refusal(*root, "it is a root of the scene and a child as well");
    scene.shown[*root] = true;
  }
  for (const std::size_t n : pending) {  // parents come before their children
    if (scene.parent[n] && scene.shown[*scene.parent[n]]) scene.shown[n] = true;
  }
  return scene;
}

Eigen::Affine3d Placement::matrix() const {
  Eigen::Affine3d out = Eigen::Affine3d::Identity();
  out.linear() = rotation.toRotationMatrix() * scale.asDiagonal();
  out.translation() = translation;
  return out;
}

Placement placement(const JsonText& node) {
  Placement out;
  if (const auto t = numbers<3>(node.get("translation"))) out.translation = *t;
  if (const auto s = numbers<3>(node.get("scale"))) out.scale = *s;
  if (const auto r = numbers<4>(node.get("rotation"))) {
    if (r->norm() > 1e-12) out.rotation = Eigen::Quaterniond((*r)[3], (*r)[0], (*r)[1], (*r)[2]).normalized();
  }
  return out;
}

Eigen::Affine3d local_transform(const JsonText& node) {
  const auto m = numbers<16>(node.get("matrix"));
  if (!m) return placement(node).matrix();
  Eigen::Affine3d out;
  out.matrix() = Eigen::Map<const Eigen::Matrix4d>(m->data());
  out.makeAffine();
  return out;
}

std::optional<Placement> decompose(const Eigen::Affine3d& transform, const Vec3& signs) {
  Placement out;
  out.translation = transform.translation();
  Mat3 axes = transform.linear();
  for (int i = 0; i < 3; ++i) {
    out.scale[i] = axes.col(i).norm() * (signs[i] < 0 ? -1 : 1);
    if (!std::isfinite(out.scale[i]) || std::abs(out.scale[i]) < 1e-150) return std::nullopt;
    axes.col(i) /= out.scale[i];
  }
  if (!((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-6) || axes.determinant() < 0) {
    return std::nullopt;
  }
  out.rotation = Eigen::Quaterniond(axes).normalized();
  return out;
}

bool set_local_transform(JsonText& node, const Eigen::Affine3d& local) {
  const Eigen::Affine3d old = local_transform(node);
  const double size = std::max(old.linear().cwiseAbs().maxCoeff(), 1e-150);
  const bool same_linear = (local.linear() - old.linear()).cwiseAbs().maxCoeff() <= 1e-12 * size;
  if (node.has("matrix")) {
    if (!same_linear && !decompose(local, Vec3(local.linear().determinant() < 0 ? -1 : 1, 1, 1))) return false;
    node.set("matrix", json_of(Eigen::Map<const Eigen::Matrix<double, 16, 1>>(local.matrix().data())));
    return true;
  }
  if (!same_linear) {
    const Placement before = placement(node);
    const auto after = decompose(local, before.scale);
    if (!after) return false;
    node.set("rotation", json_of(after->rotation.coeffs()));
    if (!after->scale.isApprox(before.scale, 1e-9)) node.set("scale", json_of(after->scale));
  }
  node.set("translation", json_of(local.translation()));
  return true;
}

std::size_t add_beside(File& file, Scene& scene, std::size_t sibling, JsonText node) {
  const std::size_t index = file.append("nodes", std::move(node));
  const auto parent = scene.parent[sibling];
  JsonText* owner = parent ? file.find_item("nodes", *parent) : file.find_item("scenes", scene.index);
  const char* key = parent ? "children" : "nodes";
  if (owner != nullptr && owner->is_object()) {
    if (!owner->get(key).is_array()) owner->set(key, JsonText(ordered_json::array()));
    owner->find(key)->push_back(JsonText(index));
  }
  scene.parent.push_back(parent);
  scene.children.emplace_back();
  if (parent) scene.children[*parent].push_back(index);
  scene.world.push_back(scene.parent_world(index) * local_transform(file.item("nodes", index)));
  scene.shown.push_back(scene.shown[sibling]);
  return index;
}

void detach(File& file, Scene& scene, const std::set<std::size_t>& nodes) {
  std::set<std::size_t> parents;
  bool roots = false;
  for (const std::size_t n : nodes) {
    scene.shown[n] = false;
    if (scene.parent[n]) {
      parents.insert(*scene.parent[n]);
    } else {
      roots = true;
    }
  }
  for (const std::size_t p : parents) remove_indices(*file.find_item("nodes", p), "children", nodes);
  if (JsonText* owner = file.find_item("scenes", scene.index); roots && owner != nullptr && owner->is_object()) {
    remove_indices(*owner, "nodes", nodes);
  }
}

std::string numbered_name(const File& file, const std::string& name) {
  NumberedName wanted = split_number(name);
  if (wanted.digits == 0) wanted = {name + ".", 3, 0};
  for (std::size_t n = 0; n < file.size("nodes"); ++n) {
    const NumberedName other = split_number(file.item("nodes", n).get("name").string().value_or(""));
    if (other.stem == wanted.stem && other.digits > 0) wanted.number = std::max(wanted.number, other.number);
  }
  std::string digits = std::to_string(wanted.number + 1);
  if (digits.size() < wanted.digits) digits.insert(0, wanted.digits - digits.size(), '0');
  return wanted.stem + digits;
}

}  // namespace parsel::gltf
