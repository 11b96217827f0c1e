#include "core/infer/inference.h"

#include <nlohmann/json.hpp>

#include "core/shape/words.h"

namespace parsel {

using nlohmann::json;

namespace {

/// What can be read of the replies to one prompt; the rest goes to `refused`.
template <class Meaning, class Read>
std::vector<Meaning> read_all(const Replies& replies, std::vector<RefusedReply>& refused, const Read& read) {
  std::vector<Meaning> meanings;
  for (std::size_t i = 0; i < replies.texts.size(); ++i) {
    Result<Meaning> meaning = read(replies.texts[i]);
    if (meaning.ok()) {
      meanings.push_back(std::move(*meaning));
    } else {
      refused.push_back({replies.task, replies.relation, i, meaning.error()});
    }
  }
  return meanings;
}

json id_or_null(const Shape& shape, const std::optional<RelationIndex>& relation) {
  return relation ? json(shape.relations[*relation].id) : json();
}

}  // namespace

Inference infer(const Shape& shape, const std::vector<Replies>& all) {
  Inference result;
  std::vector<SeedReply> seeds;
  std::vector<std::map<std::string, Hint>> hints;
  for (const Replies& replies : all) {
    if (replies.task == Task::seed_edit) {
      for (SeedReply& reply : read_all<SeedReply>(
               replies, result.refused, [&](const std::string& text) { return read_seed_reply(shape, text); })) {
        seeds.push_back(std::move(reply));
      }
    } else if (replies.task == Task::type_hints) {
      for (auto& reply : read_all<std::map<std::string, Hint>>(
               replies, result.refused, [&](const std::string& text) { return read_hints_reply(shape, text); })) {
        hints.push_back(std::move(reply));
      }
    } else {
      const RelationIndex relation = *replies.relation;
      result.relations.push_back(vote(relation, read_all<bool>(replies, result.refused, [&](const std::string& text) {
                                        return read_validity_reply(shape, relation, text);
                                      })));
    }
  }
  result.seed = vote(shape, seeds);
  result.hints = vote(hints);
  if (!result.seed.readings.empty()) {
    result.edit = assemble(shape, result.seed.readings.front().statements, result.hints, result.relations);
  }
  return result;
}

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
    const auto known = task.is_string() ? task_from_string(task.get_ref<const std::string&>()) : std::nullopt;
    if (!known) return wrong(place + "/task", "it is no task");
    replies.task = *known;
    if (relation.is_string()) replies.relation = shape.find_relation(relation.get_ref<const std::string&>());
    const bool fits = is_validity(*known)
                          ? replies.relation && validity_task(shape.relations[*replies.relation].kind) == *known
                          : relation.is_null();
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
  json readings = json::array(), hints = json::array(), relations = json::array(), refused = json::array();
  for (const Reading& reading : inference.seed.readings) {
    readings.push_back({{"statements", to_json(EditRequest{reading.statements, {}, {}})["seed"]},
                        {"words", reading.words},
                        {"votes", reading.votes}});
  }
  for (const HintVote& hint : inference.hints) {
    hints.push_back({{"part", hint.part}, {"hint", to_string(hint.hint)}, {"votes", hint.votes}, {"of", hint.of}});
  }
  for (const RelationVote& vote : inference.relations) {
    relations.push_back({{"relation", shape.relations[vote.relation].id},
                         {"keep", vote.keep},
                         {"votes", vote.votes},
                         {"of", vote.of},
                         {"words", describe(shape, vote.relation)}});
  }
  for (const RefusedReply& reply : inference.refused) {
    const Error& e = reply.error;
    refused.push_back({{"task", to_string(reply.task)},
                       {"relation", id_or_null(shape, reply.relation)},
                       {"vote", reply.vote},
                       {"error", {{"stage", e.stage}, {"place", e.place}, {"cause", e.cause}, {"fix", e.fix}}}});
  }
  const SeedVote& seed = inference.seed;
  return {{"seed",
           {{"outcome", to_string(seed.outcome)},
            {"readings", std::move(readings)},
            {"of", seed.of},
            {"reason", seed.reason ? json(*seed.reason) : json()}}},
          {"hints", std::move(hints)},
          {"relations", std::move(relations)},
          {"refused", std::move(refused)},
          {"edit", inference.edit ? to_json(*inference.edit) : json()}};
}

}  // namespace parsel
