#include "core/infer/proposals.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/text.h"
#include "core/edit/program_fields.h"
#include "core/infer/inference.h"
#include "core/infer/names.h"
#include "core/infer/reply_block.h"

namespace parsel {

namespace {

using nlohmann::json;

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
/// Bytes beyond ASCII belong to words, of whatever language.
bool in_word(char c) {
  return is_letter(c) || is_digit(c) || c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

/// Without HTML tags, backquotes and asterisks, on one line.
std::string without_markup(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`' || text[i] == '*') continue;
    if (text[i] == '<' && i + 1 < text.size() && (is_letter(text[i + 1]) || text[i + 1] == '/')) {
      const std::size_t end = text.find_first_of("<>", i + 1);
      if (end != text.npos && text[end] == '>') {
        i = end;
        continue;
      }
    }
    out += text[i];
  }
  return out;
}

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> out(1);
  for (const char c : lower_case(text)) {
    if (in_word(c)) {
      out.back() += c;
    } else if (!out.back().empty()) {
      out.emplace_back();
    }
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

/// "20 cm", "2x", "by 50%"; not "leg_2", nor "leg 2" where a part's id ends so.
bool gives_amount(const Shape& shape, const std::string& request) {
  const std::vector<std::string> all = words(request);
  return std::any_of(all.begin(), all.end(), [&](const std::string& word) {
    const bool counts_parts = std::any_of(shape.parts.begin(), shape.parts.end(),
                                          [&](const Part& part) { return part.id.ends_with("_" + word); });
    return is_digit(word[0]) && !counts_parts;
  });
}

/// The same for requests that differ in capitals, punctuation and articles only.
std::string signature(const std::string& request) {
  std::string out;
  for (const std::string& word : words(request)) {
    if (word != "the" && word != "a" && word != "an") out += word + " ";
  }
  return out;
}

/// The ids of parts that are named in a list, or in a text alone; the error's cause says which is none.
Result<std::vector<std::string>> parts_in(const Shape& shape, const json& list) {
  std::vector<std::string> ids;
  const json names = list.is_string() ? json::array({list}) : list.is_null() ? json::array() : list;
  if (!names.is_array()) return reply_refused("", "its parts are no list", "");
  for (const json& name : names) {
    if (!name.is_string()) return reply_refused("", "its parts are no list of ids", "");
    const Result<PartIndex> part = part_named(shape, without_markup(name.get_ref<const std::string&>()));
    if (!part.ok()) return part.error();
    const std::string& id = shape.parts[*part].id;
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
  }
  return ids;
}

/// Why it is no proposal, a clause; empty when it is one, which then is `proposal`.
std::string fault_of(const Shape& shape, const json& item, bool amounts, ProposedRequest& proposal) {
  if (!item.is_object()) return "it does not say which parts change";
  const json& request = member(item, {"request", "text"});
  if (!request.is_string()) return "it has no request";
  proposal.request = printable(without_markup(request.get_ref<const std::string&>()), ProgramLimits::request_bytes);
  if (is_blank(proposal.request)) return "its request is empty";
  if (count_characters(request.get_ref<const std::string&>()) > longest_proposal) {
    return "it is longer than " + std::to_string(longest_proposal) + " characters";
  }
  if (!amounts && gives_amount(shape, proposal.request)) return "it gives an amount, which is the slider's business";
  Result<std::vector<std::string>> changes = parts_in(shape, member(item, {"changes"}));
  if (!changes.ok()) return changes.error().cause;
  if (changes->empty()) return "it does not say which parts change";
  Result<std::vector<std::string>> keeps = parts_in(shape, member(item, {"keeps", "stays"}));
  if (!keeps.ok()) return keeps.error().cause;
  proposal.changes = std::move(*changes);
  proposal.keeps = std::move(*keeps);
  return "";
}

Result<Proposals> proposals_of(const Shape& shape, const json& block, bool amounts) {
  const json& list = block.is_object() ? member(block, {"requests", "proposals"}) : block;
  const char* fix = R"(write {"requests": [{"request": "…", "changes": ["part"], "keeps": []}]})";
  if (!list.is_array()) return reply_refused("/requests", "it is no list", fix);
  if (list.empty()) return reply_refused("/requests", "it proposes nothing", "ask again, or ask another model");
  Proposals result;
  std::set<std::string> known;
  for (const json& item : list) {
    ProposedRequest proposal;
    std::string fault = fault_of(shape, item, amounts, proposal);
    if (fault.empty() && !known.insert(signature(proposal.request)).second) fault = "it says the same as another one";
    if (fault.empty() && result.requests.size() == most_proposals) {
      fault = "there are " + std::to_string(most_proposals) + " already";
    }
    if (fault.empty()) {
      result.requests.push_back(std::move(proposal));
    } else {
      result.dropped.push_back({std::string(cut(proposal.request, longest_proposal)), std::move(fault)});
    }
  }
  return result;
}

}  // namespace

Result<Proposals> read_proposals_reply(const Shape& shape, std::string_view reply, bool amounts) {
  return first_meaning<Proposals>(reply, [&](const json& block) { return proposals_of(shape, block, amounts); });
}

Proposals merge(const std::vector<Proposals>& replies) {
  Proposals all;
  std::set<std::string> known;
  for (const Proposals& reply : replies) {
    for (const ProposedRequest& proposal : reply.requests) {
      if (known.insert(signature(proposal.request)).second) all.requests.push_back(proposal);
    }
    all.dropped.insert(all.dropped.end(), reply.dropped.begin(), reply.dropped.end());
  }
  return all;
}

namespace {

template <bool amounts>
Result<Meaning> read(const Shape& shape, AboutRelation, std::string_view reply) {
  return as_meaning(read_proposals_reply(shape, reply, amounts));
}

void count(const Shape&, AboutRelation, const std::vector<Meaning>& meanings, Inference& inference) {
  inference.proposals = merge(meanings_as<Proposals>(meanings));
}

void write(const Shape&, const Inference& inference, json& out) {
  json requests = json::array(), dropped = json::array();
  for (const ProposedRequest& proposal : inference.proposals.requests) {
    requests.push_back({{"request", proposal.request}, {"changes", proposal.changes}, {"keeps", proposal.keeps}});
  }
  for (const DroppedProposal& proposal : inference.proposals.dropped) {
    dropped.push_back({{"request", proposal.request}, {"reason", proposal.reason}});
  }
  out["proposals"] = {{"requests", std::move(requests)}, {"dropped", std::move(dropped)}};
}

}  // namespace

const Task procedural_requests_task = {
    "procedural_requests", "sliders for the model", nullptr, nullptr, read<false>, count, write, 6, false};
const Task request_variations_task = {
    "request_variations", "other readings", nullptr, nullptr, read<true>, count, write, 4, true};

}  // namespace parsel
