#include "core/infer/names.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/edit/program_fields.h"

namespace parsel {

namespace {

constexpr const char* stage = "infer/reply";

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string lower(std::string_view text) {
  std::string out;
  for (const char c : text) out += lower(c);
  return out;
}

/// The words of a name, sorted. Bytes beyond ASCII belong to words, of whatever language.
std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> out(1);
  for (const char c : lower(text)) {
    const bool in_word = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
    if (in_word) {
      out.back() += c;
    } else if (!out.back().empty()) {
      out.emplace_back();
    }
  }
  if (out.back().empty()) out.pop_back();
  std::erase(out, "the");
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace

Result<PartIndex> part_named(const Shape& shape, std::string_view text) {
  if (const auto part = shape.find_part(text)) return *part;
  if (const auto relation = shape.find_relation(text); relation && shape.relations[*relation].is_group()) {
    return parent_of(shape.relations[*relation]);
  }
  const std::vector<std::string> wanted = text.size() <= ProgramLimits::name_bytes ? words(text) : words("");
  std::vector<PartIndex> found;
  for (const PartIndex p : shape.parts.indices()) {
    if (wanted.empty()) break;
    if (words(shape.parts[p].id) == wanted || words(shape.parts[p].name) == wanted) found.push_back(p);
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    return Error{stage, "", "the shape has no part " + shown(text), "name parts by the ids that the prompt lists"};
  }
  return Error{stage, "", "several parts are called " + shown(text),
               "name one by its id, such as " + shape.parts[found.front()].id};
}

Result<RelationIndex> group_named(const Shape& shape, std::string_view text) {
  auto relation = shape.find_relation(lower(text.substr(0, ProgramLimits::name_bytes)));
  if (!relation) {
    const Result<PartIndex> part = part_named(shape, text);
    if (part.ok()) relation = shape.parts[*part].group;
  }
  if (relation && shape.relations[*relation].is_group()) return *relation;
  return Error{stage, "", shown(text) + " is no translation or rotation group",
               "change count and spacing of a group only, by its relation's id"};
}

}  // namespace parsel
