// The `parsel` command-line tool: finds the command, parses its options, runs it.
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"

namespace parsel::cli {

namespace {
/// As large as a model may be (ImportLimits::file_bytes): what is larger would be read for nothing.
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 30;
}  // namespace

std::string Arguments::option(const std::string& name, const std::string& otherwise) const {
  const auto [first, last] = options.equal_range(name);
  return first == last ? otherwise : std::prev(last)->second;
}

int refuse(const Error& error) {
  std::cerr << error.message() << '\n';
  return exit_refused;
}

int misuse(std::string_view message) {
  std::cerr << "parsel: " << message << " (parsel --help lists the commands)\n";
  return exit_usage;
}

Status may_write(const Arguments& arguments, const std::string& option) {
  if (!arguments.has(option) || arguments.has("--force")) return success();
  const std::string path = arguments.option(option);
  const auto is_read = [&](const std::string& other) {
    std::error_code none;  // a file that is not there is no other file
    return std::filesystem::equivalent(path, other, none);
  };
  bool taken = std::any_of(arguments.positional.begin(), arguments.positional.end(), is_read);
  for (const auto& [name, value] : arguments.options) taken = taken || (name != option && is_read(value));
  if (!taken) return success();
  return Error{"cli", option + " " + path, "the file is read by the same command", "write to another file"};
}

Error within(Error error, const std::string& place) {
  if (error.place != place) error.place = place + (error.place.empty() ? "" : ", " + error.place);
  return error;
}

Result<std::string> read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return Error{"cli", path, "the file cannot be opened", "check the path and its permissions"};
  std::error_code unknown;  // of a pipe, which is then read to its end
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  if (!unknown && size > largest_file) {
    return Error{"cli", path, "the file is larger than 1 GiB", "simplify the model, or give another file"};
  }
  // Into a string and not through a stream, which would keep to itself that memory ended.
  std::string bytes;
  if (!unknown) bytes.reserve(static_cast<std::size_t>(size));
  std::array<char, 1 << 16> chunk;
  do {
    file.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    bytes.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
  } while (file);
  if (!file.eof()) return Error{"cli", path, "reading failed", "check that it is a file, not a folder"};
  return bytes;
}

Status write_file(const std::string& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) return Error{"cli", path, "the file cannot be written", "check that the folder exists and has space"};
  return success();
}

Status write_whole(const std::filesystem::path& path, std::string_view bytes) {
  const std::string beside = path.string() + ".part";
  const Status written = write_file(beside, bytes);
  std::error_code fault;
  if (written) std::filesystem::rename(beside, path, fault);
  if (written && !fault) return success();
  std::error_code ignored;
  std::filesystem::remove(beside, ignored);
  return written ? Status(Error{"cli", path.string(), "the file cannot be written", fault.message()}) : written;
}

int write_json(const Arguments& arguments, const nlohmann::json& json) {
  // Names are untrusted bytes: what is not UTF-8 is replaced, never thrown about.
  const std::string text = json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  if (!arguments.has("-o")) {
    std::cout << text;
    return std::cout.flush() ? exit_done : exit_refused;
  }
  const Status written = write_file(arguments.option("-o"), text);
  return written.ok() ? exit_done : refuse(written.error());
}

namespace {

void print_help(std::ostream& out) {
  out << "parsel " PARSEL_VERSION ": parameterized shape editing with language\n\nUsage:\n";
  for (const Command& command : commands()) {
    out << "  parsel " << command.name << ' ' << command.usage << "\n      " << command.summary << '\n';
  }
  out << "  parsel --help | --version\n\n"
         "Results go to stdout as JSON unless -o names a file; messages go to stderr.\n"
         "Exit code 0: done; 1: the input was refused, with stage, place, cause and fix; 2: wrong usage.\n";
}

bool contains(const std::vector<std::string_view>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

int run(int argc, char** argv) {
  if (argc < 2) {
    print_help(std::cerr);
    return exit_usage;
  }
  const std::string_view name = argv[1];
  if (name == "--help" || name == "-h") {
    print_help(std::cout);
    return exit_done;
  }
  if (name == "--version") {
    std::cout << "parsel " PARSEL_VERSION "\n";
    return exit_done;
  }
  const auto all = commands();
  const auto command = std::find_if(all.begin(), all.end(), [&](const Command& c) { return c.name == name; });
  if (command == all.end()) return misuse("there is no command '" + std::string(name) + "'");

  Arguments arguments;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--help") {
      std::cout << "Usage: parsel " << command->name << ' ' << command->usage << "\n  " << command->summary << '\n';
      return exit_done;
    }
    if (argument.size() < 2 || argument[0] != '-') {
      arguments.positional.push_back(argument);
    } else if (contains(command->flags, argument)) {
      arguments.options.emplace(argument, "");
    } else if (!contains(command->value_options, argument)) {
      return misuse(std::string(name) + " has no option " + argument);
    } else if (i + 1 == argc) {
      return misuse(argument + " needs a value");
    } else {
      arguments.options.emplace(argument, argv[++i]);
    }
  }
  if (const Status allowed = may_write(arguments, "-o"); !allowed.ok()) return refuse(allowed.error());
  return command->run(arguments);
}

}  // namespace
}  // namespace parsel::cli

int main(int argc, char** argv) {
  int code = parsel::cli::exit_refused;
  try {
    code = parsel::cli::run(argc, argv);
  } catch (const std::bad_alloc&) {
    code = parsel::cli::refuse({"cli", "", "there is not enough memory for this input", "try a smaller model"});
  } catch (const std::exception& error) {
    code = parsel::cli::refuse({"cli", "", std::string("internal error: ") + error.what(), "please report it"});
  }
  std::cout.flush();  // a module that goes on living when this returns flushes nothing by itself
  return code;
}
