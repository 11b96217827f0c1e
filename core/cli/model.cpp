#include "core/cli/model.h"

#include <filesystem>

#include "core/cli/command.h"
#include "core/gltf/document.h"

namespace parsel::cli {

namespace {

/// What a file that is no model is, when one of our commands wrote it; empty for what others wrote.
std::string own_format(const std::string& bytes) {
  for (const std::string name : {"shape", "program", "edit", "trace"}) {
    if (bytes.find("\"parsel/" + name + '"') != std::string::npos) return name;
  }
  return {};
}

}  // namespace

Result<Model> load_model(const std::string& path, const Labels& labels, const Corrections& corrections) {
  Result<std::string> bytes = read_file(path);
  if (!bytes.ok()) return bytes.error();
  Model model;
  model.bytes = std::move(*bytes);

  const std::filesystem::path file(path);
  for (const std::string& uri : external_buffer_uris(model.bytes)) {
    const std::filesystem::path relative = std::filesystem::path(uri).lexically_normal();
    // A model must not be able to make us read other files of this machine.
    if (relative.is_absolute() || relative.empty() || *relative.begin() == "..") continue;
    Result<std::string> buffer = read_file((file.parent_path() / relative).string());
    if (buffer.ok()) model.buffers[uri] = std::move(*buffer);
  }
  Result<Abstraction> abstraction =
      abstract_shape(model.bytes, file.stem().string(), model.buffers, labels, corrections);
  if (!abstraction.ok()) {
    if (const std::string format = own_format(model.bytes); !format.empty()) {
      return Error{"cli", path, "it is of the format parsel/" + format + ", not a model",
                   "give the .glb or .gltf file"};
    }
    return within(abstraction.error(), path);
  }
  model.abstraction = std::move(*abstraction);
  return model;
}

}  // namespace parsel::cli
