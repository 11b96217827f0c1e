// parsel sample: random siblings of a model, each with every slider of a program somewhere in its range.
#include <charconv>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/model.h"
#include "core/export/apply.h"
#include "core/prove/together.h"

namespace parsel::cli {
namespace {

namespace fs = std::filesystem;

/// A whole number that an option gives; nothing when it is none.
template <class T>
std::optional<T> whole(const std::string& text) {
  T value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string file_name(std::size_t index, std::size_t count) {
  std::string number = std::to_string(index + 1);
  number.insert(0, std::to_string(count).size() - number.size(), '0');
  return "sibling_" + number + ".glb";
}

/// Written beside its place first: a file under its own name is whole.
Status write_whole(const fs::path& path, std::string_view bytes) {
  const std::string beside = path.string() + ".part";
  const Status written = write_file(beside, bytes);
  std::error_code fault;
  if (written) fs::rename(beside, path, fault);
  if (written && !fault) return success();
  std::error_code ignored;
  fs::remove(beside, ignored);
  return written ? Status(Error{"cli", path.string(), "the file cannot be written", fault.message()}) : written;
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

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 2) return misuse("sample takes a model and a program");
  if (!arguments.has("-o")) return misuse("sample needs -o for the folder that it writes to");
  const auto count = whole<int>(arguments.option("--count", "9"));
  if (!count || *count < 1 || *count > most_siblings) {
    return misuse("--count takes a whole number from 1 to " + std::to_string(most_siblings));
  }
  const auto seed = whole<std::uint64_t>(arguments.option("--seed", "1"));
  if (!seed) return misuse("--seed takes a whole number from 0");
  const auto model = load_model(arguments.positional[0]);
  if (!model) return refuse(model.error());
  const Shape& shape = model->abstraction.shape;
  const auto program = read_program(arguments.positional[1], shape);
  if (!program) return refuse(program.error());
  const auto drawn = draw_siblings(shape, *program, *count, *seed);
  if (!drawn) return refuse(drawn.error());

  const fs::path folder = arguments.option("-o");
  const std::size_t of = drawn->values.size();
  if (const Status ready = prepare(folder, of, arguments.has("--force")); !ready) return refuse(ready.error());
  const Together together(shape, *program);
  std::string lines;
  std::map<std::string, int> warnings;
  for (std::size_t i = 0; i < of; ++i) {
    const std::vector<double>& values = drawn->values[i];
    ApplyOptions options;
    options.external = model->buffers;
    const auto applied = apply_program(model->bytes, shape, *program, values, std::nullopt, std::move(options));
    if (!applied) return refuse(applied.error());
    for (const Warning& warning : applied->warnings) ++warnings[warning.place + ": " + warning.text];
    const std::string name = file_name(i, of);
    if (const Status written = write_whole(folder / name, applied->glb); !written) return refuse(written.error());
    nlohmann::json by_parameter = nlohmann::json::object();
    for (std::size_t k = 0; k < values.size(); ++k) by_parameter[program->layers[k].parameter.name] = values[k];
    const Together::Count relations = together.relations(values);
    lines += nlohmann::json{{"file", name},
                            {"values", std::move(by_parameter)},
                            {"valid", together.fault(values).empty()},
                            {"relations", {{"kept", relations.kept}, {"of", relations.of}}}}
                 .dump() +
             "\n";
  }
  // Last, so that whoever finds it finds all that it speaks of.
  if (const Status written = write_whole(folder / "siblings.jsonl", lines); !written) return refuse(written.error());
  for (const auto& [warning, times] : warnings) {
    std::cerr << "warning: " << warning << (times > 1 ? " (" + std::to_string(times) + " siblings)" : "") << '\n';
  }
  nlohmann::json summary = to_json(*drawn);
  summary.erase("siblings");
  summary["count"] = of;
  summary["seed"] = *seed;
  summary["folder"] = folder.string();
  std::cout << summary.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
  return std::cout.flush() ? exit_done : exit_refused;
}

}  // namespace

extern const Command sample_command;
const Command sample_command = {
    "sample",
    "MODEL.glb PROGRAM [--count 9] [--seed 1] [--force] -o DIR",
    "Writes random siblings of a model, every slider somewhere in its range, as GLBs, and siblings.jsonl. Settings in "
    "which sliders spoil together what each alone keeps are left out, and counted.",
    {"--count", "--seed", "-o"},
    {"--force"},
    run};

}  // namespace parsel::cli
