#include "wasm/methods.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "core/edit/amount.h"
#include "core/propagate/solve.h"
#include "core/shape/abstraction.h"

namespace parsel::wasm {

using nlohmann::json;

namespace {

/// The model that the page has open. The page opens it again in a new worker.
std::optional<Abstraction> model;

Error wrong_parameter(const std::string& name, const std::string& expected) {
  return {"wasm", name, "it is not " + expected, "please report this: page and core disagree"};
}

Result<std::string> text_parameter(const Input& input, const std::string& name) {
  const auto found = input.parameters.find(name);
  if (found == input.parameters.end() || !found->is_string()) return wrong_parameter(name, "a text");
  return found->get<std::string>();
}

Result<Output> version(const Input&) {
  return Output{{{"version", PARSEL_VERSION}}, {}};
}

json solutions(const std::string& equation, const std::string& unknown) {
  json texts = json::array();
  const Result<Amount> parsed = parse_amount(equation);
  PARSEL_ASSERT(parsed.ok(), "the caller checked the equation");
  for (const GiNaC::ex& root : solve_for(parsed->expression(), parameter_symbol(unknown)).roots) {
    texts.push_back(Amount(root).text());
  }
  return texts;
}

Result<Output> warm_up(const Input&) {
  for (int round = 0; round < 20; ++round) {
    solutions("2*y - x", "y");
    solutions("3*cos(y) + 4*sin(y) - x", "y");
  }
  return Output{json::object(), {}};
}

Result<Output> solve(const Input& input) {
  const Result<std::string> equation = text_parameter(input, "equation");
  if (!equation.ok()) return equation.error();
  const Result<std::string> unknown = text_parameter(input, "unknown");
  if (!unknown.ok()) return unknown.error();
  const Result<Amount> parsed = parse_amount(*equation);
  if (!parsed.ok()) return parsed.error();
  const Result<Amount> name = parse_amount(*unknown);
  if (!name.ok() || name->parameters() != std::vector<std::string>{*unknown}) {
    return wrong_parameter("unknown", "the name of a parameter");
  }
  return Output{{{"solutions", solutions(*equation, *unknown)}}, {}};
}

/// buffers = the file, then the external buffers that `external` names, in its order.
Result<Output> open(const Input& input) {
  const Result<std::string> name = text_parameter(input, "name");
  if (!name.ok()) return name.error();
  const json names = input.parameters.value("external", json());
  if (!names.is_array() || input.buffers.size() != names.size() + 1) {
    return wrong_parameter("external", "a name for each buffer after the first");
  }
  ExternalBuffers external;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].is_string()) return wrong_parameter("external", "a list of names");
    external[names[i].get<std::string>()] = input.buffers[i + 1];
  }
  Result<Abstraction> abstraction = abstract_shape(input.buffers[0], *name, external);
  if (!abstraction.ok()) return abstraction.error();  // the open model stays
  model = std::move(*abstraction);
  return Output{{{"shape", to_json(model->shape)}}, {}};
}

/// Bytes of linear memory: it grows and never shrinks, so this is the peak as well.
Result<Output> memory(const Input&) {
#ifdef __wasm__
  return Output{{{"bytes", __builtin_wasm_memory_size(0) * 65536.0}}, {}};
#else
  return Error{"wasm", "memory", "only WebAssembly knows its memory", "ask the operating system"};
#endif
}

/// Goes wrong on purpose, in the way that is asked for: how the page's recovery is tested.
Result<Output> fail(const Input& input) {
  const Result<std::string> kind = text_parameter(input, "kind");
  if (!kind.ok()) return kind.error();
  if (*kind == "exception") throw std::runtime_error("asked to fail");
  if (*kind == "abort") std::abort();
  if (*kind == "memory") {
    std::vector<std::string> blocks;
    for (;;) blocks.emplace_back(std::size_t{1} << 28, 'x');
  }
  if (*kind == "hang") {
    for (volatile int forever = 0;; forever = forever + 1) {
    }
  }
  return wrong_parameter("kind", "exception, abort, memory or hang");
}

constexpr std::array all_methods = {
    Method{"version", version}, Method{"warm_up", warm_up}, Method{"solve", solve},
    Method{"open", open},       Method{"memory", memory},   Method{"fail", fail},
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
