// parsel split: a model whose parts nobody told apart, as a GLB with one node a part.
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/model.h"
#include "core/split/split.h"

namespace parsel::cli {
namespace {

/// What each way would tell apart.
int list_ways(const std::string& path, double fine) {
  const auto model = load_model(path);
  if (!model) return refuse(model.error());
  const auto found = split_ways(model->bytes, model->buffers, fine);
  if (!found) return refuse(found.error());
  nlohmann::json ways = nlohmann::json::array();
  for (const SplitWay& way : found->ways)
    ways.push_back({{"by", to_string(way.by)}, {"parts", way.parts}, {"too_many", way.too_many}});
  std::cout << nlohmann::json{{"before", found->before}, {"ways", std::move(ways)}}.dump(1) << '\n';
  return std::cout.flush() ? exit_done : exit_refused;
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("split takes one model");
  if (!arguments.has("-o") && !arguments.has("--ways")) {
    return misuse("split needs -o for the GLB that it writes, or --ways to say what there is to tell apart");
  }
  SplitOptions options;
  const auto by = split_method(arguments.option("--by", "auto"));
  if (!by) return misuse("--by takes auto, components, materials or regions");
  options.by = *by;
  const std::string fine = arguments.option("--fine", "0.5");
  char* end = nullptr;
  options.fine = std::strtod(fine.c_str(), &end);
  if (fine.empty() || *end != '\0' || !(options.fine >= 0 && options.fine <= 1)) {
    return misuse("--fine takes a number from 0 to 1");
  }
  if (arguments.has("--ways")) return list_ways(arguments.positional[0], options.fine);
  const auto model = load_model(arguments.positional[0]);
  if (!model) return refuse(model.error());
  const auto split = split_model(model->bytes, model->buffers, options);
  if (!split) return refuse(split.error());
  for (const Warning& warning : split->warnings) {
    std::cerr << "warning: " << warning.place << ": " << warning.text << '\n';
  }
  const Status written = write_file(arguments.option("-o"), split->glb);
  if (!written) return refuse(written.error());
  std::cout << nlohmann::json{{"by", to_string(split->by)},
                              {"before", split->before},
                              {"parts", split->parts},
                              {"joined", split->joined}}
                   .dump(1)
            << '\n';
  return std::cout.flush() ? exit_done : exit_refused;
}

}  // namespace

extern const Command split_command;
const Command split_command = {
    "split",
    "MODEL.glb [--by auto|components|materials|regions] [--fine 0.5] -o OUT.glb | --ways",
    "Tells the parts of a model in one piece apart and writes each as a node of its own, geometry untouched. --fine 0 "
    "joins what is small to what it sits on, 1 keeps every piece. --ways writes nothing: it says how many parts each "
    "way "
    "gives.",
    {"--by", "--fine", "-o"},
    {"--ways"},
    run};

}  // namespace parsel::cli
