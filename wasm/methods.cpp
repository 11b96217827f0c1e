#include "wasm/methods.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

namespace parsel::wasm {

namespace {

Result<Output> version(const Input&) {
  return Output{{{"version", PARSEL_VERSION}}, {}};
}

/// Goes wrong on purpose, in the way that is asked for: how the page's recovery is tested.
Result<Output> fail(const Input& input) {
  const std::string kind = input.parameters.value("kind", "");
  if (kind == "exception") throw std::runtime_error("asked to fail");
  if (kind == "abort") std::abort();
  if (kind == "memory") {
    std::vector<std::string> blocks;
    for (;;) blocks.emplace_back(std::size_t{1} << 28, 'x');
  }
  if (kind == "hang") {
    for (volatile int forever = 0;; forever = forever + 1) {
    }
  }
  return Error{"wasm", "fail", "there is no kind of failure '" + kind + "'",
               "ask for exception, abort, memory or hang"};
}

constexpr std::array all_methods = {
    Method{"version", version},
    Method{"fail", fail},
};

}  // namespace

std::span<const Method> methods() {
  return all_methods;
}

const Method* find_method(std::string_view name) {
  const auto found =
      std::find_if(all_methods.begin(), all_methods.end(), [&](const Method& m) { return m.name == name; });
  return found == all_methods.end() ? nullptr : &*found;
}

}  // namespace parsel::wasm
