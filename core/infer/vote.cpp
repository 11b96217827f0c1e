#include "core/infer/vote.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "core/infer/reading.h"

namespace parsel {

namespace {

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

std::vector<HintVote> vote(const std::vector<std::map<std::string, Hint>>& replies) {
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

RelationVote vote(RelationIndex relation, const std::vector<bool>& keeps) {
  const int of = static_cast<int>(keeps.size());
  const int yes = static_cast<int>(std::count(keeps.begin(), keeps.end(), true));
  const bool keep = 2 * yes >= of;
  return {relation, keep, keep ? yes : of - yes, of};
}

}  // namespace parsel
