// `parsel gallery DIR`: writes every gallery model and a list of them.
#include <charconv>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/gallery/gallery.h"
#include "core/gallery/programs.h"

namespace parsel::cli {
namespace {

int write_wall(const std::string& folder, const std::string& count) {
  int parts = 0;
  const auto [end, problem] = std::from_chars(count.data(), count.data() + count.size(), parts);
  if (problem != std::errc() || end != count.data() + count.size()) return misuse("--wall takes a number of parts");
  const Result<GalleryAsset> wall = scaling_model(parts);
  if (!wall) return refuse(wall.error());
  const Status written = write_file(folder + "/" + wall->id + ".glb", wall->glb);
  return written ? exit_done : refuse(written.error());
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("gallery takes one folder, which must exist");
  const std::string& folder = arguments.positional.front();
  if (arguments.has("--wall")) return write_wall(folder, arguments.option("--wall"));
  nlohmann::json list = nlohmann::json::array();
  for (const GalleryModel& model : gallery_models()) {
    const Result<GalleryAsset> asset = build(model);
    if (!asset) return refuse(asset.error());
    nlohmann::json entry = gallery_entry(model, *asset);
    const Status written = write_file(folder + "/" + entry["file"].get<std::string>(), asset->glb);
    if (!written) return refuse(written.error());
    list.push_back(std::move(entry));
  }
  const Status written = write_file(folder + "/gallery.json", list.dump(1) + "\n");
  if (!written) return refuse(written.error());
  for (const GalleryProgram& program : gallery_programs()) {
    const std::string path = folder + "/" + std::string(program.id);
    if (const Status text = write_file(path + ".scad", program.scad); !text) return refuse(text.error());
    if (const Status text = write_file(path + ".variations.json", program.variations); !text)
      return refuse(text.error());
  }
  std::cout
      << nlohmann::json{{"folder", folder}, {"models", list.size()}, {"programs", gallery_programs().size()}}.dump(1)
      << '\n';
  return exit_done;
}

}  // namespace

extern const Command gallery_command;
const Command gallery_command = {"gallery",
                                 "DIR [--wall N]",
                                 "Writes every gallery model as DIR/<id>.glb, the list of them as DIR/gallery.json and "
                                 "every CAD program as DIR/<id>.scad with its DIR/<id>.variations.json "
                                 "(--wall: instead a wall of shelves with N parts, for benchmarks).",
                                 {"--wall"},
                                 {},
                                 run};

}  // namespace parsel::cli
