#include "core/cli/job_request.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "core/edit/program_fields.h"
#include "core/prove/together.h"

namespace parsel::cli {
namespace {

using nlohmann::json;

constexpr std::size_t most_entries = 1000;

Error refused(std::string place, std::string cause, std::string fix) {
  return {"cli/job", std::move(place), std::move(cause), std::move(fix)};
}

/// An object with no other keys than these.
Status only_keys(const json& object, const std::string& place, std::initializer_list<std::string_view> keys) {
  if (!object.is_object()) return refused(place, "is no JSON object", "write {…}");
  for (const auto& [key, value] : object.items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    std::string known;
    for (const std::string_view name : keys) known += (known.empty() ? "" : ", ") + std::string(name);
    return refused(place + "/" + pointer_token(key), "is not known here", "use " + known);
  }
  return success();
}

Result<std::string> text_of(const json& object, const std::string& place, const std::string& key) {
  const json value = object.value(key, json(""));
  if (!value.is_string()) return refused(place + "/" + key, "is no text", "write it in quotes");
  return value.get<std::string>();
}

Result<bool> flag_of(const json& object, const std::string& place, const std::string& key) {
  const json value = object.value(key, json(false));
  if (!value.is_boolean()) return refused(place + "/" + key, "is neither true nor false", "write one of them");
  return value.get<bool>();
}

Result<json> list_of(const json& object, const std::string& place, const std::string& key) {
  json list = object.value(key, json::array());
  if (!list.is_array()) return refused(place + "/" + key, "is no list", "write […]");
  if (list.size() > most_entries) {
    return refused(place + "/" + key, "has more than " + std::to_string(most_entries) + " entries", "use several jobs");
  }
  return list;
}

Result<std::vector<std::string>> texts_of(const json& object, const std::string& place, const std::string& key) {
  const Result<json> list = list_of(object, place, key);
  if (!list) return list.error();
  std::vector<std::string> texts;
  for (const json& entry : *list) {
    if (!entry.is_string()) return refused(place + "/" + key, "is no list of ids", "write [\"seat\", …]");
    texts.push_back(entry.get<std::string>());
  }
  return texts;
}

Result<JobEdit> edit_of(const json& object, const std::string& place) {
  if (const Status known = only_keys(object, place, {"request", "mention", "edit", "program"}); !known) {
    return known.error();
  }
  JobEdit edit;
  const bool edits = object.contains("edit"), runs = object.contains("program");
  if (int{edits} + int{runs} > 1 || (runs && object.contains("request")) ||
      !(edits || runs || object.contains("request")))
    return refused(place, "is not one edit", "give a request, an edit or a program");
  const Result<std::string> request = text_of(object, place, "request");
  if (!request) return request.error();
  auto mentioned = texts_of(object, place, "mention");
  if (!mentioned) return mentioned.error();
  edit.wish = {*request, std::move(*mentioned)};
  if (!edits && !runs) return edit;
  if (object.contains("mention")) return refused(place + "/mention", "belongs to a request alone", "leave it out");
  edit.kind = edits ? JobEdit::Kind::edit : JobEdit::Kind::program;
  edit.given = object[edits ? "edit" : "program"];
  if (!edit.given.is_string() && !edit.given.is_object()) {
    return refused(place + (edits ? "/edit" : "/program"), "is neither an object nor the path of a file", "give one");
  }
  return edit;
}

Result<JobApply> apply_of(const json& object, const std::string& place) {
  if (const Status known = only_keys(object, place, {"set", "animate", "morph", "only"}); !known) return known.error();
  JobApply apply;
  const json set = object.value("set", json::object());
  if (!set.is_object()) return refused(place + "/set", "is no JSON object", "write {\"x1\": 0.2}");
  for (const auto& [name, value] : set.items()) {
    if (!value.is_number()) return refused(place + "/set/" + pointer_token(name), "is no number", "write one");
    apply.set[name] = value.get<double>();
  }
  const auto animate = text_of(object, place, "animate");
  if (!animate) return animate.error();
  const auto morph = flag_of(object, place, "morph");
  if (!morph) return morph.error();
  auto only = texts_of(object, place, "only");
  if (!only) return only.error();
  if (*morph && !animate->empty()) return refused(place, "has both animate and morph", "leave one of them out");
  apply.animate = *animate;
  apply.morph = *morph;
  apply.only = std::move(*only);
  return apply;
}

Result<JobSiblings> siblings_of(const json& object) {
  const std::string place = "/siblings";
  if (const Status known = only_keys(object, place, {"count", "seed"}); !known) return known.error();
  const json count = object.value("count", json(JobSiblings{}.count)), seed = object.value("seed", json(1));
  if (!count.is_number_integer() || count < 1 || count > most_siblings) {
    return refused(place + "/count", "is no whole number from 1 to " + std::to_string(most_siblings), "write one");
  }
  if (!seed.is_number_integer() || seed < 0) return refused(place + "/seed", "is no whole number from 0", "write one");
  return JobSiblings{count.get<int>(), seed.get<std::uint64_t>()};
}

}  // namespace

Result<Job> job_from_json(const json& given) {
  if (const Status known = only_keys(
          given, "",
          {"model", "id", "labels", "corrections", "edits", "apply", "siblings", "shape", "format", "version"});
      !known) {
    return known.error();
  }
  if (given.value("format", json("parsel/job")) != "parsel/job") {
    return refused("/format", "this is no job", "give one of format \"parsel/job\"");
  }
  if (given.value("version", json(1)) != 1) return refused("/version", "this version is unknown", "use version 1");
  Job job;
  const auto id = text_of(given, "", "id"), model = text_of(given, "", "model");
  if (!id) return id.error();
  if (!model) return model.error();
  if (model->empty()) return refused("/model", "is missing", "give the path of a .glb or .gltf file");
  job.id = *id;
  job.model = *model;
  const json labels = given.value("labels", json::object());
  if (!labels.is_object()) return refused("/labels", "is no JSON object", "write {\"node:3\": \"leg\"}");
  for (const auto& [part, label] : labels.items()) {
    if (!label.is_string()) return refused("/labels/" + pointer_token(part), "is no text", "write it in quotes");
    job.labels[part] = label.get<std::string>();
  }
  Result<Corrections> corrections = corrections_from_json(given.value("corrections", json::array()));
  if (!corrections) {
    Error error = corrections.error();
    error.place.insert(0, "/corrections");
    return error;
  }
  job.corrections = std::move(*corrections);
  const auto edits = list_of(given, "", "edits"), applies = list_of(given, "", "apply");
  if (!edits) return edits.error();
  if (!applies) return applies.error();
  for (std::size_t i = 0; i < edits->size(); ++i) {
    Result<JobEdit> edit = edit_of((*edits)[i], "/edits/" + std::to_string(i));
    if (!edit) return edit.error();
    job.edits.push_back(std::move(*edit));
  }
  for (std::size_t i = 0; i < applies->size(); ++i) {
    Result<JobApply> apply = apply_of((*applies)[i], "/apply/" + std::to_string(i));
    if (!apply) return apply.error();
    job.apply.push_back(std::move(*apply));
  }
  if (given.contains("siblings")) {
    const Result<JobSiblings> siblings = siblings_of(given["siblings"]);
    if (!siblings) return siblings.error();
    job.siblings = *siblings;
  }
  if (job.edits.empty() && (!job.apply.empty() || job.siblings)) {
    return refused("/edits", "is missing", "apply and siblings need at least one edit");
  }
  const Result<bool> shape = flag_of(given, "", "shape");
  if (!shape) return shape.error();
  job.shape = *shape;
  return job;
}

}  // namespace parsel::cli
