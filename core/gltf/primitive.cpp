#include "core/gltf/primitive.h"

#include <algorithm>

#include "core/base/text.h"
#include "core/gltf/accessor.h"

namespace parsel::gltf {
namespace {

bool has_view(const Document& document, std::size_t accessor) {
  return accessor < document.accessors.size() && document.accessors[accessor].view.has_value();
}

/// Whether all that Draco compressed is there uncompressed as well.
bool has_plain_copy(const Document& document, const Primitive& primitive) {
  const auto plain = [&](const auto& entry) { return has_view(document, entry.second); };
  return std::all_of(primitive.attributes.begin(), primitive.attributes.end(), plain) &&
         (!primitive.indices || has_view(document, *primitive.indices));
}

/// The accessors without which there is no mesh.
std::vector<std::size_t> needed(const Primitive& primitive) {
  std::vector<std::size_t> out;
  const auto position = primitive.attributes.find("POSITION");
  if (position != primitive.attributes.end()) out.push_back(position->second);
  if (primitive.indices) out.push_back(*primitive.indices);
  return out;
}

/// What hinders an accessor from being read as vectors beside the positions; empty when nothing does.
std::string hindrance(const Document& document, std::size_t accessor, std::size_t components, std::size_t count) {
  if (std::string why = out_of_reach(document, accessor); !why.empty()) return why;
  if (const Status sound = check_accessor(document, accessor); !sound.ok()) {
    return sound.error().place + ": " + sound.error().cause;
  }
  const Accessor& entry = document.accessors[accessor];
  if (entry.components != components) {
    return "accessor " + std::to_string(accessor) + ": it is not of type VEC" + std::to_string(components);
  }
  if (entry.count != count) {
    return "accessor " + std::to_string(accessor) + ": it has " + std::to_string(entry.count) +
           " elements, POSITION has " + std::to_string(count);
  }
  return "";
}

}  // namespace

std::string unreadable(const Document& document, const Primitive& primitive) {
  if (primitive.has_draco && !has_plain_copy(document, primitive)) {
    return "it is compressed with " + std::string(draco) + ", which is not read here";
  }
  for (const std::size_t accessor : needed(primitive)) {
    if (std::string why = out_of_reach(document, accessor); !why.empty()) return why;
  }
  return "";
}

bool is_compressed(const Document& document, const Primitive& primitive) {
  const std::vector<std::size_t> accessors = needed(primitive);
  return primitive.has_draco || std::any_of(accessors.begin(), accessors.end(), [&](std::size_t accessor) {
           if (!has_view(document, accessor)) return false;
           const std::size_t view = *document.accessors[accessor].view;
           return view < document.views.size() && document.views[view].meshopt;
         });
}

std::vector<LostAttribute> lost_attributes(const Document& document, const Primitive& primitive) {
  std::vector<LostAttribute> lost;
  const auto position = primitive.attributes.find("POSITION");
  if (position == primitive.attributes.end()) return lost;
  const std::size_t count = accessor_count(document, position->second);
  std::set<std::string> lost_bases;
  const auto look = [&](const Attributes& attributes, std::optional<std::size_t> target) {
    for (const char* name : {"POSITION", "NORMAL", "TANGENT"}) {
      const auto found = attributes.find(name);
      if (found == attributes.end()) continue;
      const bool is_position = std::string_view(name) == "POSITION";
      if (!target && is_position) continue;
      // A target's normals are differences to the primitive's own: without these there is nothing to change.
      if (target && !is_position && primitive.attributes.count(name) == 0) continue;
      std::string why =
          hindrance(document, found->second, !target && std::string_view(name) == "TANGENT" ? 4 : 3, count);
      if (why.empty() && target && lost_bases.count(name) > 0) why = "so does the " + std::string(name) + " it adds to";
      if (why.empty()) continue;
      if (!target) lost_bases.insert(name);
      const std::string of = target ? " of morph target " + std::to_string(*target) : "";
      lost.push_back({{target, name}, "its " + std::string(name) + of + " stays as it is when it is edited: " + why});
    }
  };
  look(primitive.attributes, std::nullopt);
  for (std::size_t t = 0; t < primitive.targets.size(); ++t) look(primitive.targets[t], t);
  return lost;
}

bool has_positions(const Document& document, const Primitive& primitive) {
  const auto position = primitive.attributes.find("POSITION");
  return position != primitive.attributes.end() && unreadable(document, primitive).empty() &&
         hindrance(document, position->second, 3, accessor_count(document, position->second)).empty();
}

bool can_morph(const Document& document, const Mesh& mesh) {
  return std::all_of(mesh.primitives.begin(), mesh.primitives.end(), [&](const Primitive& primitive) {
    return primitive.targets.empty() && has_positions(document, primitive);
  });
}

}  // namespace parsel::gltf
