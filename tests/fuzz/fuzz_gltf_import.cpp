// Any bytes: a valid shape or an error that names its cause; never a crash, a hang or a broken shape.
//   build/fuzz/tests/fuzz/fuzz_gltf_import -max_len=65536 -timeout=10 -rss_limit_mb=4096 WORK
//   tests/fuzz/corpus/gltf_import
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/shape/abstraction.h"
#include "core/shape/words.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace parsel;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ExternalBuffers buffers;
  for (const std::string& uri : external_buffer_uris(bytes)) buffers[uri] = std::string(256, '\x3f');
  const Result<Abstraction> abstraction = abstract_shape(bytes, "fuzz", buffers);
  if (!abstraction.ok()) {
    PARSEL_ASSERT(!abstraction.error().cause.empty(), "a refusal names its cause");
    return 0;
  }
  const Shape& shape = abstraction->shape;
  const Status sound = validate(shape);
  PARSEL_ASSERT(sound.ok(), sound.ok() ? "" : sound.error().message().c_str());
  const Result<Shape> again = shape_from_json(to_json(shape));
  PARSEL_ASSERT(again.ok(), "what is written can be read");
  PARSEL_ASSERT(!describe(shape).empty(), "a shape can be described");
  return 0;
}
