#include "core/infer/inference_json.h"

#include <nlohmann/json.hpp>

#include "core/infer/task_list.h"

namespace parsel {

using nlohmann::json;

Result<std::vector<Replies>> replies_from_json(const Shape& shape, const json& list) {
  const auto wrong = [](const std::string& place, const char* cause) {
    return Error{"infer/inference", place, cause, "give task, relation and texts of each prompt"};
  };
  if (!list.is_array()) return wrong("", "it is no list");
  std::vector<Replies> all;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string place = "/" + std::to_string(i);
    const json& entry = list[i];
    if (!entry.is_object()) return wrong(place, "it is no object");
    const json task = entry.value("task", json()), relation = entry.value("relation", json());
    const json texts = entry.value("texts", json());
    Replies replies;
    if (task.is_string()) replies.task = find_task(task.get_ref<const std::string&>());
    if (replies.task == nullptr) return wrong(place + "/task", "it is no task");
    if (relation.is_string()) replies.relation = shape.find_relation(relation.get_ref<const std::string&>());
    const auto asks_about = replies.task->asks_about;
    const bool fits =
        asks_about ? replies.relation && asks_about(shape.relations[*replies.relation].kind) : relation.is_null();
    if (!fits) return wrong(place + "/relation", "it is no relation that the task asks about");
    if (!texts.is_array()) return wrong(place + "/texts", "it is no list");
    for (const json& text : texts) {
      if (!text.is_string()) return wrong(place + "/texts", "it holds something else than texts");
      replies.texts.push_back(text.get<std::string>());
    }
    all.push_back(std::move(replies));
  }
  return all;
}

json to_json(const Shape& shape, const Inference& inference) {
  json refused = json::array();
  for (const RefusedReply& reply : inference.refused) {
    const Error& e = reply.error;
    refused.push_back({{"task", reply.task->name},
                       {"relation", reply.relation ? json(shape.relations[*reply.relation].id) : json()},
                       {"vote", reply.vote},
                       {"error", {{"stage", e.stage}, {"place", e.place}, {"cause", e.cause}, {"fix", e.fix}}}});
  }
  json out = {{"refused", std::move(refused)}, {"edit", inference.edit ? to_json(*inference.edit) : json()}};
  for (const Task* task : all_tasks()) task->write(shape, inference, out);
  return out;
}

}  // namespace parsel
