// parsel prompt: what a language model is asked about a model and a request.
#include <charconv>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/task.h"
#include "core/infer/prompt.h"

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

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("prompt takes one model");
  if (arguments.has("--all") == arguments.has("--task")) return misuse("prompt takes either --task or --all");
  const Task* task = find_task(arguments.option("--task"));
  if (!arguments.has("--request") && (task == nullptr || task->about_request)) {
    return misuse("prompt needs --request, such as --request \"widen the chair\"");
  }
  int count = 0;
  if (const std::string given = arguments.option("--count", "0"); arguments.has("--count")) {
    const auto [end, fault] = std::from_chars(given.data(), given.data() + given.size(), count);
    if (fault != std::errc() || end != given.data() + given.size() || count < 1) {
      return misuse("--count takes a whole number from 1");
    }
  }
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape.ok()) return refuse(shape.error());
  EditWish wish{arguments.option("--request"), {}, count, arguments.has("--picture")};
  const auto [first, last] = arguments.options.equal_range("--mention");
  for (auto mention = first; mention != last; ++mention) wish.mentioned.push_back(mention->second);
  if (arguments.has("--all")) return write_all(arguments, *shape, wish);

  const Result<AskedTask> asked = asked_task(arguments, *shape);
  if (!asked.ok()) return refuse(asked.error());
  const Result<Prompt> prompt = make_prompt(*shape, wish, *asked->task, asked->relation);
  if (!prompt.ok()) return refuse(prompt.error());
  if (!arguments.has("-o")) {
    std::cout << prompt->text;
    return std::cout.flush() ? exit_done : exit_refused;
  }
  const Status written = write_file(arguments.option("-o"), prompt->text);
  return written.ok() ? exit_done : refuse(written.error());
}

}  // namespace

extern const Command prompt_command;
const Command prompt_command = {
    "prompt",
    "MODEL.glb|SHAPE.json --request TEXT (--task TASK [--relation ID] [-o PROMPT.md] | --all DIR) [--mention PART]… "
    "[--count N] [--picture]",
    "Prints what a language model is asked (--all: every prompt that the request is read by, as DIR/<hash>.md). "
    "procedural_requests takes no request; --count and --picture are for tasks that propose.",
    {"--request", "--task", "--relation", "--mention", "--all", "--count", "-o"},
    {"--picture"},
    run};

}  // namespace parsel::cli
