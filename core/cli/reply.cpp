// parsel reply: what the replies of a language model mean, counted as votes.
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/cad_model.h"
#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/task.h"
#include "core/infer/cad_task.h"
#include "core/infer/inference_json.h"
#include "core/infer/variation_reply.h"

namespace parsel::cli {
namespace {

/// The texts of the reply files.
Result<std::vector<std::string>> texts_of(const Arguments& arguments) {
  std::vector<std::string> texts;
  for (std::size_t i = 1; i < arguments.positional.size(); ++i) {
    Result<std::string> text = read_file(arguments.positional[i]);
    if (!text.ok()) return text.error();
    texts.push_back(std::move(*text));
  }
  return texts;
}

/// Replies about a CAD program. Those about a kind are written as parsel/variations, which `parsel family` reads.
int read_about_program(const Arguments& arguments, const CadTask& task) {
  if (task.about_kind != arguments.has("--kind")) {
    return misuse(task.about_kind ? "variation needs --kind, the one that was asked about" : "kinds takes no --kind");
  }
  const Result<cad::Model> model = read_cad(arguments.positional[0], "mm");
  if (!model.ok()) return refuse(model.error());
  const Result<std::vector<std::string>> texts = texts_of(arguments);
  if (!texts.ok()) return refuse(texts.error());
  const Result<nlohmann::json> read =
      task.about_kind ? read_variation(*model, arguments.option("--kind"), *texts) : read_kinds(*model, *texts);
  if (!read.ok()) return refuse(within(read.error(), arguments.positional[1]));
  for (const nlohmann::json& refused : (*read)["refused"]) {
    std::cerr << "warning: " << arguments.positional[refused["vote"].get<std::size_t>() + 1] << ": "
              << refused["error"]["place"].get<std::string>() << ": " << refused["error"]["cause"].get<std::string>()
              << '\n';
  }
  return write_json(arguments, task.about_kind ? (*read)["variation"] : *read);
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() < 2) return misuse("reply takes a model and at least one reply");
  if (!arguments.has("--task")) return misuse("reply needs --task, the one that the replies answer");
  const CadTask* about_program = find_cad_task(arguments.option("--task"));
  if (about_program != nullptr) return read_about_program(arguments, *about_program);
  if (arguments.has("--kind")) return misuse("--kind is for the task variation");
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape.ok()) return refuse(shape.error());
  const Result<AskedTask> asked = asked_task(arguments, *shape);
  if (!asked.ok()) return refuse(asked.error());
  const Result<std::vector<std::string>> texts = texts_of(arguments);
  if (!texts.ok()) return refuse(texts.error());
  const Replies replies{asked->task, asked->relation, *texts};
  const Inference inference = infer(*shape, {replies});
  if (inference.refused.size() == replies.texts.size()) {  // then there is nothing to count
    return refuse(within(inference.refused.front().error, arguments.positional[1]));
  }
  return write_json(arguments, to_json(*shape, inference));
}

}  // namespace

extern const Command reply_command;
const Command reply_command = {"reply",
                               "MODEL.glb|SHAPE.json|PROGRAM.scad --task TASK [--relation ID] [--kind NAME] REPLY.txt… "
                               "[-o VOTES.json]",
                               "Reads the replies to one prompt and counts them as votes; those to variation become a "
                               "parsel/variations of one.",
                               {"--task", "--relation", "--kind", "-o"},
                               {},
                               run};

}  // namespace parsel::cli
