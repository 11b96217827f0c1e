// The only file that knows Emscripten. One function crosses the boundary:
//
//   invoke(method: string, parameters: string (JSON), buffers: Uint8Array[], progress: function | null)
//     → { json: string, buffers: Uint8Array[] }     json is {"result": …} or {"error": {stage, place, cause, fix}}
//
// Everything is copied in and out; no view of the heap outlives the call. Every C++ exception becomes an error value
// here and nowhere else. web/src/worker/protocol.ts types the same methods; tests/web/protocol.test.ts fails when the
// two differ.
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "wasm/methods.h"

namespace {

using emscripten::val;
using nlohmann::json;

json to_json(const parsel::Error& error) {
  return {{"stage", error.stage}, {"place", error.place}, {"cause", error.cause}, {"fix", error.fix}};
}

/// Copies bytes into an array of JavaScript's own.
val to_uint8_array(const std::string& bytes) {
  const val view(emscripten::typed_memory_view(bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data())));
  return val::global("Uint8Array").new_(view);
}

val reply(const json& message, const std::vector<std::string>& buffers) {
  val array = val::array();
  for (const std::string& buffer : buffers) array.call<void>("push", to_uint8_array(buffer));
  val object = val::object();
  object.set("json", message.dump(-1, ' ', false, json::error_handler_t::replace));
  object.set("buffers", array);
  return object;
}

parsel::Result<parsel::wasm::Output> run(const std::string& name, const std::string& parameters, const val& buffers,
                                         const val& progress) {
  const auto methods = parsel::wasm::methods();
  const auto method = std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.name == name; });
  if (method == methods.end()) {
    return parsel::Error{"wasm", name, "the core has no such method", "reload the page: it is older than the core"};
  }
  parsel::wasm::Input input;
  parsel::Result<json> read = parsel::json_from_text(parameters, "wasm");
  if (!read.ok()) return read.error();
  input.parameters = std::move(read).value();
  if (!input.parameters.is_object()) {
    return parsel::Error{"wasm", name, "the parameters are no JSON object", "please report this"};
  }
  const auto count = buffers["length"].as<unsigned>();
  for (unsigned i = 0; i < count; ++i) input.buffers.push_back(buffers[i].as<std::string>());
  if (!progress.isNull() && !progress.isUndefined()) {
    input.progress = [&progress](const std::string& step, int done, int total) { progress(step, done, total); };
  }
  return method->run(input);
}

val invoke(const std::string& method, const std::string& parameters, const val& buffers, const val& progress) {
  parsel::Error error{"core", method, "", "please report this with the file that caused it"};
  try {
    const parsel::Result<parsel::wasm::Output> output = run(method, parameters, buffers, progress);
    if (output.ok()) return reply({{"result", output->result}}, output->buffers);
    error = output.error();
  } catch (const std::bad_alloc&) {
    error.cause = "there is not enough memory for this";
    error.fix = "try a smaller model, or close other tabs";
  } catch (const std::exception& exception) {
    error.cause = std::string("internal error: ") + exception.what();
  } catch (...) {
    error.cause = "internal error of unknown kind";
  }
  return reply({{"error", to_json(error)}}, {});
}

/// The names of all methods, so that a test can compare them with the TypeScript side.
val methods() {
  val names = val::array();
  for (const parsel::wasm::Method& method : parsel::wasm::methods()) {
    names.call<void>("push", std::string(method.name));
  }
  return names;
}

}  // namespace

EMSCRIPTEN_BINDINGS(parsel) {
  emscripten::function("invoke", &invoke);
  emscripten::function("methods", &methods);
}
