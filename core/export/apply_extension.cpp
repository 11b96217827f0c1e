#include "core/export/apply_extension.h"

namespace parsel::gltf {

void erase_extension(JsonText& owner, const char* name) {
  JsonText* extensions = owner.find("extensions");
  if (extensions == nullptr) return;
  extensions->erase(name);
  if (extensions->size() == 0) owner.erase("extensions");
}

void forget_unused_extension(File& file, const char* name) {
  for (std::size_t m = 0; m < file.size("meshes"); ++m) {
    const JsonText& primitives = file.item("meshes", m).get("primitives");
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (primitives.item(p).get("extensions").has(name)) return;
    }
  }
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    JsonText* names = file.json.find(list);
    if (names == nullptr || !names->is_array()) continue;
    const std::size_t before = names->size();
    for (std::size_t i = names->size(); i-- > 0;) {
      if (names->item(i).string() == name) names->erase_at(i);
    }
    if (names->size() == 0 && before > 0) file.json.erase(list);  // glTF forbids empty lists
  }
}

}  // namespace parsel::gltf
