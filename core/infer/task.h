// What the language model is asked: ParSEL §6.2.1, supplement §5.2. One record a task, in a source file of its own; its
// template (prompts/<name>.md) and the schema of its reply (prompts/<name>.schema.json) are compiled in.
#pragma once

#include <any>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/shape/shape.h"

namespace parsel {

struct Inference;

/// What one reply means, in the task's own type.
using Meaning = std::any;
using Places = std::map<std::string_view, std::string>;
/// The relation that a task is asked about; nothing for the tasks about the request as a whole.
using AboutRelation = std::optional<RelationIndex>;

struct Task {
  std::string_view name;
  std::string_view words;  ///< what it asks about, for people: "the change"
  /// Scope: whether it is asked about each relation of this kind; null when it is asked once, about the request.
  bool (*asks_about)(RelationKind kind);
  /// Render: what its template's places hold, besides {{shape}}, {{request}} and {{mentioned}}. Null for none.
  Places (*places)(const Shape& shape, AboutRelation relation);
  /// Any bytes → the meaning or why there is none.
  Result<Meaning> (*read)(const Shape& shape, AboutRelation relation, std::string_view reply);
  /// Counts what the replies to one prompt mean, each by read(), into its own member of the inference.
  void (*vote)(const Shape& shape, AboutRelation relation, const std::vector<Meaning>& meanings, Inference& inference);
  /// Writes that member as JSON; the tasks of one member write the same.
  void (*write)(const Shape& shape, const Inference& inference, nlohmann::json& json);
  /// How many requests its reply proposes unless the wish says; 0 for the tasks that every request is read by. One that
  /// proposes is asked on its own.
  int proposals = 0;
  bool about_request = true;  ///< false: about the model alone, without a request
  /// What the prompt lists under part_1, part_2, … instead of by ids, so that names say nothing; null for ids.
  std::vector<PartIndex> (*numbered)(const Shape& shape) = nullptr;

  /// Whether it is asked on its own, no request being read by it.
  bool is_alone() const { return proposals > 0 || !about_request; }
};

/// The meanings in the type that the task's read() gives.
template <class T>
std::vector<T> meanings_as(const std::vector<Meaning>& meanings) {
  std::vector<T> out;
  for (const Meaning& meaning : meanings) out.push_back(std::any_cast<const T&>(meaning));
  return out;
}
template <class T>
Result<Meaning> as_meaning(Result<T> read) {
  if (!read.ok()) return read.error();
  return Meaning(std::move(*read));
}

}  // namespace parsel
