// parsel_fuzz: mutated models and edits through the whole pipeline, as long as one likes. Each case runs in a child
// process of its own, so that a crash, a hang or a hunger for memory is counted and the campaign goes on.
//
//   parsel_fuzz [--seconds 60] [--seed 1] [--corpus DIR] [--keep DIR]
//   parsel_fuzz --replay MODEL.glb EDIT.json
//
// Prints each new kind of fault once, keeps its input as DIR/<n>.glb and <n>.json, and exits with 1 if there was any.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "core/gallery/gallery.h"
#include "tests/fuzz/mutate.h"
#include "tests/fuzz/pipeline.h"

namespace {

using namespace parsel;
using fuzz::Input;

constexpr rlim_t most_seconds = 10;  // of processor time, so that a busy machine makes no hangs
#ifdef __SANITIZE_ADDRESS__
// Shadow memory and freed blocks that are kept back multiply what is used.
constexpr long most_kib = 3L << 20;
#else
constexpr long most_kib = 1L << 20;
#endif

std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

const std::string any_edit = R"({"seed": [{"op": "scale_1d", "part": "node:0", "amount": "x",
  "origin": {"part": "node:0", "at": [0, 0, 0]}, "direction": [1, 0, 0]}]})";

std::vector<Input> seeds(const std::filesystem::path& corpus) {
  std::vector<Input> all;
  for (const GalleryModel& model : gallery_models()) {
    const auto asset = build(model);
    if (!asset.ok()) continue;
    all.push_back({asset->glb, any_edit});
    for (const GalleryEdit& edit : asset->edits) all.push_back({asset->glb, edit.json});
  }
  if (corpus.empty()) return all;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    if (entry.path().extension() == ".glb") all.push_back({read_bytes(entry.path()), any_edit});
  }
  return all;
}

struct Outcome {
  fuzz::Reached reached = fuzz::Reached::nothing;
  std::string fault;
};

/// In a child process, its stderr in `log`.
Outcome run(const Input& input, const std::filesystem::path& log) {
  int ends[2];
  if (pipe(ends) != 0) std::abort();
  const pid_t child = fork();
  if (child == 0) {
    const rlimit time{most_seconds, most_seconds + 1};
    setrlimit(RLIMIT_CPU, &time);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    if (std::freopen(log.c_str(), "w", stderr) == nullptr) _exit(3);
    const fuzz::Walk walked = fuzz::walk(input.glb, input.edit);
    const std::string said = std::to_string(static_cast<int>(walked.reached)) + walked.fault.value_or("");
    _exit(write(ends[1], said.data(), said.size()) == static_cast<ssize_t>(said.size()) ? 0 : 3);
  }
  close(ends[1]);
  std::string said;
  char buffer[4096];
  for (ssize_t got = 0; (got = read(ends[0], buffer, sizeof buffer)) > 0;)
    said.append(buffer, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  Outcome outcome;
  if (!said.empty()) {
    outcome.reached = static_cast<fuzz::Reached>(said[0] - '0');
    outcome.fault = said.substr(1);
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    outcome.fault = "hang: more than 10 s";
  } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    outcome.fault = "crash: ";
    std::ifstream lines(log);
    for (std::string line; std::getline(lines, line);) {
      const bool tells = line.find("ERROR") != line.npos || line.find("runtime error") != line.npos ||
                         line.find("does not hold") != line.npos || line.find("what()") != line.npos;
      if (tells && outcome.fault.size() < 200) outcome.fault += line + " ";
    }
    if (WIFSIGNALED(status)) outcome.fault += strsignal(WTERMSIG(status));
  } else if (usage.ru_maxrss > most_kib) {
    outcome.fault = "memory: more than the limit";
    std::fprintf(stdout, "memory: %ld KiB\n", usage.ru_maxrss);
  }
  return outcome;
}

/// Faults that differ in numbers alone are of one kind.
std::string kind_of(const std::string& fault) {
  std::string kind;
  bool quoted = false;
  for (const char c : fault.substr(0, 240)) {
    if (c == '\'') quoted = !quoted;
    if (quoted || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '=') continue;
    kind += c;
  }
  return kind;
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, std::string> options = {
      {"--seconds", "60"}, {"--seed", "1"}, {"--corpus", ""}, {"--keep", "tests/output/fuzz"}};
  if (argc == 4 && std::string(argv[1]) == "--replay") {
    const fuzz::Walk walked = fuzz::walk(read_bytes(argv[2]), read_bytes(argv[3]));
    std::cout << "reached " << static_cast<int>(walked.reached) << ' ' << walked.fault.value_or("no fault") << '\n';
    return walked.fault ? 1 : 0;
  }
  for (int i = 1; i + 1 < argc; i += 2) options[argv[i]] = argv[i + 1];
  const std::filesystem::path keep = options["--keep"];
  std::filesystem::create_directories(keep);
  const std::vector<Input> from = seeds(options["--corpus"]);
  const auto seconds = std::chrono::seconds(std::stol(options["--seconds"]));
  const auto start = std::chrono::steady_clock::now();
  std::map<std::string, long> kinds;
  std::map<int, long> reached;
  long cases = 0;
  for (std::uint64_t seed = std::stoull(options["--seed"]); std::chrono::steady_clock::now() - start < seconds;
       ++seed) {
    Random random(seed);
    const Input& base = from[static_cast<std::size_t>(random.below(from.size()))];
    const Input input = fuzz::mutated(base, random);
    const Outcome outcome = run(input, keep / "stderr.txt");
    ++cases;
    ++reached[static_cast<int>(outcome.reached)];
    if (outcome.fault.empty() || kinds[kind_of(outcome.fault)]++ > 0) continue;
    const std::string name = std::to_string(seed);
    write_bytes(keep / (name + ".glb"), input.glb);
    write_bytes(keep / (name + ".json"), input.edit);
    std::cout << name << ": " << outcome.fault << std::endl;
  }
  std::cout << cases << " cases; refused " << reached[0] << ", opened " << reached[1] << ", edit read " << reached[2]
            << ", propagated " << reached[3] << ", written " << reached[4] << '\n';
  for (const auto& [kind, count] : kinds) std::cout << count << " x " << kind << '\n';
  return kinds.empty() ? 0 : 1;
}
