#include "core/export/apply_morph.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/tolerance.h"
#include "core/export/apply_accessor.h"
#include "core/gltf/primitive.h"

namespace parsel::apply {
namespace {

using gltf::File;
using gltf::JsonText;
using nlohmann::ordered_json;

bool moves_in(const Slot& slot, std::size_t pose) {
  if (!slot.keep || !slot.is_part || slot.samples.empty() || !slot.samples[pose]) return false;
  return (*slot.samples[pose] - slot.shown).cwiseAbs().maxCoeff() > noise;
}

/// A channel of an animation that sets the weights of a node.
struct WeightChannel {
  std::size_t animation = 0, channel = 0, sampler = 0;
};

std::vector<WeightChannel> weight_channels(const File& file, std::size_t node) {
  std::vector<WeightChannel> out;
  for (std::size_t a = 0; a < file.size("animations"); ++a) {
    const JsonText& channels = file.item("animations", a).get("channels");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const JsonText& target = channels.item(c).get("target");
      const auto sampler = channels.item(c).get("sampler").index();
      if (sampler && target.get("node").index() == node && target.get("path").string() == "weights") {
        out.push_back({a, c, *sampler});
      }
    }
  }
  return out;
}

/// The keys of a channel for `old` targets with zeros for further ones; none when they are not what they should be.
std::optional<std::vector<float>> extended_keys(const File& file, const WeightChannel& channel, std::size_t old,
                                                std::size_t added) {
  const JsonText& sampler = file.item("animations", channel.animation).get("samplers").item(channel.sampler);
  const auto input = sampler.get("input").index(), output = sampler.get("output").index();
  if (!input || !output || old == 0) return std::nullopt;
  const auto values = gltf::read_accessor(file.original, *output);
  // A cubic spline has a tangent before and after every key, for all targets each.
  const std::size_t sets = sampler.get("interpolation").string() == "CUBICSPLINE" ? 3 : 1;
  const std::size_t rows = gltf::accessor_count(file.original, *input) * sets;
  if (!values.ok() || values->size() != rows * old) return std::nullopt;
  std::vector<float> out;
  out.reserve(rows * (old + added));
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t t = 0; t < old; ++t) out.push_back(static_cast<float>((*values)[row * old + t]));
    out.insert(out.end(), added, 0.0F);
  }
  return out;
}

/// Whether KHR_animation_pointer sets weights of the object, "/meshes/3" or "/nodes/3".
bool is_pointed_at(const File& file, const std::string& object) {
  for (std::size_t a = 0; a < file.size("animations"); ++a) {
    const JsonText& channels = file.item("animations", a).get("channels");
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const JsonText& extensions = channels.item(c).get("target").get("extensions");
      const auto pointer = extensions.get("KHR_animation_pointer").get("pointer").string();
      if (pointer && pointer->rfind(object + "/weights", 0) == 0) return true;
    }
  }
  return false;
}

/// Why the node's mesh cannot be given further morph targets, a clause; empty when it can.
std::string hindrance(const File& file, const NodeEdit& edit) {
  const std::vector<gltf::Primitive>& primitives = file.original.meshes[edit.mesh].primitives;
  const std::size_t old = primitives[0].targets.size();
  for (const gltf::Primitive& primitive : primitives) {
    if (!gltf::has_positions(file.original, primitive)) return "a primitive of its mesh cannot be read";
    if (primitive.targets.size() != old) return "the primitives of its mesh differ in how many they have";
  }
  if (is_pointed_at(file, "/meshes/" + std::to_string(edit.mesh)) ||
      is_pointed_at(file, "/nodes/" + std::to_string(edit.node))) {
    return "KHR_animation_pointer animates the weights of those that it has";
  }
  for (const WeightChannel& channel : weight_channels(file, edit.node)) {
    if (!extended_keys(file, channel, old, 0)) {
      return "animation " + std::to_string(channel.animation) + " sets weights of another number of them";
    }
  }
  return "";
}

/// Weights for `old` targets, those that are there, and zeros for further ones.
void extend_weights(JsonText& owner, std::size_t old, std::size_t added) {
  if (!owner.get("weights").is_array()) owner.set("weights", JsonText(ordered_json::array()));
  JsonText& weights = *owner.find("weights");
  while (weights.size() > old) weights.erase_at(weights.size() - 1);
  while (weights.size() < old + added) weights.push_back(JsonText(ordered_json(0)));
}

/// False when the mesh has extras that hold no names.
bool extend_names(JsonText& mesh, std::size_t old, const std::vector<std::string>& added) {
  if (!mesh.has("extras")) mesh.set("extras", JsonText(ordered_json::object()));
  JsonText& extras = *mesh.find("extras");
  if (!extras.is_object()) return false;
  ordered_json names = ordered_json::array();
  for (std::size_t t = 0; t < old; ++t) {
    const auto name = extras.get("targetNames").item(t).string();
    names.push_back(name ? *name : "target_" + std::to_string(t));  // as Blender calls them
  }
  for (const std::string& name : added) names.push_back(name);
  extras.set("targetNames", JsonText(names));
  return true;
}

void extend_channels(File& file, std::size_t node, std::size_t old, std::size_t added) {
  for (const WeightChannel& channel : weight_channels(file, node)) {
    const auto keys = extended_keys(file, channel, old, added);
    PARSEL_ASSERT(keys.has_value(), "nodes with other channels were set aside");
    const std::size_t output = gltf::append_accessor(file, {*keys, 1, false, false});
    JsonText* animation = file.find_item("animations", channel.animation);
    JsonText* samplers = animation->find("samplers");
    JsonText sampler = samplers->item(channel.sampler);
    sampler.set("output", JsonText(output));
    samplers->push_back(std::move(sampler));  // others may use the old one
    const std::size_t index = samplers->size() - 1;
    animation->find("channels")->find_item(channel.channel)->set("sampler", JsonText(index));
  }
}

}  // namespace

bool plan_targets(const File& file, const std::vector<Pose>& poses, std::vector<NodeEdit>& edits,
                  std::vector<Warning>& warnings) {
  bool any = false;
  for (NodeEdit& edit : edits) {
    std::vector<std::size_t> shown;
    for (std::size_t p = 0; p < poses.size(); ++p) {
      if (std::any_of(edit.slots.begin(), edit.slots.end(), [&](const Slot& s) { return moves_in(s, p); })) {
        shown.push_back(p);
      }
    }
    if (shown.empty()) continue;
    if (const std::string why = hindrance(file, edit); !why.empty()) {
      warnings.push_back({"node " + std::to_string(edit.node), "it gets no morph targets: " + why});
      continue;
    }
    for (Slot& slot : edit.slots) {
      if (!slot.keep || !slot.is_part || slot.samples.empty()) continue;
      for (const std::size_t p : shown) slot.targets.push_back(*slot.samples[p] - slot.shown);
    }
    for (const std::size_t p : shown) edit.target_names.push_back(poses[p].name);
    any = true;
  }
  return any;
}

void describe_targets(File& file, const MeshEdits& meshes, std::vector<Warning>& warnings) {
  std::map<std::size_t, std::size_t> had;  // by mesh
  for (const auto& [mesh, names] : meshes.target_names) {
    JsonText& json = *file.find_item("meshes", mesh);
    const std::size_t old = json.get("primitives").item(0).get("targets").size() - names.size();
    had[mesh] = old;
    extend_weights(json, old, names.size());
    if (!extend_names(json, old, names)) {
      warnings.push_back({"mesh " + std::to_string(mesh),
                          "its morph targets have no names, as its extras are no object that could hold them"});
    }
  }
  for (std::size_t n = 0; n < file.size("nodes"); ++n) {
    const auto mesh = file.item("nodes", n).get("mesh").index();
    const auto named = mesh ? meshes.target_names.find(*mesh) : meshes.target_names.end();
    if (named == meshes.target_names.end()) continue;
    JsonText& node = *file.find_item("nodes", n);
    if (node.has("weights")) extend_weights(node, had.at(*mesh), named->second.size());
    extend_channels(file, n, had.at(*mesh), named->second.size());
  }
}

}  // namespace parsel::apply
