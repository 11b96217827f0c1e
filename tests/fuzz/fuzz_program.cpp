// Arbitrary bytes as an amount, as a program's text and as a program's JSON. What is accepted must survive being
// printed and read again, and must be judged and evaluated without a fault.
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/edit/evaluate.h"

using namespace parsel;

namespace {

/// Two boxes and an attachment are enough for known and unknown names.
const Shape& shape() {
  static const Shape fixed = [] {
    Shape made;
    for (const char* id : {"seat", "leg"}) {
      Part part;
      part.id = part.label = part.name = id;
      part.node = static_cast<int>(made.parts.size());
      part.primitive = 0;
      part.hexahedron = make_box(Vec3(0, part.node, 0), Mat3::Identity(), Vec3(0.5, 0.5, 0.5));
      made.parts.push_back(std::move(part));
    }
    return made;
  }();
  return fixed;
}

void check_program(const Program& program) {
  const Result<Program> from_text = program_from_text(to_text(program));
  PARSEL_ASSERT(from_text.ok(), "printed text is accepted");
  PARSEL_ASSERT(to_json(*from_text) == to_json(program), "the text form is lossless");
  const Result<Program> from_json = program_from_json(to_json(program));
  PARSEL_ASSERT(from_json.ok(), "printed JSON is accepted");
  PARSEL_ASSERT(to_json(*from_json) == to_json(program), "the JSON form is lossless");
  if (!validate(program, shape()).ok()) return;
  std::vector<double> values;
  for (const Layer& layer : program.layers) values.push_back(layer.parameter.max);
  const State state = Evaluator(program, shape())(values);
  PARSEL_ASSERT(state.parts.size() == 2, "a state has every part");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 3) {
    case 0: {
      const Result<Amount> amount = parse_amount(bytes);
      if (!amount.ok()) break;
      const std::string text = amount->text();
      // Printing can only lengthen beyond the limit what is near it.
      if (text.size() > 4096) break;
      const Result<Amount> again = parse_amount(text);
      if (again.ok()) PARSEL_ASSERT(again->text() == text, "printing is stable");
      const std::vector<std::string> names = amount->parameters();
      const std::vector<double> values(names.size(), 0.25);
      static_cast<void>(amount->compile(names)(values.data()));
      break;
    }
    case 1: {
      const Result<Program> program = program_from_text(bytes);
      if (program.ok()) check_program(*program);
      break;
    }
    default: {
      const nlohmann::json json = nlohmann::json::parse(bytes, nullptr, false);
      if (json.is_discarded()) break;
      const Result<Program> program = program_from_json(json);
      if (program.ok()) check_program(*program);
    }
  }
  return 0;
}
