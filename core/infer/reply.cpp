#include "core/infer/reply.h"

#include <optional>

#include "core/base/text.h"
#include "core/edit/program_fields.h"
#include "core/infer/json_block.h"
#include "core/infer/names.h"
#include "core/infer/seed_json.h"

namespace parsel {

using nlohmann::json;

namespace {

constexpr std::size_t most_edits = 64;
constexpr std::size_t most_hints = 1'000;
constexpr std::size_t longest_reason = 300;

Error refused(std::string place, std::string cause, std::string fix) {
  return {"infer/reply", std::move(place), std::move(cause), std::move(fix)};
}

/// The first block, from the last, that has a meaning; else what is wrong with the last one.
template <class Meaning, class Read>
Result<Meaning> first_meaning(std::string_view reply, const Read& read) {
  if (reply.size() > ReplyLimits::text_bytes) {
    return refused("", "the reply is longer than 1 MiB", "ask again, or ask another model");
  }
  std::optional<Error> last;
  for (const json& block : json_blocks(reply)) {
    Result<Meaning> meaning = read(block);
    if (meaning.ok()) return meaning;
    if (!last) last = meaning.error();
  }
  if (last) return *last;
  return refused("", "the reply holds no whole JSON block", "ask again, perhaps with room for a longer reply");
}

/// The first member with one of the names, null when there is none.
const json& member(const json& block, std::initializer_list<const char*> names) {
  static const json none;
  for (const char* name : names) {
    if (const auto found = block.find(name); found != block.end() && !found->is_null()) return *found;
  }
  return none;
}

Result<SeedReply> seed_of(const Shape& shape, const json& block) {
  json edits = block;  // a list of statements, or one alone
  if (block.is_object() && !block.contains("op")) {
    edits = member(block, {"edits", "edit", "seed"});
    const json& unclear = member(block, {"unclear"});
    const std::string reason =
        unclear.is_string() ? printable(unclear.get_ref<const std::string&>(), longest_reason) : "";
    const bool no_edits = edits.is_null() || edits.empty();
    if (!reason.empty() && no_edits) return SeedReply{{}, reason};
    if (!reason.empty()) return refused("/unclear", "the reply gives edits as well", "give one of the two");
    if (no_edits) return refused("", "there are no edits", R"(give {"edits": […]} or {"unclear": "why"})");
  }
  if (edits.is_object()) edits = json::array({edits});
  if (!edits.is_array() || edits.empty()) return refused("/edits", "it is no list", "write a list of statements");
  if (edits.size() > most_edits) return refused("/edits", "it has more than 64 statements", "give the seed edits only");
  json seed = json::array();
  bool changes = false;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    Result<json> statement = strict_statement(shape, edits[i]);
    if (!statement.ok()) {
      Error error = statement.error();
      error.place = "/edits/" + std::to_string(i) + error.place;
      return error;
    }
    changes = changes || (*statement)["op"] != to_string(Op::keep_fixed);
    seed.push_back(std::move(*statement));
  }
  if (!changes) return refused("/edits", "they change nothing", "give an edit, or say that the request is unclear");
  // One gate for every edit, whoever wrote it.
  const auto of_reply = [](const Error& e) {
    const std::string place = e.place.starts_with("/seed") ? "/edits" + e.place.substr(5) : e.place;
    return refused(place, e.cause, e.fix);
  };
  const Result<EditRequest> request = edit_request_from_json({{"seed", std::move(seed)}});
  if (!request.ok()) return of_reply(request.error());
  Result<ResolvedRequest> resolved = resolve(*request, shape);
  if (!resolved.ok()) return of_reply(resolved.error());
  return SeedReply{std::move(resolved->seed), {}};
}

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

/// A hint, or an operator that belongs to it: "scale_1d" is a scale.
std::optional<Hint> hint_named(const json& value) {
  if (!value.is_string()) return std::nullopt;
  const std::string word = lower(value.get<std::string>());
  return hint_from_string(word.starts_with("scale_") ? "scale" : word);
}

Result<std::map<std::string, Hint>> hints_of(const Shape& shape, const json& block) {
  if (!block.is_object()) return refused("", "it is no object", R"(write {"hints": {"part": "scale"}})");
  const auto found = block.find("hints");
  const json& hints = found == block.end() ? block : *found;
  if (!hints.is_object()) return refused("/hints", "it is no object", R"(write {"hints": {"part": "scale"}})");
  if (hints.size() > most_hints)
    return refused("/hints", "it has more than 1000 entries", "name the parts that need one");
  std::map<std::string, Hint> result;
  for (const auto& [name, value] : hints.items()) {
    if (value.is_null()) continue;
    const std::string place = "/hints/" + printable(name, 40);
    const Result<PartIndex> part = part_named(shape, name);
    if (!part.ok()) return refused(place, part.error().cause, part.error().fix);
    const auto hint = hint_named(value);
    if (!hint) {
      return refused(place, "it is no kind of edit",
                     "use translate, rotate, scale, shear, change_count, change_delta or keep_fixed");
    }
    const Part& named = shape.parts[*part];
    if ((*hint == Hint::change_count || *hint == Hint::change_delta) && !named.group) {
      return refused(place, "the part is no group", "hint at count and spacing of groups only");
    }
    const auto [known, is_new] = result.emplace(named.id, *hint);
    if (!is_new && known->second != *hint) return refused(place, "the part has two hints", "keep one of them");
  }
  return result;
}

Result<bool> keep_of(const Relation& relation, const json& block) {
  if (block.is_object()) {
    const json& about = member(block, {"relation"});
    if (!about.is_null() && about != relation.id) {
      return refused("/relation", "it is about another relation", "answer for " + relation.id);
    }
  }
  const json& keep = block.is_object() ? member(block, {"keep", "valid"}) : block;
  if (keep.is_boolean()) return keep.get<bool>();
  if (keep.is_string()) {
    const std::string word = lower(keep.get<std::string>());
    if (word == "true" || word == "yes") return true;
    if (word == "false" || word == "no") return false;
  }
  return refused("/keep", "it is neither true nor false", R"(write {"keep": true} or {"keep": false})");
}

}  // namespace

Result<SeedReply> read_seed_reply(const Shape& shape, std::string_view reply) {
  return first_meaning<SeedReply>(reply, [&](const json& block) { return seed_of(shape, block); });
}

Result<std::map<std::string, Hint>> read_hints_reply(const Shape& shape, std::string_view reply) {
  return first_meaning<std::map<std::string, Hint>>(reply, [&](const json& block) { return hints_of(shape, block); });
}

Result<bool> read_validity_reply(const Shape& shape, RelationIndex relation, std::string_view reply) {
  return first_meaning<bool>(reply, [&](const json& block) { return keep_of(shape.relations[relation], block); });
}

}  // namespace parsel
