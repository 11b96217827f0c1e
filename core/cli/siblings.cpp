#include "core/cli/siblings.h"

#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/export/apply.h"

namespace parsel::cli {
namespace {

namespace fs = std::filesystem;

std::string file_name(std::size_t index, std::size_t count) {
  std::string number = std::to_string(index + 1);
  number.insert(0, std::to_string(count).size() - number.size(), '0');
  return "sibling_" + number + ".glb";
}

/// The folder is there, and nothing of what is to be written.
Status prepare(const fs::path& folder, std::size_t count, bool force) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault || !fs::is_directory(folder)) {
    return Error{"cli", "-o " + folder.string(), "the folder cannot be made", "name one that can be written to"};
  }
  if (force) return success();
  std::vector<std::string> names = {"siblings.jsonl"};
  for (std::size_t i = 0; i < count; ++i) names.push_back(file_name(i, count));
  for (const std::string& name : names) {
    if (fs::exists(folder / name)) {
      return Error{"cli", "-o " + folder.string(), name + " is there already", "name another folder, or add --force"};
    }
  }
  return success();
}

/// Writes what is drawn; the names of the files that were written stand in `out` also when one of them fails.
Status write_all(const Model& model, const Program& program, const fs::path& folder, SiblingFiles& out) {
  const Shape& shape = model.abstraction.shape;
  const std::size_t of = out.drawn.values.size();
  const Together together(shape, program);
  std::string lines;
  for (std::size_t i = 0; i < of; ++i) {
    const std::vector<double>& values = out.drawn.values[i];
    ApplyOptions apply;
    apply.external = model.buffers;
    const auto applied = apply_program(model.bytes, shape, program, values, std::nullopt, std::move(apply));
    if (!applied) return applied.error();
    for (const Warning& warning : applied->warnings) ++out.warnings[warning.place + ": " + warning.text];
    const std::string name = file_name(i, of);
    if (const Status written = write_whole(folder / name, applied->glb); !written) return written;
    out.names.push_back(name);
    nlohmann::json by_parameter = nlohmann::json::object();
    for (std::size_t k = 0; k < values.size(); ++k) by_parameter[program.layers[k].parameter.name] = values[k];
    const Together::Count relations = together.relations(values);
    lines += nlohmann::json{{"file", name},
                            {"values", std::move(by_parameter)},
                            {"valid", together.fault(values).empty()},
                            {"relations", {{"kept", relations.kept}, {"of", relations.of}}}}
                 .dump() +
             "\n";
  }
  // Last, so that whoever finds it finds all that it speaks of.
  const Status written = write_whole(folder / "siblings.jsonl", lines);
  if (written) out.names.emplace_back("siblings.jsonl");
  return written;
}

}  // namespace

Result<SiblingFiles> write_siblings(const Model& model, const Program& program, const SiblingOptions& options,
                                    const fs::path& folder) {
  Result<Siblings> drawn = draw_siblings(model.abstraction.shape, program, options.count, options.seed);
  if (!drawn) return drawn.error();
  if (const Status ready = prepare(folder, drawn->values.size(), options.force); !ready) return ready.error();
  SiblingFiles out;
  out.drawn = std::move(*drawn);
  const Status written = write_all(model, program, folder, out);
  if (written) return out;
  std::error_code ignored;
  for (const std::string& name : out.names) fs::remove(folder / name, ignored);
  return written.error();
}

}  // namespace parsel::cli
