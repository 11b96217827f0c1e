#include "core/infer/type_hints.h"

#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/edit/operator_table.h"
#include "core/infer/inference.h"
#include "core/infer/names.h"
#include "core/infer/reply_block.h"

namespace parsel {

namespace {

using nlohmann::json;
using Hints = std::map<std::string, Hint>;

constexpr std::size_t most_hints = 1'000;

/// A hint, or an operator that belongs to it: "scale_1d" is a scale.
std::optional<Hint> hint_named(const json& value) {
  if (!value.is_string()) return std::nullopt;
  const std::string word = lower_case(value.get<std::string>());
  const auto op = op_from_string(word);
  return hint_from_string(op ? hint_of(*op) : word);
}

Result<Hints> hints_of(const Shape& shape, const json& block) {
  if (!block.is_object()) return reply_refused("", "it is no object", R"(write {"hints": {"part": "scale"}})");
  const auto found = block.find("hints");
  const json& hints = found == block.end() ? block : *found;
  if (!hints.is_object()) return reply_refused("/hints", "it is no object", R"(write {"hints": {"part": "scale"}})");
  if (hints.size() > most_hints)
    return reply_refused("/hints", "it has more than 1000 entries", "name the parts that need one");
  Hints result;
  for (const auto& [name, value] : hints.items()) {
    if (value.is_null()) continue;
    const std::string place = "/hints/" + printable(name, 40);
    const Result<PartIndex> part = part_named(shape, name);
    if (!part.ok()) return reply_refused(place, part.error().cause, part.error().fix);
    const auto hint = hint_named(value);
    if (!hint) {
      return reply_refused(place, "it is no kind of edit",
                           "use translate, rotate, scale, shear, change_count, change_delta or keep_fixed");
    }
    const Part& named = shape.parts[*part];
    if ((*hint == Hint::change_count || *hint == Hint::change_delta) && !named.group) {
      return reply_refused(place, "the part is no group", "hint at count and spacing of groups only");
    }
    const auto [known, is_new] = result.emplace(named.id, *hint);
    if (!is_new && known->second != *hint) return reply_refused(place, "the part has two hints", "keep one of them");
  }
  return result;
}

}  // namespace

Result<Hints> read_hints_reply(const Shape& shape, std::string_view reply) {
  return first_meaning<Hints>(reply, [&](const json& block) { return hints_of(shape, block); });
}

std::vector<HintVote> vote(const std::vector<Hints>& replies) {
  std::map<std::pair<std::string, Hint>, int> counts;
  for (const auto& reply : replies) {
    for (const auto& hint : reply) ++counts[hint];
  }
  std::vector<HintVote> kept;
  const int of = static_cast<int>(replies.size());
  for (const auto& [hint, votes] : counts) {
    if (votes >= hint_share * of) kept.push_back({hint.first, hint.second, votes, of});
  }
  return kept;
}

namespace {

Result<Meaning> read(const Shape& shape, AboutRelation, std::string_view reply) {
  return as_meaning(read_hints_reply(shape, reply));
}

void count(const Shape&, AboutRelation, const std::vector<Meaning>& meanings, Inference& inference) {
  inference.hints = vote(meanings_as<Hints>(meanings));
}

void write(const Shape&, const Inference& inference, json& out) {
  json& hints = out["hints"] = json::array();
  for (const HintVote& hint : inference.hints) {
    hints.push_back({{"part", hint.part}, {"hint", to_string(hint.hint)}, {"votes", hint.votes}, {"of", hint.of}});
  }
}

}  // namespace

const Task type_hints_task = {"type_hints", "what other parts do", nullptr, nullptr, read, count, write};

}  // namespace parsel
