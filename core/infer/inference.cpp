#include "core/infer/inference.h"

#include <algorithm>

#include "core/infer/edit_assembly.h"

namespace parsel {

Inference infer(const Shape& shape, const std::vector<Replies>& all) {
  struct Ballot {
    const Task* task;
    AboutRelation relation;
    std::vector<Meaning> meanings;
  };
  Inference result;
  std::vector<Ballot> ballots;  // one a prompt, by first arrival
  for (const Replies& replies : all) {
    auto ballot = std::find_if(ballots.begin(), ballots.end(), [&](const Ballot& known) {
      return known.task == replies.task && known.relation == replies.relation;
    });
    if (ballot == ballots.end()) ballot = ballots.insert(ballot, {replies.task, replies.relation, {}});
    for (std::size_t i = 0; i < replies.texts.size(); ++i) {
      Result<Meaning> meaning = replies.task->read(shape, replies.relation, replies.texts[i]);
      if (meaning.ok()) {
        ballot->meanings.push_back(std::move(*meaning));
      } else {  // what cannot be read does not count
        result.refused.push_back({replies.task, replies.relation, i, meaning.error()});
      }
    }
  }
  for (const Ballot& ballot : ballots) ballot.task->vote(shape, ballot.relation, ballot.meanings, result);
  if (!result.seed.readings.empty()) {
    result.edit = assemble(shape, result.seed.readings.front().statements, result.hints, result.relations);
  }
  return result;
}

}  // namespace parsel
