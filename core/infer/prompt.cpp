#include "core/infer/prompt.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/edit/program_fields.h"
#include "core/infer/prompt_texts.h"
#include "core/infer/proposals.h"
#include "core/infer/task_list.h"
#include "core/shape/words.h"

namespace parsel {

namespace {

constexpr const char* stage = "infer/prompt";

struct Template {
  std::string_view version, text;
};

const PromptText& text_of(std::string_view task) {
  const auto texts = prompt_texts();
  const auto found = std::find_if(texts.begin(), texts.end(), [&](const PromptText& t) { return t.task == task; });
  PARSEL_ASSERT(found != texts.end(), "every task has a template");
  return *found;
}

/// The first line is "<!-- version N -->", then a blank one.
Template read_template(std::string_view task) {
  const std::string_view file = text_of(task).markdown;
  constexpr std::string_view opening = "<!-- version ", closing = " -->\n\n";
  const std::size_t end = file.find(closing);
  PARSEL_ASSERT(file.starts_with(opening) && end != file.npos, "a template begins with its version");
  return {file.substr(opening.size(), end - opening.size()), file.substr(end + closing.size())};
}

std::string fill(std::string_view text, const Places& places) {
  std::string out;
  while (true) {
    const std::size_t open = text.find("{{");
    out += text.substr(0, open);
    if (open == text.npos) return out;
    const std::size_t close = text.find("}}", open);
    PARSEL_ASSERT(close != text.npos, "a template closes its places");
    const auto place = places.find(text.substr(open + 2, close - open - 2));
    PARSEL_ASSERT(place != places.end(), "a template names known places only");
    out += place->second;
    text.remove_prefix(close + 2);
  }
}

Status check(const EditWish& wish) {
  if (is_blank(wish.request)) {
    return Error{stage, "request", "it is empty", "say what to change, such as: widen the chair"};
  }
  const std::string fault = prose_fault(wish.request, ProgramLimits::request_bytes);
  if (!fault.empty()) return Error{stage, "request", fault, "say it shorter and in plain text"};
  return success();
}

Status check(const EditWish& wish, const Task& task) {
  if (task.about_request) {
    if (const Status checked = check(wish); !checked.ok()) return checked;
  } else if (!wish.request.empty()) {
    return Error{stage, "request", "the task " + std::string(task.name) + " is about the model alone",
                 "leave the request out"};
  }
  if ((task.proposals == 0 && wish.count != 0) || (!task.is_alone() && wish.picture)) {
    return Error{stage, wish.count != 0 ? "count" : "picture", "the task " + std::string(task.name) + " takes none",
                 "leave it out"};
  }
  if (wish.count < 0 || wish.count > most_proposals) {
    return Error{stage, "count", "it is not from 1 to " + std::to_string(most_proposals),
                 "ask for " + std::to_string(task.proposals)};
  }
  return success();
}

/// A paragraph.
std::string picture_words(const Shape& shape, const Task& task) {
  std::string text = "The picture shows the model from its front, its left side and above, with numbers on its parts";
  if (task.numbered != nullptr) return text + ": 1 on part_1, and so on.\n";
  int number = 0;
  for (const PartIndex part : numbered_parts(shape, task)) {
    text += (number == 0 ? ": " : ", ") + std::to_string(number + 1) + " " + shape.parts[part].id;
    ++number;
  }
  return text + ".\n";
}

Result<std::vector<PartIndex>> mentioned_parts(const Shape& shape, const EditWish& wish) {
  std::vector<PartIndex> mentioned;
  for (const std::string& id : wish.mentioned) {
    const auto part = shape.find_part(id);
    if (!part) return Error{stage, "mentioned", "the shape has no part " + shown(id), "point at parts of this model"};
    mentioned.push_back(*part);
  }
  return mentioned;
}

}  // namespace

std::string quoted_words(std::string_view words) {
  std::string text = printable(words, ProgramLimits::request_bytes);
  for (char& c : text) {
    if (c == '`') c = '\'';
  }
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Rendered render(std::string_view task, const Places& places) {
  const Template from = read_template(task);
  Rendered made{fill(from.text, places), {}, std::string(from.version)};
  made.hash = sha256_hex(made.text);
  return made;
}

Result<std::vector<PartIndex>> check_wish(const Shape& shape, const EditWish& wish) {
  if (const Status checked = check(wish); !checked.ok()) return checked.error();
  return mentioned_parts(shape, wish);
}

std::vector<PartIndex> numbered_parts(const Shape& shape, const Task& task) {
  return task.numbered == nullptr ? active_parts(shape) : task.numbered(shape);
}

Result<Prompt> make_prompt(const Shape& shape, const EditWish& wish, const Task& task, AboutRelation relation) {
  if (const Status checked = check(wish, task); !checked.ok()) return checked.error();
  if (relation && (!task.asks_about || !task.asks_about(shape.relations[*relation].kind))) {
    return Error{stage, shape.relations[*relation].id,
                 "the task " + std::string(task.name) + " does not ask about this relation",
                 "ask about a reflection or a group with the task for its kind"};
  }
  if (!relation && task.asks_about) {
    return Error{stage, "relation", "the task " + std::string(task.name) + " asks about one relation",
                 "name a relation, such as r1 or t1"};
  }
  if (task.numbered != nullptr && task.numbered(shape).size() > most_numbered) {
    return Error{stage, "", "the model has more than " + std::to_string(most_numbered) + " parts to be listed",
                 "ask about a model of fewer, or split it more coarsely"};
  }
  const Result<std::vector<PartIndex>> parts = mentioned_parts(shape, wish);
  if (!parts.ok()) return parts.error();
  std::string mentioned;
  for (const PartIndex part : *parts) mentioned += (mentioned.empty() ? "" : ", ") + shape.parts[part].id;
  Places places = {{"shape", describe(shape)},
                   {"request", quoted_words(wish.request)},
                   {"mentioned", mentioned.empty() ? "none" : mentioned},
                   {"count", std::to_string(wish.count == 0 ? task.proposals : wish.count)},
                   {"picture", wish.picture ? picture_words(shape, task) : ""}};
  if (task.places) places.merge(task.places(shape, relation));
  Rendered made = render(task.name, places);
  return Prompt{&task, relation, std::move(made.text), std::move(made.hash), std::move(made.version)};
}

Result<std::vector<Prompt>> make_prompts(const Shape& shape, const EditWish& wish) {
  std::vector<Prompt> prompts;
  const auto add = [&](const Task* task, AboutRelation relation) -> Status {
    Result<Prompt> prompt = make_prompt(shape, wish, *task, relation);
    if (!prompt.ok()) return prompt.error();
    prompts.push_back(std::move(*prompt));
    return success();
  };
  for (const Task* task : all_tasks()) {
    if (task->asks_about || task->is_alone()) continue;
    if (const Status s = add(task, {}); !s.ok()) return s.error();
  }
  for (const RelationIndex r : active_relations(shape)) {
    const Task* task = task_about(shape.relations[r].kind);
    if (task == nullptr) continue;
    if (const Status s = add(task, r); !s.ok()) return s.error();
  }
  return prompts;
}

nlohmann::json to_json(const Shape& shape, const Prompt& prompt) {
  return {{"task", prompt.task->name},
          {"relation", prompt.relation ? nlohmann::json(shape.relations[*prompt.relation].id) : nlohmann::json()},
          {"text", prompt.text},
          {"hash", prompt.hash},
          {"version", prompt.version}};
}

nlohmann::json reply_schema(std::string_view task) {
  return nlohmann::json::parse(text_of(task).schema);
}

nlohmann::json reply_schema(const Task& task) {
  return reply_schema(task.name);
}

}  // namespace parsel
