// How well plain requests are read, against readings written down by hand (tests/eval/plain.json, prompts/expected.json).
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/gallery/gallery.h"
#include "core/infer/plain_reading.h"
#include "core/infer/reading.h"
#include "core/infer/seed_edit.h"
#include "core/propagate/propagate.h"
#include "core/shape/abstraction.h"
#include "tests/core/tests_folder.h"

namespace parsel::test {

inline nlohmann::json json_file(const std::string& below_tests) {
  std::ifstream file(tests_folder() + "/" + below_tests);
  return nlohmann::json::parse(file);
}

inline const GalleryAsset& gallery_asset(const std::string& id) {
  static std::map<std::string, GalleryAsset> assets;
  const auto known = assets.find(id);
  if (known != assets.end()) return known->second;
  const GalleryModel* model = find_gallery_model(id);
  PARSEL_ASSERT(model != nullptr, id.c_str());
  return assets.emplace(id, *build(*model)).first->second;
}

inline const Shape& gallery_shape(const std::string& id) {
  static std::map<std::string, Shape> shapes;
  const auto known = shapes.find(id);
  if (known != shapes.end()) return known->second;
  return shapes.emplace(id, abstract_shape(gallery_asset(id).glb, id)->shape).first->second;
}

/// Corners of all parts and instances at a slider value, about their common middle.
inline std::vector<Vec3> corners_at(const Shape& shape, const Evaluator& evaluate, double x) {
  const State state = evaluate({x});
  std::vector<Vec3> all;
  const auto add = [&](const Corners& corners) {
    for (int k = 0; k < 8; ++k) all.push_back(corners.row(k).transpose());
  };
  for (const PartIndex p : shape.parts.indices()) {
    if (!shape.parts[p].group) add(state.parts[p]);
  }
  for (const RelationIndex r : shape.relations.indices()) {
    for (const Corners& instance : state.groups[r].instances) add(instance);
  }
  Vec3 low = all.front(), high = all.front();
  for (const Vec3& corner : all) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
  for (Vec3& corner : all) corner -= (low + high) / 2;
  return all;
}

/// Both were looked for on ± this; how far each slider then goes on is its own.
inline constexpr double searched = 0.35;

/// Least distance of the model under one edit, over its slider, from the one under another at 0.6 of `searched` upwards:
/// both must do the same when the slider goes up. Normalised, infinite when the numbers of parts never agree or an edit cannot be propagated.
inline double edit_distance(const Shape& shape, const EditRequest& edit, const EditRequest& truth) {
  const double infinite = std::numeric_limits<double>::infinity();
  const Result<Propagation> own = propagate(shape, edit), right = propagate(shape, truth);
  if (!own.ok() || !right.ok()) return infinite;
  const Evaluator at(own->program, shape), aim_at(right->program, shape);
  const Parameter &range = own->program.layers[0].parameter, &aimed = right->program.layers[0].parameter;
  const std::vector<Vec3> aim = corners_at(shape, aim_at, 0.6 * std::min(aimed.max, searched));
  const auto distance = [&](double x) {
    const std::vector<Vec3> here = corners_at(shape, at, x);
    if (here.size() != aim.size()) return infinite;
    double worst = 0;
    for (std::size_t i = 0; i < aim.size(); ++i) worst = std::max(worst, (here[i] - aim[i]).norm());
    return worst;
  };
  constexpr int steps = 60;
  double best = infinite, where = 0, step = range.max / steps;
  for (int i = 0; i <= steps; ++i) {
    const double d = distance(i * step);
    if (d < best) best = d, where = i * step;
  }
  for (int i = 0; i < 14; ++i) {
    step /= 2;
    for (const double x : {where - step, where + step}) {
      if (x < 0 || x > range.max) continue;
      if (const double d = distance(x); d < best) best = d, where = x;
    }
  }
  return best;
}

constexpr double same_mesh = 0.01;

struct PlainVerdict {
  bool sure = false, right = false;
  std::string why;  ///< what is wrong
};

inline EditRequest edit_of(const Shape& shape, const PlainReading& reading) {
  return *as_inference(shape, reading).edit;
}

/// Whether the amount is the one expected: {"of", "what", "by" | "to" | "times"}, or none.
inline bool same_target(const nlohmann::json& expected, const nlohmann::json& found) {
  if (expected.is_null() || found.is_null()) return expected.is_null() && found.is_null();
  if (expected["of"] != found["part"] || expected["what"] != found["what"]) return false;
  for (const char* kind : {"by", "to", "times"}) {
    if (expected.contains(kind) != found.contains(kind)) return false;
    if (expected.contains(kind) && std::abs(expected[kind].get<double>() - found[kind].get<double>()) > 1e-9)
      return false;
  }
  return true;
}

/// Whether mirror images give way; joints may, along which something slides.
inline bool breaks_mirrors(const Shape& shape, const EditRequest& edit) {
  return std::any_of(edit.disabled.begin(), edit.disabled.end(), [&](const std::string& id) {
    const auto relation = shape.find_relation(id);
    return relation && shape.relations[*relation].kind == RelationKind::reflection;
  });
}

/// An entry of tests/eval/plain.json: {"model", "request", "mentioned"?, "ask": true} for what must be asked about, else
/// {"edits", "or"?: other edits as right, "hints"?, "break"?: whether mirror images give way, "target"?}.
inline PlainVerdict judge(const nlohmann::json& entry) {
  const Shape& shape = gallery_shape(entry["model"].get<std::string>());
  EditWish wish{entry["request"].get<std::string>(), {}};
  for (const auto& id : entry.value("mentioned", nlohmann::json::array()))
    wish.mentioned.push_back(id.get<std::string>());
  const Result<PlainReading> read = read_plainly(shape, wish);
  PARSEL_ASSERT(read.ok(), "requests of the tests can be read");
  PlainVerdict verdict{read->sure, false, ""};
  if (entry.value("ask", false)) {
    verdict.right = !read->sure;
    if (read->sure) verdict.why = "sure of: " + read->words.front();
    return verdict;
  }
  if (!read->sure) {
    verdict.why = read->reason;
    for (const std::string& word : read->unused) verdict.why += " [" + word + "]";
    for (const std::string& words : read->words) verdict.why += " | " + words;
    return verdict;
  }
  const EditRequest own = edit_of(shape, *read);
  std::vector<nlohmann::json> accepted = {entry["edits"]};
  for (const auto& other : entry.value("or", nlohmann::json::array())) accepted.push_back(other);
  std::map<std::string, Hint> hints;
  const nlohmann::json given = entry.value("hints", nlohmann::json::object());
  for (const auto& [part, hint] : given.items()) hints[part] = *hint_from_string(hint.get<std::string>());
  const bool breaks = entry.value("break", false);
  bool any = false;
  double nearest = 1e9;
  for (const auto& edits : accepted) {
    const Result<SeedReply> expected =
        read_seed_reply(shape, "```json\n" + nlohmann::json{{"edits", edits}}.dump() + "\n```");
    PARSEL_ASSERT(
        expected.ok(),
        (entry["request"].get<std::string>() + ": " + (expected.ok() ? "" : expected.error().message())).c_str());
    const bool same = reading_signature(shape, own.seed) == reading_signature(shape, expected->statements) &&
                      own.hints == hints && breaks_mirrors(shape, own) == breaks;
    any = any || same;
    if (any) break;
    nearest = std::min(nearest, edit_distance(shape, own, {expected->statements, own.disabled, hints}));
  }
  any = any || (nearest <= same_mesh && breaks_mirrors(shape, own) == breaks);
  const nlohmann::json found = to_json(shape, *read)["plain"]["readings"][0]["target"];
  const bool target = same_target(entry.value("target", nlohmann::json()), found);
  verdict.right = any && target;
  if (!verdict.right) {
    verdict.why =
        read->words.front() + (any ? "" : ", another edit") + (target ? "" : ", another amount: " + found.dump());
    if (!any) verdict.why += ", off by " + std::to_string(nearest);
    for (const auto& [part, hint] : own.hints) verdict.why += " " + part + ":" + std::string(to_string(hint));
  }
  return verdict;
}

/// What a language model's recorded replies to a request, voted, come to; nothing when they are missing or unclear.
inline std::optional<EditRequest> voted_edit(const Shape& shape, const EditWish& wish) {
  std::vector<Replies> replies;
  const Result<std::vector<Prompt>> prompts = make_prompts(shape, wish);
  PARSEL_ASSERT(prompts.ok(), "recorded requests can be asked");
  for (const Prompt& prompt : *prompts) {
    std::ifstream file(tests_folder() + "/../prompts/recordings/" + prompt.hash + ".json");
    if (!file) return std::nullopt;
    replies.push_back({prompt.task, prompt.relation, {}});
    const nlohmann::json recording = nlohmann::json::parse(file);
    for (const auto& reply : recording["replies"]) replies.back().texts.push_back(reply["text"].get<std::string>());
  }
  const Inference inference = infer(shape, replies);
  if (inference.seed.outcome != SeedVote::Outcome::decided) return std::nullopt;
  return inference.edit;
}

/// An entry of prompts/expected.json.
inline PlainVerdict judge_recorded(const nlohmann::json& entry) {
  const std::string model = entry["model"].get<std::string>();
  const Shape& shape = gallery_shape(model);
  const Result<PlainReading> read = read_plainly(shape, {entry["request"].get<std::string>(), {}});
  PARSEL_ASSERT(read.ok(), "recorded requests can be read");
  PlainVerdict verdict{read->sure, false, ""};
  if (!read->sure) {
    verdict.right = entry.value("unclear", false);
    verdict.why = read->reason;
    for (const std::string& word : read->unused) verdict.why += " [" + word + "]";
    return verdict;
  }
  if (entry.value("unclear", false)) {
    verdict.why = "sure of: " + read->words.front();
    return verdict;
  }
  nlohmann::json edit = entry.value("edit", nlohmann::json());
  for (const GalleryEdit& known : gallery_asset(model).edits) {
    if (edit.is_null() && entry.value("gallery", "") == known.id) edit = nlohmann::json::parse(known.json);
  }
  const EditRequest truth = *edit_request_from_json(edit);
  const double distance = edit_distance(shape, edit_of(shape, *read), truth);
  verdict.right = distance <= same_mesh;
  if (!verdict.right) verdict.why = read->words.front() + ", off by " + std::to_string(distance);
  return verdict;
}

}  // namespace parsel::test
