#include "core/infer/edit_assembly.h"

#include <algorithm>
#include <set>

namespace parsel {

EditRequest assemble(const Shape& shape, const std::vector<Statement>& seed, const std::vector<HintVote>& hints,
                     const std::vector<RelationVote>& relations) {
  EditRequest edit;
  edit.seed = seed;
  std::set<PartIndex> edited;
  std::set<RelationIndex> as_one, dissolved;
  for (const Statement& statement : seed) {
    const PartIndex part = *part_of(shape, statement);
    edited.insert(part);
    if (const auto group = shape.parts[part].group) {
      (shape.parts[part].is_virtual() ? as_one : dissolved).insert(*group);
    }
  }
  for (const RelationVote& vote : relations) {
    if (vote.keep || as_one.count(vote.relation) > 0) continue;
    const std::string& id = shape.relations[vote.relation].id;
    if (std::find(edit.disabled.begin(), edit.disabled.end(), id) == edit.disabled.end()) edit.disabled.push_back(id);
    if (shape.relations[vote.relation].is_group()) dissolved.insert(vote.relation);
  }
  std::vector<HintVote> by_votes = hints;
  std::stable_sort(by_votes.begin(), by_votes.end(),
                   [](const HintVote& a, const HintVote& b) { return a.votes > b.votes; });
  for (const HintVote& hint : by_votes) {
    const Part& named = shape.parts[*shape.find_part(hint.part)];
    const bool stands = named.group && dissolved.count(*named.group) == 0;
    if (named.is_virtual() && !stands) continue;
    const bool about_group = hint.hint == Hint::change_count || hint.hint == Hint::change_delta;
    if (about_group && !stands) continue;
    const PartIndex part = stands ? parent_of(shape.relations[*named.group]) : *shape.find_part(hint.part);
    if (edited.count(part) == 0) edit.hints.emplace(shape.parts[part].id, hint.hint);
  }
  return edit;
}

}  // namespace parsel
