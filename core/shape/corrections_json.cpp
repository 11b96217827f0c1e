// Corrections from JSON, and the parts that they are about.
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/text.h"
#include "core/shape/corrections.h"

namespace parsel {

using nlohmann::json;

namespace {

constexpr std::array<std::pair<CorrectionKind, std::string_view>, 5> kind_names = {{
    {CorrectionKind::joined, "joined"},
    {CorrectionKind::loose, "loose"},
    {CorrectionKind::apart, "apart"},
    {CorrectionKind::mirrored, "mirrored"},
    {CorrectionKind::unmirrored, "unmirrored"},
}};
/// More say nothing: a model has no more parts.
constexpr std::size_t most_corrections = 10000;
Error refused(std::string place, std::string cause, std::string fix) {
  return {"shape/corrections", std::move(place), std::move(cause), std::move(fix)};
}

}  // namespace

bool is_of_mirrors(CorrectionKind kind) {
  return kind == CorrectionKind::mirrored || kind == CorrectionKind::unmirrored;
}

std::string_view to_string(CorrectionKind kind) {
  for (const auto& [own, name] : kind_names) {
    if (own == kind) return name;
  }
  return {};
}

std::optional<CorrectionKind> correction_kind(std::string_view text) {
  for (const auto& [kind, name] : kind_names) {
    if (name == text) return kind;
  }
  return std::nullopt;
}

Result<Corrections> corrections_from_json(const json& list) {
  if (!list.is_array()) return refused("", "the corrections are no list", "write [{\"kind\": …, \"parts\": […]}]");
  if (list.size() > most_corrections) return refused("", "there are too many corrections", "give at most 10000");
  Corrections corrections;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const json& given = list[i];
    const std::string place = "/" + std::to_string(i);
    if (!given.is_object()) return refused(place, "is no object", "write {\"kind\": …, \"parts\": […]}");
    for (const auto& [key, value] : given.items()) {
      if (key != "kind" && key != "parts")
        return refused(place + "/" + printable(key), "is no field of a correction", "use kind and parts only");
    }
    const json kind = given.value("kind", json());
    const auto known = kind.is_string() ? correction_kind(kind.get_ref<const std::string&>()) : std::nullopt;
    if (!known) return refused(place + "/kind", "is none", "use joined, loose, apart, mirrored or unmirrored");
    const json parts = given.value("parts", json());
    if (!parts.is_array() || parts.size() != 2 || !parts[0].is_string() || !parts[1].is_string()) {
      return refused(place + "/parts", "are not two parts", "write [\"node:3/0\", \"node:5/0\"]");
    }
    corrections.push_back({*known, {parts[0].get<std::string>(), parts[1].get<std::string>()}});
  }
  return corrections;
}

Result<Corrections> corrections_from_file(const json& file) {
  if (!file.is_object()) return refused("", "the file holds no JSON object", "write {\"corrections\": […]}");
  for (const auto& [key, value] : file.items()) {
    if (key != "format" && key != "version" && key != "corrections")
      return refused("/" + printable(key), "is no field of corrections", "use corrections only");
  }
  if (file.value("format", json("parsel/corrections")) != "parsel/corrections")
    return refused("/format", "is not parsel/corrections", "check the file");
  if (file.value("version", json(1)) != 1) return refused("/version", "is not 1", "use version 1");
  Result<Corrections> read = corrections_from_json(file.value("corrections", json()));
  if (read.ok()) return read;
  Error error = read.error();
  error.place.insert(0, "/corrections");
  return error;
}

Result<std::vector<Declared>> declared(const Corrections& corrections, const PartData<PartMesh>& meshes) {
  std::map<std::string, std::vector<PartIndex>, std::less<>> by_key;
  for (const PartIndex p : meshes.indices()) {
    const std::string node = "node:" + std::to_string(meshes[p].node);
    by_key[node].push_back(p);
    by_key[node + "/" + std::to_string(meshes[p].primitive)] = {p};
  }
  std::vector<Declared> found;
  for (const Correction& correction : corrections) {
    std::vector<PartIndex> pair;
    for (const std::string& key : correction.parts) {
      const auto parts = by_key.find(key);
      if (parts == by_key.end()) {
        return refused(printable(key), "a correction is about a part that the file does not have",
                       "name parts as node:<index>/<primitive>");
      }
      if (parts->second.size() > 1)
        return refused(printable(key), "it has several primitives", "name one as node:<index>/<primitive>");
      pair.push_back(parts->second.front());
    }
    if (pair[0] == pair[1])
      return refused(printable(correction.parts[0]), "a correction is about one part twice", "name two parts");
    const Declared made{correction.kind, std::minmax(pair[0], pair[1])};
    std::erase_if(found, [&](const Declared& earlier) {
      return earlier.pair == made.pair && is_of_mirrors(earlier.kind) == is_of_mirrors(made.kind);
    });
    found.push_back(made);
  }
  return found;
}

}  // namespace parsel
