// parsel prompt: what a language model is asked about a model and a request.
#include <charconv>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/cli/cad_model.h"
#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/task.h"
#include "core/infer/cad_task.h"
#include "core/infer/prompt.h"
#include "core/infer/task_list.h"

namespace parsel::cli {
namespace {

/// Every prompt of the request into a file named by its hash; the list of them as JSON.
int write_all(const Arguments& arguments, const Shape& shape, const EditWish& wish) {
  const Result<std::vector<Prompt>> prompts = make_prompts(shape, wish);
  if (!prompts.ok()) return refuse(prompts.error());
  nlohmann::json list = nlohmann::json::array();
  for (const Prompt& prompt : *prompts) {
    const std::string file = prompt.hash + ".md";
    const Status written = write_file(arguments.option("--all") + "/" + file, prompt.text);
    if (!written.ok()) return refuse(written.error());
    nlohmann::json entry = to_json(shape, prompt);
    entry.erase("text");
    entry["file"] = file;
    list.push_back(std::move(entry));
  }
  return write_json(arguments, {{"request", wish.request}, {"prompts", std::move(list)}});
}

/// --count as a number, 0 without; nothing when it is none.
std::optional<int> count_of(const Arguments& arguments) {
  if (!arguments.has("--count")) return 0;
  const std::string given = arguments.option("--count");
  int count = 0;
  const auto [end, fault] = std::from_chars(given.data(), given.data() + given.size(), count);
  if (fault != std::errc() || end != given.data() + given.size() || count < 1) return std::nullopt;
  return count;
}

int write_text(const Arguments& arguments, const std::string& text) {
  if (!arguments.has("-o")) {
    std::cout << text;
    return std::cout.flush() ? exit_done : exit_refused;
  }
  const Status written = write_file(arguments.option("-o"), text);
  return written.ok() ? exit_done : refuse(written.error());
}

/// What is asked about a CAD program.
int ask_about_program(const Arguments& arguments, const CadTask& task, int count) {
  const Result<cad::Model> model = read_cad(arguments.positional[0], "mm");
  if (!model.ok()) return refuse(model.error());
  const Result<CadPrompt> prompt = make_prompt(*model, task, {arguments.option("--kind"), count});
  return prompt.ok() ? write_text(arguments, prompt->text) : refuse(prompt.error());
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("prompt takes one model");
  if (arguments.has("--all") == arguments.has("--task")) return misuse("prompt takes either --task or --all");
  const std::optional<int> count = count_of(arguments);
  if (!count) return misuse("--count takes a whole number from 1");
  const CadTask* about_program = find_cad_task(arguments.option("--task"));
  if (about_program != nullptr) return ask_about_program(arguments, *about_program, *count);
  if (arguments.has("--kind")) return misuse("--kind is for the task variation");
  const Task* task = find_task(arguments.option("--task"));
  if (!arguments.has("--request") && (task == nullptr || task->about_request)) {
    return misuse("prompt needs --request, such as --request \"widen the chair\"");
  }
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape.ok()) return refuse(shape.error());
  EditWish wish{arguments.option("--request"), {}, *count, arguments.has("--picture")};
  const auto [first, last] = arguments.options.equal_range("--mention");
  for (auto mention = first; mention != last; ++mention) wish.mentioned.push_back(mention->second);
  if (arguments.has("--all")) return write_all(arguments, *shape, wish);

  const Result<AskedTask> asked = asked_task(arguments, *shape);
  if (!asked.ok()) return refuse(asked.error());
  const Result<Prompt> prompt = make_prompt(*shape, wish, *asked->task, asked->relation);
  if (!prompt.ok()) return refuse(prompt.error());
  return write_text(arguments, prompt->text);
}

}  // namespace

extern const Command prompt_command;
const Command prompt_command = {
    "prompt",
    "MODEL.glb|SHAPE.json|PROGRAM.scad --request TEXT (--task TASK [--relation ID] [-o PROMPT.md] | --all DIR) "
    "[--mention PART]… [--kind NAME] [--count N] [--picture]",
    "Prints what a language model is asked (--all: every prompt that the request is read by, as DIR/<hash>.md). "
    "procedural_requests and part_names take no request; kinds and variation are about a CAD program, variation about "
    "one "
    "--kind of it; --count and --picture are for tasks that are asked on their own.",
    {"--request", "--task", "--relation", "--mention", "--all", "--kind", "--count", "-o"},
    {"--picture"},
    run};

}  // namespace parsel::cli
