#include "core/family/variation.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/text.h"

namespace parsel::family {

namespace {

using Json = nlohmann::json;

/// Thrown and caught within this file.
struct Fault {
  std::string place, cause, fix;
};

std::string token(std::string_view key) {
  std::string made;
  for (const char c : printable(key)) made += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return made;
}

class Reader {
 public:
  Reader(const Layout& layout, const cad::Model& model)
      : layout_(layout), model_(model), base_(values_of(layout, model)) {}

  std::vector<Variation> read(const Json& json) const {
    if (!json.is_object() || json.value("format", Json()) != "parsel/variations" ||
        json.value("version", Json()) != 1) {
      throw Fault{"/format", "it is no parsel/variations of version 1", "write the format and the version"};
    }
    const Json list = json.value("variations", Json());
    if (!list.is_array() || list.size() > VariationLimits::variations) {
      throw Fault{"/variations", "it is no list of at most 100 variations", "write them as a list"};
    }
    std::vector<Variation> variations;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string place = "/variations/" + std::to_string(i);
      Variation read = one(list[i], place);
      const auto is_same = [&](const Variation& other) { return other.name == read.name; };
      if (std::any_of(variations.begin(), variations.end(), is_same)) {
        throw Fault{place + "/name", "the name \"" + read.name + "\" is used twice", "give it another name"};
      }
      variations.push_back(std::move(read));
    }
    return variations;
  }

 private:
  std::size_t part(const std::string& id, const std::string& place) const {
    const cad::Part* found = model_.find(id);
    if (!found) throw Fault{place, "the model has no part \"" + printable(id) + "\"", "use one of the model's ids"};
    return static_cast<std::size_t>(found - model_.parts.data());
  }

  static double number(const Json& json, const std::string& place) {
    if (!json.is_number() || !(std::abs(json.get<double>()) <= cad::Limits::coordinate)) {
      throw Fault{place, "it is no number of at most a million", "write a number"};
    }
    return json.get<double>();
  }

  void bounds_into(const Json& json, const std::string& place, Values& values) const {
    if (!json.is_object()) throw Fault{place, "it is no object of bounds by part", "write {part: [[x0, x1], …]}"};
    for (const auto& [id, bounds] : json.items()) {
      const std::string at = place + "/" + token(id);
      const std::size_t p = part(id, at);
      if (!bounds.is_array() || bounds.size() != 3)
        throw Fault{at, "it has no three pairs", "write [[x0, x1], [y0, y1], [z0, z1]]"};
      for (int axis = 0; axis < 3; ++axis) {
        const Json& pair = bounds[static_cast<std::size_t>(axis)];
        if (!pair.is_array() || pair.size() != 2)
          throw Fault{at, "it has no three pairs", "write [[x0, x1], [y0, y1], [z0, z1]]"};
        const double low = number(pair[0], at), high = number(pair[1], at);
        if (!(low < high)) throw Fault{at, "a lower bound is not below its upper bound", "write the lower one first"};
        // As decimals: what reads as joined is joined.
        values[static_cast<Eigen::Index>(layout_.centre(p, axis))] = (low + high) / 2;
        values[static_cast<Eigen::Index>(layout_.extent(p, axis))] = high - low;
      }
    }
  }

  Variation one(const Json& json, const std::string& place) const {
    if (!json.is_object()) throw Fault{place, "it is no object", "write {\"name\": …}"};
    Variation made;
    for (const auto& [key, value] : json.items()) {
      constexpr std::string_view known[] = {"name", "source", "votes", "bounds", "values", "absent"};
      if (std::find(std::begin(known), std::end(known), key) == std::end(known)) {
        throw Fault{place + "/" + token(key), "this field is not known", "take it out"};
      }
    }
    const Json name = json.value("name", Json()), source = json.value("source", Json("hand"));
    if (!name.is_string() || is_blank(name.get<std::string>()))
      throw Fault{place + "/name", "it has no name", "name it"};
    made.name = printable(name.get<std::string>(), VariationLimits::name_bytes);
    if (source != "hand" && source != "model" && source != "edit") {
      throw Fault{place + "/source", "it is none of hand, model and edit", "write one of them"};
    }
    made.source = source.get<std::string>();
    const Json votes = json.value("votes", Json(1));
    if (!votes.is_number_integer() || votes < 1 || votes > 1000) {
      throw Fault{place + "/votes", "it is no whole number from 1", "write how many replies agreed"};
    }
    made.votes = votes.get<int>();
    made.values = base_;
    made.absent.assign(model_.parts.size(), false);
    if (json.contains("bounds")) bounds_into(json["bounds"], place + "/bounds", made.values);
    values_into(json.value("values", Json::object()), place + "/values", made.values);
    const Json absent = json.value("absent", Json::array());
    if (!absent.is_array()) throw Fault{place + "/absent", "it is no list of parts", "write a list of ids"};
    for (const Json& id : absent) {
      if (!id.is_string()) throw Fault{place + "/absent", "it is no list of parts", "write a list of ids"};
      made.absent[part(id.get<std::string>(), place + "/absent")] = true;
    }
    if (std::all_of(made.absent.begin(), made.absent.end(), [](bool b) { return b; })) {
      throw Fault{place + "/absent", "no part is left", "leave at least one"};
    }
    return made;
  }

  void values_into(const Json& json, const std::string& place, Values& values) const {
    if (!json.is_object()) throw Fault{place, "it is no object of numbers by parameter", "write {parameter: number}"};
    for (const auto& [name, value] : json.items()) {
      const std::string at = place + "/" + token(name);
      const std::size_t i = layout_.find(name);
      if (i == layout_.size()) throw Fault{at, "the model has no such parameter", "use seat.cx, seat.sx and the like"};
      const double given = number(value, at);
      const Quantity quantity = layout_.parameters[i].quantity;
      if (quantity == Quantity::size ? !(given > 0) : quantity == Quantity::top && !(given >= 0)) {
        throw Fault{at, "a size is not positive", "write a positive number, or name the part as absent"};
      }
      values[static_cast<Eigen::Index>(i)] = given;
    }
  }

  const Layout& layout_;
  const cad::Model& model_;
  Values base_;
};

}  // namespace

Result<std::vector<Variation>> variations_from_json(const Json& json, const Layout& layout, const cad::Model& model) {
  try {
    return Reader(layout, model).read(json);
  } catch (const Fault& fault) {
    return Error{"family/variation", fault.place, fault.cause, fault.fix};
  }
}

Json to_json(const std::vector<Variation>& variations, const Layout& layout, const cad::Model& model) {
  Json list = Json::array();
  for (const Variation& variation : variations) {
    Json values = Json::object(), absent = Json::array();
    for (std::size_t i = 0; i < layout.size(); ++i) {
      if (variation.has(layout.parameters[i].part)) {
        values[layout.parameters[i].name] = variation.values[static_cast<Eigen::Index>(i)] + 0.0;
      }
    }
    for (std::size_t p = 0; p < model.parts.size(); ++p) {
      if (!variation.has(p)) absent.push_back(model.parts[p].id);
    }
    list.push_back({{"name", variation.name},
                    {"source", variation.source},
                    {"votes", variation.votes},
                    {"values", std::move(values)},
                    {"absent", std::move(absent)}});
  }
  return {{"format", "parsel/variations"}, {"version", 1}, {"variations", std::move(list)}};
}

}  // namespace parsel::family
