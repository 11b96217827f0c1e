// Extensions that an edit makes untrue, taken out of a file that is being patched.
#pragma once

#include "core/export/apply_file.h"

namespace parsel::gltf {

/// Takes the extension out of the object, and `extensions` when nothing remains in it.
void erase_extension(JsonText& owner, const char* name);

/// Takes an extension that no primitive of a mesh uses any more out of extensionsUsed and extensionsRequired.
void forget_unused_extension(File& file, const char* name);

}  // namespace parsel::gltf
