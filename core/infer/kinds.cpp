#include "core/infer/kinds.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/family/vote.h"
#include "core/infer/reply_block.h"

namespace parsel {

namespace {

using nlohmann::json;

/// One text from a reply, on one line, without quotes and what marks emphasis.
std::string plain(const json& text, std::size_t limit) {
  if (!text.is_string()) return "";
  std::string out = text.get<std::string>();
  std::erase_if(out, [](char c) { return c == '`' || c == '*' || c == '"'; });
  return printable(out, limit);
}

/// The same for names that differ in capitals, articles, hyphens and a plural's s only.
std::string signature(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : lower_case(name)) {
    if (c == ' ' || c == '-') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  std::string out;
  for (std::string& word : words) {
    if (word == "a" || word == "an" || word == "the") continue;
    if (word.size() > 3 && word.ends_with('s') && !word.ends_with("ss")) word.pop_back();
    out += word;
  }
  return out;
}

/// Why it is no kind, a clause; empty when it is one, which then is `kind`.
std::string fault_of(const cad::Model& model, const json& item, Kind& kind) {
  if (!item.is_object()) return "it is no object";
  const json& name = member(item, {"name", "kind"});
  kind.name = plain(name, family::VariationLimits::name_bytes);
  if (is_blank(kind.name)) return "it has no name";
  if (name.get_ref<const std::string&>().size() > family::VariationLimits::name_bytes) return "its name is too long";
  kind.words = std::string(cut(plain(member(item, {"words"}), longest_kind_words), longest_kind_words));
  const json& absent = member(item, {"absent"});
  if (absent.is_null()) return "";
  if (!absent.is_array()) return "what it lacks is no list";
  for (const json& id : absent) {
    if (!id.is_string() || model.find(id.get_ref<const std::string&>()) == nullptr) {
      return "it lacks a part that the program does not have";
    }
    const auto& part = id.get_ref<const std::string&>();
    if (std::find(kind.absent.begin(), kind.absent.end(), part) == kind.absent.end()) kind.absent.push_back(part);
  }
  return kind.absent.size() == model.parts.size() ? "it has none of the parts" : "";
}

Result<Kinds> kinds_of(const cad::Model& model, const json& block) {
  const json& list = block.is_object() ? member(block, {"kinds"}) : block;
  const char* fix = R"(write {"kinds": [{"name": "…", "absent": [], "words": "…"}]})";
  if (!list.is_array()) return reply_refused("/kinds", "it is no list", fix);
  if (list.empty()) return reply_refused("/kinds", "it names no kind", "ask again, or ask another model");
  Kinds result;
  for (const json& item : list) {
    Kind kind;
    std::string fault = fault_of(model, item, kind);
    const auto is_same = [&](const Kind& other) { return signature(other.name) == signature(kind.name); };
    if (fault.empty() && std::any_of(result.kinds.begin(), result.kinds.end(), is_same)) fault = "it is named twice";
    if (fault.empty() && result.kinds.size() == most_kinds) {
      fault = "there are " + std::to_string(most_kinds) + " already";
    }
    if (fault.empty()) {
      result.kinds.push_back(std::move(kind));
    } else {
      result.dropped.push_back({std::move(kind.name), std::move(fault)});
    }
  }
  if (result.kinds.empty()) {
    return reply_refused("/kinds", "none of its kinds can be taken: " + result.dropped.front().reason, fix);
  }
  return result;
}

}  // namespace

Result<Kinds> read_kinds_reply(const cad::Model& model, std::string_view reply) {
  return first_meaning<Kinds>(reply, [&](const json& block) { return kinds_of(model, block); });
}

Kinds count_kinds(const std::vector<Kinds>& replies) {
  struct Named {
    Kind kind;
    std::size_t rank = 0;  ///< places in the replies that name it, summed
    std::map<std::string, int> absent;
  };
  std::vector<Named> named;
  Kinds all;
  for (const Kinds& reply : replies) {
    for (std::size_t place = 0; place < reply.kinds.size(); ++place) {
      const Kind& kind = reply.kinds[place];
      auto known = std::find_if(named.begin(), named.end(),
                                [&](const Named& other) { return signature(other.kind.name) == signature(kind.name); });
      if (known == named.end()) {
        known = named.insert(known, {kind, 0, {}});
        known->kind.votes = 0;
      }
      ++known->kind.votes;
      known->rank += place;
      for (const std::string& id : kind.absent) ++known->absent[id];
    }
    all.dropped.insert(all.dropped.end(), reply.dropped.begin(), reply.dropped.end());
  }
  std::stable_sort(named.begin(), named.end(), [](const Named& a, const Named& b) {
    if (a.kind.votes != b.kind.votes) return a.kind.votes > b.kind.votes;
    return a.rank < b.rank;
  });
  for (Named& one : named) {
    one.kind.absent.clear();
    for (const auto& [id, votes] : one.absent) {
      if (2 * votes > one.kind.votes) one.kind.absent.push_back(id);
    }
    all.kinds.push_back(std::move(one.kind));
  }
  return all;
}

json to_json(const Kinds& kinds) {
  json named = json::array(), dropped = json::array();
  for (const Kind& kind : kinds.kinds) {
    named.push_back({{"name", kind.name}, {"words", kind.words}, {"absent", kind.absent}, {"votes", kind.votes}});
  }
  for (const DroppedKind& kind : kinds.dropped) dropped.push_back({{"name", kind.name}, {"reason", kind.reason}});
  return {{"kinds", std::move(named)}, {"dropped", std::move(dropped)}};
}

}  // namespace parsel
