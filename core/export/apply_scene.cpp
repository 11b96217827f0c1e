#include "core/export/apply_scene.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace parsel::gltf {
namespace {

using nlohmann::ordered_json;

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

Transform transform_of(const JsonText& node) {
  return read_transform(nlohmann::json::parse(node.text()));
}

bool set_local_transform(JsonText& node, const Eigen::Affine3d& local) {
  const Transform before = transform_of(node);
  const Eigen::Affine3d old = before.affine();
  const double size = std::max(old.linear().cwiseAbs().maxCoeff(), 1e-150);
  const bool same_linear = (local.linear() - old.linear()).cwiseAbs().maxCoeff() <= 1e-12 * size;
  if (node.has("matrix")) {
    if (!same_linear && !decompose(local, Vec3(local.linear().determinant() < 0 ? -1 : 1, 1, 1))) return false;
    node.set("matrix", json_of(Eigen::Map<const Eigen::Matrix<double, 16, 1>>(local.matrix().data())));
    return true;
  }
  if (!same_linear) {
    const auto after = decompose(local, before.placement.scale);
    if (!after) return false;
    node.set("rotation", json_of(after->rotation.coeffs()));
    if (!after->scale.isApprox(before.placement.scale, 1e-9)) node.set("scale", json_of(after->scale));
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
  scene.world.push_back(scene.parent_world(index) * transform_of(file.item("nodes", index)).affine());
  scene.shown.push_back(scene.shown[sibling]);
  scene.hidden.push_back(scene.hidden[sibling]);
  scene.order.push_back(index);
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
  if (wanted.digits == 0) wanted = {name + "_", 1, 1};
  for (std::size_t n = 0; n < file.size("nodes"); ++n) {
    const NumberedName other = split_number(file.item("nodes", n).get("name").string().value_or(""));
    if (other.stem == wanted.stem && other.digits > 0) wanted.number = std::max(wanted.number, other.number);
  }
  std::string digits = std::to_string(wanted.number + 1);
  if (digits.size() < wanted.digits) digits.insert(0, wanted.digits - digits.size(), '0');
  return wanted.stem + digits;
}

}  // namespace parsel::gltf
