#include "core/infer/relation_validity.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/infer/inference.h"
#include "core/infer/reply_block.h"
#include "core/shape/words.h"

namespace parsel {

namespace {

using nlohmann::json;

Result<bool> keep_of(const Relation& relation, const json& block) {
  if (block.is_object()) {
    const json& about = member(block, {"relation"});
    if (!about.is_null() && about != relation.id) {
      return reply_refused("/relation", "it is about another relation", "answer for " + relation.id);
    }
  }
  const json& keep = block.is_object() ? member(block, {"keep", "valid"}) : block;
  if (keep.is_boolean()) return keep.get<bool>();
  if (keep.is_string()) {
    const std::string word = lower_case(keep.get<std::string>());
    if (word == "true" || word == "yes") return true;
    if (word == "false" || word == "no") return false;
  }
  return reply_refused("/keep", "it is neither true nor false", R"(write {"keep": true} or {"keep": false})");
}

}  // namespace

Result<bool> read_validity_reply(const Shape& shape, RelationIndex relation, std::string_view reply) {
  return first_meaning<bool>(reply, [&](const json& block) { return keep_of(shape.relations[relation], block); });
}

RelationVote vote(RelationIndex relation, const std::vector<bool>& keeps) {
  const int of = static_cast<int>(keeps.size());
  const int yes = static_cast<int>(std::count(keeps.begin(), keeps.end(), true));
  const bool keep = 2 * yes >= of;
  return {relation, keep, keep ? yes : of - yes, of};
}

namespace {

bool is_reflection(RelationKind kind) {
  return kind == RelationKind::reflection;
}
bool is_group(RelationKind kind) {
  return kind == RelationKind::translation || kind == RelationKind::rotation;
}

Places places(const Shape& shape, AboutRelation relation) {
  return {{"relation", shape.relations[*relation].id + ": " + describe(shape, *relation) + "."}};
}

Result<Meaning> read(const Shape& shape, AboutRelation relation, std::string_view reply) {
  return as_meaning(read_validity_reply(shape, *relation, reply));
}

void count(const Shape&, AboutRelation relation, const std::vector<Meaning>& meanings, Inference& inference) {
  inference.relations.push_back(vote(*relation, meanings_as<bool>(meanings)));
}

void write(const Shape& shape, const Inference& inference, json& out) {
  json& relations = out["relations"] = json::array();
  for (const RelationVote& vote : inference.relations) {
    relations.push_back({{"relation", shape.relations[vote.relation].id},
                         {"keep", vote.keep},
                         {"votes", vote.votes},
                         {"of", vote.of},
                         {"words", describe(shape, vote.relation)}});
  }
}

}  // namespace

const Task relation_validity_reflection_task = {
    "relation_validity_reflection", "mirror symmetries", is_reflection, places, read, count, write};
const Task relation_validity_group_task = {
    "relation_validity_group", "rows and rings", is_group, places, read, count, write};

}  // namespace parsel
