// What every command of `parsel` shares: arguments in, exit code out.
//
// Exit codes: 0 done, 1 input refused (one line on stderr: stage, place, cause, fix), 2 usage.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace parsel::cli {

inline constexpr int exit_done = 0;
inline constexpr int exit_refused = 1;
inline constexpr int exit_usage = 2;

/// Arguments after the command's name. `--name value` and `-o value` are options (repeatable), the rest positional.
struct Arguments {
  std::vector<std::string> positional;
  std::multimap<std::string, std::string> options;  ///< keys with their dashes

  /// The last value given for an option, or `otherwise`.
  std::string option(const std::string& name, const std::string& otherwise = "") const;
  bool has(const std::string& name) const { return options.count(name) > 0; }
};

struct Command {
  std::string_view name;
  std::string_view usage;                       ///< what follows the name: "MODEL.glb [-o SHAPE.json]"
  std::string_view summary;                     ///< one sentence
  std::vector<std::string_view> value_options;  ///< options that take a value
  std::vector<std::string_view> flags;          ///< options that take none
  int (*run)(const Arguments& arguments);
};

/// Every command, in the order of --help. Each is defined in the file of its name.
std::span<const Command> commands();

/// Prints the error on stderr and returns exit_refused.
int refuse(const Error& error);
/// Prints a usage message on stderr and returns exit_usage.
int misuse(std::string_view message);

/// Whether the file that `option` names may be written: it is none of the files that the command reads, unless --force
/// is given. Done for every -o before a command runs.
Status may_write(const Arguments& arguments, const std::string& option);

/// The error with `place` (a path, a part of a job) before its own place.
Error within(Error error, const std::string& place);

Result<std::string> read_file(const std::string& path);
Status write_file(const std::string& path, std::string_view bytes);
/// Writes beside the path first: a file under its own name is whole.
Status write_whole(const std::filesystem::path& path, std::string_view bytes);
/// JSON to `-o` when given, else to stdout.
int write_json(const Arguments& arguments, const nlohmann::json& json);

}  // namespace parsel::cli
