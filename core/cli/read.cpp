// parsel read: what a plain request means, without a language model.
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/infer/plain_reading.h"

namespace parsel::cli {
namespace {

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("read takes one model");
  if (!arguments.has("--request")) return misuse("read needs --request, such as --request \"widen the chair\"");
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape.ok()) return refuse(shape.error());
  EditWish wish{arguments.option("--request"), {}};
  const auto [first, last] = arguments.options.equal_range("--mention");
  for (auto mention = first; mention != last; ++mention) wish.mentioned.push_back(mention->second);
  const Result<PlainReading> reading = read_plainly(*shape, wish);
  if (!reading.ok()) return refuse(reading.error());
  return write_json(arguments, to_json(*shape, *reading));
}

}  // namespace

extern const Command read_command;
const Command read_command = {
    "read",
    "MODEL.glb|SHAPE.json --request TEXT [--mention PART]… [-o READING.json]",
    "Reads a plain request without a language model: as reply does, and whether it is sure, else what may be meant.",
    {"--request", "--mention", "-o"},
    {},
    run};

}  // namespace parsel::cli
