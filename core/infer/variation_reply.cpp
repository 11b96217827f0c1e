#include "core/infer/variation_reply.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/edit/program_fields.h"
#include "core/infer/kinds.h"
#include "core/infer/reply_block.h"

namespace parsel {

namespace {

using family::Ballot;
using family::Layout;
using nlohmann::json;

constexpr const char* form = "write [[x0, x1], [y0, y1], [z0, z1]] or \"absent\"";

bool is_coordinate(const json& number) {
  return number.is_number() && std::abs(number.get<double>()) <= cad::Limits::coordinate;
}

/// What is wrong with a part's bounds, a clause; empty when they are in `values`.
std::string bounds_into(const Layout& layout, const cad::Part& part, std::size_t p, const json& bounds,
                        family::Values& values) {
  const bool is_cone = part.kind == cad::Kind::cone;
  if (!bounds.is_array() || bounds.size() < 3) return "it has no three pairs of bounds";
  if (bounds.size() > (is_cone ? 4u : 3u)) return "it has more than its bounds";
  for (int axis = 0; axis < 3; ++axis) {
    const json& pair = bounds[static_cast<std::size_t>(axis)];
    const std::string along = std::string("its bounds along ") + "xyz"[axis];
    if (!pair.is_array() || pair.size() != 2 || !is_coordinate(pair[0]) || !is_coordinate(pair[1])) {
      return along + " are no pair of numbers up to a million";
    }
    const double low = pair[0], high = pair[1];
    if (!(low < high)) return along + " enclose nothing: the lower one is not below the upper one";
    values[static_cast<Eigen::Index>(layout.centre(p, axis))] = (low + high) / 2;
    values[static_cast<Eigen::Index>(layout.extent(p, axis))] = high - low;
  }
  if (!is_cone) return "";
  if (bounds.size() < 4) return "the diameter of its top is missing";
  if (!is_coordinate(bounds[3]) || bounds[3].get<double>() < 0) return "its top is no diameter";
  values[static_cast<Eigen::Index>(layout.top(p))] = bounds[3];
  return "";
}

Result<Ballot> ballot_of(const cad::Model& model, const Layout& layout, const json& block) {
  const json& parts = block.is_object() ? member(block, {"parts"}) : block;
  if (!parts.is_object()) {
    return reply_refused("/parts", "it is no object of bounds by part", R"(write {"parts": {"id": …}})");
  }
  Ballot ballot{values_of(layout, model), std::vector<bool>(model.parts.size(), false)};
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const cad::Part& part = model.parts[p];
    const auto given = parts.find(part.id);
    if (given == parts.end()) return reply_refused("/parts/" + part.id, "the part is missing", form);
    if (*given == "absent") {
      ballot.absent[p] = true;
      continue;
    }
    const std::string fault = bounds_into(layout, part, p, *given, ballot.values);
    if (!fault.empty()) return reply_refused("/parts/" + part.id, fault, form);
  }
  for (const auto& [id, _] : parts.items()) {
    if (model.find(id) == nullptr) {
      return reply_refused("/parts", "the program has no part " + shown(id), "name the parts by the ids of the list");
    }
  }
  if (std::all_of(ballot.absent.begin(), ballot.absent.end(), [](bool b) { return b; })) {
    return reply_refused("/parts", "no part is left", "leave at least one");
  }
  return ballot;
}

/// The meanings of those that can be read; the others go into `refused`. The first error when none can.
template <class T, class Read>
Result<std::vector<T>> readable(const std::vector<std::string>& texts, json& refused, const Read& read) {
  std::vector<T> meanings;
  std::optional<Error> first;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    Result<T> meaning = read(texts[i]);
    if (meaning.ok()) {
      meanings.push_back(std::move(*meaning));
      continue;
    }
    const Error& e = meaning.error();
    if (!first) first = e;
    refused.push_back(
        {{"vote", i}, {"error", {{"stage", e.stage}, {"place", e.place}, {"cause", e.cause}, {"fix", e.fix}}}});
  }
  if (!meanings.empty()) return meanings;
  return first ? *first : reply_refused("", "there is no reply", "ask first");
}

}  // namespace

Result<Ballot> read_variation_reply(const cad::Model& model, const Layout& layout, std::string_view reply) {
  return first_meaning<Ballot>(reply, [&](const json& block) { return ballot_of(model, layout, block); });
}

Result<json> read_kinds(const cad::Model& model, const std::vector<std::string>& texts) {
  json refused = json::array();
  const auto replies =
      readable<Kinds>(texts, refused, [&](const std::string& t) { return read_kinds_reply(model, t); });
  if (!replies.ok()) return replies.error();
  json out = to_json(count_kinds(*replies));
  out["refused"] = std::move(refused);
  return out;
}

Result<json> read_variation(const cad::Model& model, const std::string& kind, const std::vector<std::string>& texts) {
  json refused = json::array();
  const Layout layout = layout_of(model, family::Vocabulary::extended);
  const auto ballots = readable<Ballot>(
      texts, refused, [&](const std::string& text) { return read_variation_reply(model, layout, text); });
  if (!ballots.ok()) return ballots.error();
  const Result<family::Voted> voted = count_votes(model, layout, kind, *ballots);
  if (!voted.ok()) return voted.error();
  return json{{"variation", to_json({voted->variation}, layout, model)},
              {"agreed", voted->agreed},
              {"unanimous", voted->unanimous},
              {"constraints", voted->constraints},
              {"refused", std::move(refused)}};
}

}  // namespace parsel
