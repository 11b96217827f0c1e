// Random siblings of a model as files: what `parsel sample` and `parsel job` write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/cli/model.h"
#include "core/edit/program.h"
#include "core/prove/together.h"

namespace parsel::cli {

struct SiblingOptions {
  int count = 9;  ///< from 1 to most_siblings
  std::uint64_t seed = 1;
  bool force = false;  ///< over files that are there
};

struct SiblingFiles {
  Siblings drawn;
  std::vector<std::string> names;       ///< in the folder; siblings.jsonl, which speaks of the others, is the last
  std::map<std::string, int> warnings;  ///< and of how many siblings
};

/// Writes sibling_1.glb … and siblings.jsonl into the folder, which is made. A file under its own name is whole. Error:
/// as draw_siblings() and apply_program(); a folder that cannot be made; without `force`, files that are there already.
/// What was written until then is removed.
Result<SiblingFiles> write_siblings(const Model& model, const Program& program, const SiblingOptions& options,
                                    const std::filesystem::path& folder);

}  // namespace parsel::cli
