// Format `parsel/family` v1.
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/sha256.h"
#include "core/family/family.h"

namespace parsel::family {

namespace {

using Json = nlohmann::json;

std::string_view state_of(const Family& family, std::size_t i) {
  const auto choice = family.options.choices.find(family.constraints[i].id());
  if (choice != family.options.choices.end()) return choice->second == Choice::forced ? "forced" : "off";
  return to_string(family.evidence[i].agreement);
}

Json constraints_json(const Family& family) {
  Json list = Json::array();
  for (std::size_t i = 0; i < family.constraints.size(); ++i) {
    const Constraint& constraint = family.constraints[i];
    const Evidence& evidence = family.evidence[i];
    Json json = {{"id", constraint.id()},        {"kind", to_string(constraint.kind)},
                 {"a", constraint.a.name},       {"b", constraint.b.name},
                 {"state", state_of(family, i)}, {"kept", evidence.is_kept},
                 {"of", evidence.seen},          {"holds", evidence.seen - evidence.broken_by.size()}};
    for (const std::size_t v : evidence.broken_by) json["broken_by"].push_back(family.variations[v].name);
    list.push_back(std::move(json));
  }
  return list;
}

Json sliders_json(const Family& family) {
  Json list = Json::array();
  for (std::size_t k = 0; k < family.sliders.size(); ++k) {
    const Slider& slider = family.sliders[k];
    Json coefficients = Json::object();
    for (const std::size_t i : slider.moves) {
      coefficients[family.layout.parameters[i].name] = family.basis.coefficients[i][k].text();
    }
    const Interval stops = interval(family.bounds, family.base_setting, k);
    const auto end = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
    const auto why = [&](const std::optional<Stop>& stop) { return stop ? Json(stop_text(family, *stop)) : Json(); };
    list.push_back({{"parameter", family.layout.parameters[slider.parameter].name},
                    {"name", slider.name},
                    {"variable", slider.variable},
                    {"section", slider.section},
                    {"value", slider.value},
                    {"min", slider.min},
                    {"max", slider.max},
                    {"stops", {end(stops.low), end(stops.high)}},
                    {"stopped_by", {why(stops.low_stop), why(stops.high_stop)}},
                    {"coefficients", std::move(coefficients)}});
  }
  return list;
}

std::string face_text(const Family& family, std::size_t part, int axis, int side) {
  constexpr const char* words[3][2] = {{"right side", "left side"}, {"underside", "top"}, {"back", "front"}};
  return "the " + std::string(words[axis][side < 0 ? 0 : 1]) + " of the " + family.model.parts[part].name;
}

}  // namespace

std::string stop_text(const Family& family, const Stop& stop) {
  if (!stop.order) {
    const Parameter& parameter = family.layout.parameters[stop.parameter];
    constexpr const char* words[] = {"width", "height", "depth"};
    const std::string what = parameter.quantity == Quantity::top ? "top" : words[parameter.axis];
    return "the " + what + " of the " + family.model.parts[parameter.part].name + " ends";
  }
  const Order& order = *stop.order;
  return face_text(family, order.low_part, order.axis, order.low_side) + " meets " +
         face_text(family, order.high_part, order.axis, order.high_side);
}

Json to_json(const Family& family) {
  std::size_t kept = 0;
  for (const Evidence& evidence : family.evidence) kept += evidence.is_kept;
  constexpr const char* selections[] = {"agreement", "ranking", "ranking_by_derivative", "none"};
  Json json = {{"format", "parsel/family"},
               {"version", 1},
               {"name", family.model.name},
               {"unit", family.model.unit},
               {"cad", sha256_hex(cad::to_json(family.model).dump())},
               {"vocabulary", to_string(family.options.vocabulary)},
               {"selection", selections[static_cast<std::size_t>(family.options.selection)]},
               {"counts",
                {{"parameters", family.layout.size()},
                 {"candidates", family.candidates.all()},
                 {"holding", family.constraints.size()},
                 {"rank", family.base_rank},
                 {"common", kept},
                 {"independent", family.independent.size()},
                 {"dimensions", family.dimensions()},
                 {"sliders", family.sliders.size()},
                 {"orders", family.orders.kept.size()}}},
               {"constraints", constraints_json(family)},
               {"sliders", sliders_json(family)},
               {"warnings", family.warnings}};
  const std::string pinned = family.model.parts[family.pins.part].id,
                    lowest = family.model.parts[family.pins.lowest].id;
  json["pins"] = {{{"of", pinned + ".cx"}, {"value", family.pinned[0]}},
                  {{"of", pinned + ".cz"}, {"value", family.pinned[1]}},
                  {{"of", lowest + ".y-"}, {"value", family.pinned[2]}}};
  json["optional"] = Json::array();
  for (const OptionalGroup& group : family.optional) {
    Json entry = {{"parts", Json::array()}, {"absent_from", Json::array()}};
    for (const std::size_t part : group.parts) entry["parts"].push_back(family.model.parts[part].id);
    for (const std::size_t v : group.absent_from) entry["absent_from"].push_back(family.variations[v].name);
    json["optional"].push_back(std::move(entry));
  }
  json["variations"] = Json::array();
  for (std::size_t v = 0; v < family.variations.size(); ++v) {
    Json entry = {{"name", family.variations[v].name}, {"setting", Json::object()}, {"absent", Json::array()}};
    for (std::size_t k = 0; k < family.sliders.size(); ++k) {
      entry["setting"][family.sliders[k].variable] = family.settings[v][static_cast<Eigen::Index>(k)];
    }
    for (std::size_t p = 0; p < family.model.parts.size(); ++p) {
      if (!family.variations[v].has(p)) entry["absent"].push_back(family.model.parts[p].id);
    }
    json["variations"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace parsel::family
