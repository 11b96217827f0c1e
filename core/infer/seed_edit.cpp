#include "core/infer/seed_edit.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/infer/inference.h"
#include "core/infer/reading.h"
#include "core/infer/reply_block.h"
#include "core/infer/seed_json.h"

namespace parsel {

namespace {

using nlohmann::json;

constexpr std::size_t most_edits = 64;
constexpr std::size_t longest_reason = 300;

Result<SeedReply> seed_of(const Shape& shape, const json& block) {
  json edits = block;  // a list of statements, or one alone
  if (block.is_object() && !block.contains("op")) {
    edits = member(block, {"edits", "edit", "seed"});
    const json& unclear = member(block, {"unclear"});
    const std::string reason =
        unclear.is_string() ? printable(unclear.get_ref<const std::string&>(), longest_reason) : "";
    const bool no_edits = edits.is_null() || edits.empty();
    if (!reason.empty() && no_edits) return SeedReply{{}, reason};
    if (!reason.empty()) return reply_refused("/unclear", "the reply gives edits as well", "give one of the two");
    if (no_edits) return reply_refused("", "there are no edits", R"(give {"edits": […]} or {"unclear": "why"})");
  }
  if (edits.is_object()) edits = json::array({edits});
  if (!edits.is_array() || edits.empty()) return reply_refused("/edits", "it is no list", "write a list of statements");
  if (edits.size() > most_edits)
    return reply_refused("/edits", "it has more than 64 statements", "give the seed edits only");
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
  if (!changes)
    return reply_refused("/edits", "they change nothing", "give an edit, or say that the request is unclear");
  // One gate for every edit, whoever wrote it.
  const auto of_reply = [](const Error& e) {
    const std::string place = e.place.starts_with("/seed") ? "/edits" + e.place.substr(5) : e.place;
    return reply_refused(place, e.cause, e.fix);
  };
  const Result<EditRequest> request = edit_request_from_json({{"seed", std::move(seed)}});
  if (!request.ok()) return of_reply(request.error());
  Result<ResolvedRequest> resolved = resolve(*request, shape);
  if (!resolved.ok()) return of_reply(resolved.error());
  return SeedReply{std::move(resolved->seed), {}};
}

/// The statements that occur most among those of one reading; the first to come in a tie.
const std::vector<Statement>& usual_form(const std::vector<const SeedReply*>& replies) {
  std::map<std::string, int> counts;
  const auto text = [](const SeedReply& reply) { return to_json(EditRequest{reply.statements, {}, {}}).dump(); };
  for (const SeedReply* reply : replies) ++counts[text(*reply)];
  const auto most = std::max_element(replies.begin(), replies.end(), [&](const SeedReply* a, const SeedReply* b) {
    return counts[text(*a)] < counts[text(*b)];
  });
  return (*most)->statements;
}

}  // namespace

Result<SeedReply> read_seed_reply(const Shape& shape, std::string_view reply) {
  return first_meaning<SeedReply>(reply, [&](const json& block) { return seed_of(shape, block); });
}

std::string_view to_string(SeedVote::Outcome outcome) {
  constexpr std::array<std::string_view, 4> names = {"decided", "split", "unclear", "none"};
  return names[static_cast<std::size_t>(outcome)];
}

SeedVote vote(const Shape& shape, const std::vector<SeedReply>& replies) {
  SeedVote result;
  std::vector<std::string> order;  // of first arrival
  std::map<std::string, std::vector<const SeedReply*>> same;
  int unclear = 0;
  for (const SeedReply& reply : replies) {
    ++result.of;
    if (reply.statements.empty()) {
      ++unclear;
      if (!result.reason) result.reason = reply.unclear;
      continue;
    }
    const std::string key = reading_signature(shape, reply.statements);
    if (same[key].empty()) order.push_back(key);
    same[key].push_back(&reply);
  }
  for (const std::string& key : order) {
    const std::vector<Statement>& form = usual_form(same[key]);
    result.readings.push_back({form, reading_words(shape, form), static_cast<int>(same[key].size())});
  }
  std::stable_sort(result.readings.begin(), result.readings.end(),
                   [](const Reading& a, const Reading& b) { return a.votes > b.votes; });
  const int best = result.readings.empty() ? 0 : result.readings.front().votes;
  if (result.of == 0) {
    result.outcome = SeedVote::Outcome::none;
  } else if (unclear > best) {
    result.outcome = SeedVote::Outcome::unclear;
  } else {
    result.outcome = 2 * best > result.of ? SeedVote::Outcome::decided : SeedVote::Outcome::split;
  }
  return result;
}

namespace {

Result<Meaning> read(const Shape& shape, AboutRelation, std::string_view reply) {
  return as_meaning(read_seed_reply(shape, reply));
}

void count(const Shape& shape, AboutRelation, const std::vector<Meaning>& meanings, Inference& inference) {
  inference.seed = vote(shape, meanings_as<SeedReply>(meanings));
}

void write(const Shape&, const Inference& inference, json& out) {
  const SeedVote& seed = inference.seed;
  json readings = json::array();
  for (const Reading& reading : seed.readings) {
    readings.push_back({{"statements", to_json(EditRequest{reading.statements, {}, {}})["seed"]},
                        {"words", reading.words},
                        {"votes", reading.votes}});
  }
  out["seed"] = {{"outcome", to_string(seed.outcome)},
                 {"readings", std::move(readings)},
                 {"of", seed.of},
                 {"reason", seed.reason ? json(*seed.reason) : json()}};
}

}  // namespace

const Task seed_edit_task = {"seed_edit", "the change", nullptr, nullptr, read, count, write};

}  // namespace parsel
