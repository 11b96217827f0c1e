#include "core/infer/part_names.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/base/text.h"
#include "core/edit/program_fields.h"
#include "core/infer/inference.h"
#include "core/infer/reply_block.h"
#include "core/shape/label.h"
#include "core/shape/words.h"

namespace parsel {

namespace {

using nlohmann::json;

/// A row of more is named once: prompt and reply would be nothing but its instances.
constexpr std::size_t most_listed_instances = 8;
constexpr std::size_t longest_name = 60;
constexpr std::array fronts = {"+z", "-z", "+x", "-x"};
const std::string prefix = "part_";

/// The groups whose instances are listed one by one.
std::vector<RelationIndex> listed_groups(const Shape& shape) {
  std::vector<RelationIndex> groups;
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    if (relation.is_group() && relation.parts.size() <= most_listed_instances) groups.push_back(r);
  }
  return groups;
}

/// The shape with ids that say nothing.
Shape nameless(const Shape& shape) {
  Shape copy = shape;
  copy.name = "model";
  int number = 0;
  const auto call = [&](PartIndex part, const std::string& id) {
    copy.parts[part].id = id;
    copy.parts[part].name = id;
  };
  for (const PartIndex part : named_parts(shape)) call(part, prefix + std::to_string(++number));
  for (const PartIndex part : named_parts(shape)) {
    std::size_t instance = 0;
    for (const PartIndex member : shape.parts[part].members) {
      call(member, copy.parts[part].id + "_" + std::to_string(++instance));
    }
  }
  return copy;
}

std::string size_words(const Shape& shape) {
  Vec3 low = Vec3::Constant(1e9), high = -low;
  for (const Part& part : shape.parts) {
    if (part.is_virtual()) continue;
    low = low.cwiseMin(part.hexahedron.corners.colwise().minCoeff().transpose());
    high = high.cwiseMax(part.hexahedron.corners.colwise().maxCoeff().transpose());
  }
  const Vec3 size = (high - low) * shape.frame.scale;
  std::string text;
  constexpr std::array words = {" m wide, ", " m high and ", " m deep"};
  for (int axis = 0; axis < 3; ++axis) {
    char number[32];
    std::snprintf(number, sizeof number, "%.3g", size[axis]);
    text += std::string(number) + words[static_cast<std::size_t>(axis)];
  }
  return text;
}

Places places(const Shape& shape, AboutRelation) {
  return {{"parts", describe_nameless(shape)}, {"size", size_words(shape)}};
}

/// A name fit to be a label; "" when it says nothing of a part.
std::string label_of(const std::string& name) {
  std::string text = printable(name, longest_name);
  std::erase_if(text, [](char c) { return c == '`' || c == '*' || c == '"'; });
  const std::string label = clean_label(text);
  return grouping_key(label) == "part" ? "" : label;
}

Result<std::string> text_of(const json& value, const std::string& place) {
  if (!value.is_string() || is_blank(value.get_ref<const std::string&>())) {
    return reply_refused(place, "it is no name", "write one or two words");
  }
  if (count_characters(value.get_ref<const std::string&>()) > longest_name) {
    return reply_refused(place, "it is longer than " + std::to_string(longest_name) + " characters",
                         "write one or two words");
  }
  return value.get<std::string>();
}

Result<SuggestedNames> names_of(const Shape& shape, const json& block) {
  const char* form = R"(write {"category": "…", "front": "+z", "parts": {"part_1": "name", …}})";
  if (!block.is_object()) return reply_refused("", "it is no object", form);
  SuggestedNames names;
  const Result<std::string> category = text_of(member(block, {"category"}), "/category");
  if (!category.ok()) return category.error();
  names.category = printable(lower_case(*category), longest_name);
  const json& front = member(block, {"front"});
  if (front.is_string()) names.front = front.get<std::string>();
  if (std::find(fronts.begin(), fronts.end(), names.front) == fronts.end()) {
    return reply_refused("/front", "it is none of +z, -z, +x and -x", "say which side is the front");
  }
  const json& parts = member(block, {"parts", "names"});
  if (!parts.is_object()) return reply_refused("/parts", "it is no object of names by part", form);
  names.labels.resize(named_parts(shape).size());
  for (std::size_t i = 0; i < names.labels.size(); ++i) {
    const auto given = parts.find(prefix + std::to_string(i + 1));
    if (given == parts.end()) continue;
    const Result<std::string> name = text_of(*given, "/parts/" + given.key());
    if (!name.ok()) return name.error();
    names.labels[i] = label_of(*name);
  }
  for (const auto& [id, name] : parts.items()) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < names.labels.size() && number == 0; ++i) {
      if (id == prefix + std::to_string(i + 1)) number = i + 1;
    }
    if (number == 0) {
      return reply_refused("/parts", "the list has no part " + shown(id),
                           "name the parts of the list, part_1 and so on");
    }
  }
  if (std::all_of(names.labels.begin(), names.labels.end(), [](const std::string& s) { return s.empty(); })) {
    return reply_refused("/parts", "no part has a name", "name every part of the list");
  }
  return names;
}

/// The most frequent of the texts that are not empty, by a key; of equals the first. And how often it is there.
template <class Key>
std::pair<std::string, int> most_frequent(const std::vector<std::string>& texts, const Key& key) {
  std::map<std::string, int> counts;
  for (const std::string& text : texts) {
    if (!text.empty()) ++counts[key(text)];
  }
  std::pair<std::string, int> best;
  for (const std::string& text : texts) {
    if (!text.empty() && counts[key(text)] > best.second) best = {text, counts[key(text)]};
  }
  return best;
}

std::string same(const std::string& text) {
  return text;
}

}  // namespace

std::vector<PartIndex> named_parts(const Shape& shape) {
  return active_parts(shape, listed_groups(shape));
}

std::string describe_nameless(const Shape& shape) {
  const std::vector<RelationIndex> listed = listed_groups(shape);
  const Shape copy = nameless(shape);
  std::string text = describe(copy, listed), rows;
  for (const RelationIndex r : listed) rows += "- " + describe(copy, r) + "\n";
  if (!rows.empty()) text += "Rows and rings:\n" + rows;
  return text + describe_ground(copy, listed);
}

Result<SuggestedNames> read_names_reply(const Shape& shape, std::string_view reply) {
  return first_meaning<SuggestedNames>(reply, [&](const json& block) { return names_of(shape, block); });
}

NamesVote count_names(const Shape& shape, const std::vector<SuggestedNames>& replies) {
  NamesVote vote;
  vote.of = static_cast<int>(replies.size());
  const std::vector<PartIndex> parts = named_parts(shape);
  // Replies in order of how often others say the same, so that the first of equals is the one that agrees most.
  std::vector<std::pair<int, std::size_t>> order;
  for (std::size_t a = 0; a < replies.size(); ++a) {
    int agreeing = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (const SuggestedNames& other : replies) {
        agreeing += grouping_key(other.labels[p]) == grouping_key(replies[a].labels[p]);
      }
    }
    order.emplace_back(-agreeing, a);
  }
  std::sort(order.begin(), order.end());
  const auto told = [&](const auto& of) {
    std::vector<std::string> texts;
    for (const auto& [_, reply] : order) texts.push_back(of(replies[reply]));
    return texts;
  };
  std::tie(vote.category, vote.category_votes) =
      most_frequent(told([](const SuggestedNames& names) { return names.category; }), same);
  std::tie(vote.front, vote.front_votes) =
      most_frequent(told([](const SuggestedNames& names) { return names.front; }), same);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto [label, votes] =
        most_frequent(told([&](const SuggestedNames& names) { return names.labels[p]; }), grouping_key);
    vote.parts.push_back({parts[p], label, votes});
  }
  return vote;
}

namespace {

Result<Meaning> read(const Shape& shape, AboutRelation, std::string_view reply) {
  return as_meaning(read_names_reply(shape, reply));
}

void count(const Shape& shape, AboutRelation, const std::vector<Meaning>& meanings, Inference& inference) {
  inference.names = count_names(shape, meanings_as<SuggestedNames>(meanings));
}

void write(const Shape& shape, const Inference& inference, json& out) {
  const NamesVote& vote = inference.names;
  json parts = json::array();
  for (const LabelVote& one : vote.parts) {
    parts.push_back({{"part", shape.parts[one.part].id}, {"label", one.label}, {"votes", one.votes}});
  }
  out["names"] = {{"category", vote.category},
                  {"category_votes", vote.category_votes},
                  {"front", vote.front},
                  {"front_votes", vote.front_votes},
                  {"of", vote.of},
                  {"parts", std::move(parts)}};
}

}  // namespace

const Task part_names_task = {"part_names", "names for the parts", nullptr, places, read, count, write, 0, false,
                              named_parts};

}  // namespace parsel
