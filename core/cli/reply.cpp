// parsel reply: what the replies of a language model mean, counted as votes.
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/task.h"
#include "core/infer/inference.h"

namespace parsel::cli {
namespace {

int run(const Arguments& arguments) {
  if (arguments.positional.size() < 2) return misuse("reply takes a model and at least one reply");
  if (!arguments.has("--task")) return misuse("reply needs --task, the one that the replies answer");
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape.ok()) return refuse(shape.error());
  const Result<AskedTask> asked = asked_task(arguments, *shape);
  if (!asked.ok()) return refuse(asked.error());
  Replies replies{asked->task, asked->relation, {}};
  for (std::size_t i = 1; i < arguments.positional.size(); ++i) {
    Result<std::string> text = read_file(arguments.positional[i]);
    if (!text.ok()) return refuse(text.error());
    replies.texts.push_back(std::move(*text));
  }
  const Inference inference = infer(*shape, {replies});
  if (inference.refused.size() == replies.texts.size()) {  // then there is nothing to count
    Error error = inference.refused.front().error;
    error.place = arguments.positional[1] + (error.place.empty() ? "" : ", " + error.place);
    return refuse(error);
  }
  return write_json(arguments, to_json(*shape, inference));
}

}  // namespace

extern const Command reply_command;
const Command reply_command = {"reply",
                               "MODEL.glb|SHAPE.json --task TASK [--relation ID] REPLY.txt… [-o VOTES.json]",
                               "Reads the replies to one prompt and counts them as votes.",
                               {"--task", "--relation", "-o"},
                               {},
                               run};

}  // namespace parsel::cli
