// parsel sample: random siblings of a model, each with every slider of a program somewhere in its range.
#include <charconv>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/model.h"
#include "core/cli/siblings.h"

namespace parsel::cli {
namespace {

/// A whole number that an option gives; nothing when it is none.
template <class T>
std::optional<T> whole(const std::string& text) {
  T value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 2) return misuse("sample takes a model and a program");
  if (!arguments.has("-o")) return misuse("sample needs -o for the folder that it writes to");
  const auto count = whole<int>(arguments.option("--count", "9"));
  if (!count || *count < 1 || *count > most_siblings) {
    return misuse("--count takes a whole number from 1 to " + std::to_string(most_siblings));
  }
  const auto seed = whole<std::uint64_t>(arguments.option("--seed", "1"));
  if (!seed) return misuse("--seed takes a whole number from 0");
  const Result<Corrections> corrections = read_corrections(arguments);
  if (!corrections) return refuse(corrections.error());
  const auto model = load_model(arguments.positional[0], {}, *corrections);
  if (!model) return refuse(model.error());
  const auto program = read_program(arguments.positional[1], model->abstraction.shape);
  if (!program) return refuse(program.error());
  const SiblingOptions options{*count, *seed, arguments.has("--force")};
  const auto written = write_siblings(*model, *program, options, arguments.option("-o"));
  if (!written) return refuse(written.error());
  for (const auto& [warning, times] : written->warnings) {
    std::cerr << "warning: " << warning << (times > 1 ? " (" + std::to_string(times) + " siblings)" : "") << '\n';
  }
  nlohmann::json summary = to_json(written->drawn);
  summary.erase("siblings");
  summary["count"] = written->drawn.values.size();
  summary["seed"] = *seed;
  summary["folder"] = arguments.option("-o");
  std::cout << summary.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  return std::cout.flush() ? exit_done : exit_refused;
}

}  // namespace

extern const Command sample_command;
const Command sample_command = {
    "sample",
    "MODEL.glb PROGRAM [--corrections FILE.json] [--count 9] [--seed 1] [--force] -o DIR",
    "Writes random siblings of a model, every slider somewhere in its range, as GLBs, and siblings.jsonl. Settings in "
    "which sliders spoil together what each alone keeps are left out, and counted.",
    {"--count", "--seed", "--corrections", "-o"},
    {"--force"},
    run};

}  // namespace parsel::cli
