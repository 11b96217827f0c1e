#include "core/infer/cad_task.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/family/vote.h"
#include "core/infer/cad_words.h"
#include "core/infer/kinds.h"
#include "core/infer/prompt.h"

namespace parsel {

namespace {

constexpr const char* stage = "infer/prompt";

}  // namespace

const CadTask kinds_task = {"kinds", "kinds of it", false};
const CadTask variation_task = {"variation", "a kind of it", true};

std::span<const CadTask* const> all_cad_tasks() {
  static constexpr std::array all = {&kinds_task, &variation_task};
  return all;
}

const CadTask* find_cad_task(std::string_view name) {
  const auto tasks = all_cad_tasks();
  const auto found = std::find_if(tasks.begin(), tasks.end(), [&](const CadTask* task) { return task->name == name; });
  return found == tasks.end() ? nullptr : *found;
}

Result<CadPrompt> make_prompt(const cad::Model& model, const CadTask& task, const CadWish& wish) {
  if (model.parts.size() > family::VoteLimits::parts) {
    return Error{stage, "", "the program has more than " + std::to_string(family::VoteLimits::parts) + " parts",
                 "ask about a smaller one"};
  }
  if (task.about_kind ? is_blank(wish.kind) : !wish.kind.empty()) {
    return Error{stage, "kind", task.about_kind ? "it is empty" : "the task is about all kinds",
                 task.about_kind ? "name a kind, such as: bench" : "leave the kind out"};
  }
  if (!is_utf8(wish.kind) || wish.kind.size() > family::VariationLimits::name_bytes) {
    return Error{stage, "kind",
                 "it is no text of at most " + std::to_string(family::VariationLimits::name_bytes) + " bytes",
                 "say it in a word or two"};
  }
  if (wish.count < 0 || wish.count > most_kinds || (task.about_kind && wish.count != 0)) {
    return Error{stage, "count",
                 "it is not from 1 to " + std::to_string(most_kinds) + ", or the task asks for one kind",
                 "ask for " + std::to_string(usual_kinds) + " kinds"};
  }
  Rendered made = render(task.name, {{"program", describe(model)},
                                     {"kind", quoted_words(wish.kind)},
                                     {"count", std::to_string(wish.count == 0 ? usual_kinds : wish.count)}});
  return CadPrompt{&task, std::move(made.text), std::move(made.hash), std::move(made.version)};
}

nlohmann::json to_json(const CadPrompt& prompt) {
  return {{"task", prompt.task->name}, {"text", prompt.text}, {"hash", prompt.hash}, {"version", prompt.version}};
}

}  // namespace parsel
