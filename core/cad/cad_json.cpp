// Format `parsel/cad` v1.
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/cad/model.h"

namespace parsel::cad {

namespace {

using Json = nlohmann::json;

constexpr std::string_view axis_names = "xyz";
constexpr std::string_view op_names[] = {"", "union", "difference", "intersection"};

template <class Values>
Json numbers(const Values& values, std::size_t count) {
  Json array = Json::array();
  for (std::size_t i = 0; i < count; ++i) array.push_back(values[static_cast<int>(i)] + 0.0);
  return array;
}

Json places(const std::array<Place, 3>& given) {
  Json array = Json::array();
  for (const Place& place : given) array.push_back({place.line, place.column});
  return array;
}

Json json_of(const Part& part) {
  Json json = {{"id", part.id}, {"label", part.label}, {"name", part.name}, {"kind", to_string(part.kind)}};
  if (part.kind == Kind::cylinder || part.kind == Kind::cone) {
    std::string axis(1, axis_names[static_cast<std::size_t>(part.axis)]);
    if (part.kind == Kind::cone || part.sides > 0) axis += part.towards > 0 ? '+' : '-';
    json["axis"] = axis;
  }
  json["centre"] = numbers(part.centre, 3);
  json["size"] = numbers(part.size, 3);
  if (part.kind == Kind::cone) json["top"] = part.top;
  if (part.sides > 0) {
    json["sides"] = part.sides;
    json["phase"] = part.phase;
  }
  if (part.colour[3] > 0) json["colour"] = part.colour;
  json["role"] = to_string(part.role);
  if (part.place.line > 0) {
    json["place"] = {part.place.line, part.place.column};
    json["places"] = {{"size", places(part.size_places)}, {"centre", places(part.centre_places)}};
  }
  return json;
}

Json json_of(const Node& node, const Model& model) {
  if (node.op == Node::Op::leaf) return model.parts[node.part].id;
  Json json = Json::array({op_names[static_cast<std::size_t>(node.op)]});
  for (const Node& child : node.children) json.push_back(json_of(child, model));
  return json;
}

/// Thrown and caught within this file.
struct Fault {
  std::string place, cause;
};

class Reader {
 public:
  explicit Reader(const nlohmann::json& json) : json_(json) {}

  Model read() {
    const nlohmann::json& root = json_;
    if (!root.is_object()) throw Fault{"", "it is no object"};
    if (text(root, "", "format") != "parsel/cad" || number(root, "", "version") != 1) {
      throw Fault{"/format", "it is no parsel/cad of version 1"};
    }
    Model model;
    model.name = printable(text(root, "", "name"), 200);
    model.unit = printable(text(root, "", "unit"), 16);
    const nlohmann::json& parts = member(root, "", "parts");
    if (!parts.is_array() || parts.size() > Limits::parts)
      throw Fault{"/parts", "it is no list of at most 2,000 parts"};
    for (std::size_t i = 0; i < parts.size(); ++i) model.parts.push_back(part(parts[i], "/parts/" + std::to_string(i)));
    if (root.contains("tree")) {
      model.tree = node(root["tree"], model, "/tree", 0);
    } else {
      for (std::size_t i = 0; i < model.parts.size(); ++i) model.tree.children.push_back({Node::Op::leaf, i, {}});
    }
    if (root.contains("ranges")) ranges_into(root["ranges"], model);
    if (root.contains("warnings")) {
      for (const nlohmann::json& warning : root["warnings"]) {
        if (!warning.is_string() || model.warnings.size() == Limits::notices)
          throw Fault{"/warnings", "it is no list of texts"};
        model.warnings.push_back({{}, printable(warning.get<std::string>(), 300)});
      }
    }
    return model;
  }

 private:
  static const nlohmann::json& member(const nlohmann::json& json, const std::string& place, const std::string& key) {
    if (!json.is_object() || !json.contains(key)) throw Fault{place + "/" + key, "it is missing"};
    return json[key];
  }
  static std::string text(const nlohmann::json& json, const std::string& place, const std::string& key) {
    const nlohmann::json& value = member(json, place, key);
    if (!value.is_string()) throw Fault{place + "/" + key, "it is no text"};
    return value.get<std::string>();
  }
  static double number(const nlohmann::json& json, const std::string& place, const std::string& key) {
    const nlohmann::json& value = member(json, place, key);
    if (!value.is_number()) throw Fault{place + "/" + key, "it is no number"};
    return value.get<double>();
  }
  static int whole(const nlohmann::json& value, const std::string& place) {
    if (!value.is_number_integer() || value < 0 || value > 1'000'000'000)
      throw Fault{place, "it is no whole number from 0"};
    return value.get<int>();
  }
  static std::vector<double> list(const nlohmann::json& json, const std::string& place, const std::string& key,
                                  std::size_t count) {
    const nlohmann::json& value = member(json, place, key);
    if (!value.is_array() || value.size() != count) {
      throw Fault{place + "/" + key, "it is no list of " + std::to_string(count) + " numbers"};
    }
    std::vector<double> made;
    for (const nlohmann::json& one : value) {
      if (!one.is_number()) throw Fault{place + "/" + key, "it holds something that is no number"};
      made.push_back(one.get<double>());
    }
    return made;
  }
  static Place place_from(const nlohmann::json& value, const std::string& place) {
    if (!value.is_array() || value.size() != 2) throw Fault{place, "it is no pair of line and column"};
    return {whole(value[0], place), whole(value[1], place)};
  }

  static Part part(const nlohmann::json& json, const std::string& place) {
    Part made;
    made.id = text(json, place, "id");
    made.label = printable(text(json, place, "label"));
    made.name = printable(text(json, place, "name"), 200);
    const std::string kind = text(json, place, "kind");
    bool is_known = false;
    for (const Kind one : {Kind::box, Kind::cylinder, Kind::cone, Kind::sphere, Kind::opaque}) {
      if (to_string(one) == kind) made.kind = one, is_known = true;
    }
    if (!is_known) throw Fault{place + "/kind", "it is none of box, cylinder, cone, sphere and opaque"};
    if (made.kind == Kind::cylinder || made.kind == Kind::cone) {
      const std::string axis = text(json, place, "axis");
      const std::size_t index = axis.empty() ? std::string_view::npos : axis_names.find(axis[0]);
      if (index == std::string_view::npos || axis.size() > 2 ||
          (axis.size() == 2 && axis[1] != '+' && axis[1] != '-')) {
        throw Fault{place + "/axis", "it is none of x, y and z, with + or - behind"};
      }
      made.axis = static_cast<int>(index);
      made.towards = axis.size() == 2 && axis[1] == '-' ? -1 : 1;
    }
    const std::vector<double> centre = list(json, place, "centre", 3), size = list(json, place, "size", 3);
    for (int i = 0; i < 3; ++i) {
      made.centre[i] = centre[static_cast<std::size_t>(i)];
      made.size[i] = size[static_cast<std::size_t>(i)];
    }
    if (made.kind == Kind::cone) made.top = number(json, place, "top");
    if (json.contains("sides")) {
      made.sides = whole(json["sides"], place + "/sides");
      made.phase = whole(member(json, place, "phase"), place + "/phase");
    }
    if (json.contains("colour")) {
      const std::vector<double> colour = list(json, place, "colour", 4);
      for (std::size_t i = 0; i < 4; ++i) {
        if (!(colour[i] >= 0 && colour[i] <= 1)) throw Fault{place + "/colour", "it holds a number beyond 0 … 1"};
        made.colour[i] = colour[i];
      }
    }
    const std::string role = text(json, place, "role");
    made.role = role == "cut" ? Role::cut : role == "meet" ? Role::meet : Role::add;
    if (json.contains("place")) made.place = place_from(json["place"], place + "/place");
    if (json.contains("places")) {
      const nlohmann::json &sizes = member(json["places"], place + "/places", "size"),
                           &centres = member(json["places"], place + "/places", "centre");
      for (std::size_t i = 0; i < 3; ++i) {
        if (sizes.size() != 3 || centres.size() != 3) throw Fault{place + "/places", "it holds no three places"};
        made.size_places[i] = place_from(sizes[i], place + "/places/size");
        made.centre_places[i] = place_from(centres[i], place + "/places/centre");
      }
    }
    return made;
  }

  static Node node(const nlohmann::json& json, const Model& model, const std::string& place, std::size_t depth) {
    Node made;
    if (json.is_string()) {
      const Part* part = model.find(json.get<std::string>());
      if (!part) throw Fault{place, "no part has this id"};
      made.op = Node::Op::leaf;
      made.part = static_cast<std::size_t>(part - model.parts.data());
      return made;
    }
    if (!json.is_array() || json.size() < 2 || !json[0].is_string()) throw Fault{place, "it is no operation on parts"};
    const std::string op = json[0].get<std::string>();
    made.op = op == op_names[1] ? Node::Op::unite : op == op_names[2] ? Node::Op::subtract : Node::Op::intersect;
    if (made.op == Node::Op::intersect && op != op_names[3]) throw Fault{place + "/0", "it is no operation"};
    for (std::size_t i = 1; i < json.size(); ++i) {
      made.children.push_back(node(json[i], model, place + "/" + std::to_string(i), depth + 1));
    }
    return made;
  }

  static void ranges_into(const nlohmann::json& json, Model& model) {
    for (std::size_t i = 0; i < json.size() && i < Limits::parts; ++i) {
      const std::string place = "/ranges/" + std::to_string(i);
      CustomizerRange range;
      range.name = printable(text(json[i], place, "name"));
      range.section = printable(text(json[i], place, "section"));
      const std::vector<double> given = list(json[i], place, "range", 4);
      range.value = given[0], range.min = given[1], range.step = given[2], range.max = given[3];
      range.place = place_from(member(json[i], place, "place"), place + "/place");
      model.ranges.push_back(std::move(range));
    }
  }

  const nlohmann::json& json_;
};

}  // namespace

nlohmann::json to_json(const Model& model) {
  Json json = {{"format", "parsel/cad"}, {"version", 1}, {"name", model.name}, {"unit", model.unit}};
  json["parts"] = Json::array();
  for (const Part& part : model.parts) json["parts"].push_back(json_of(part));
  if (!model.is_plain_union()) json["tree"] = json_of(model.tree, model);
  for (const CustomizerRange& range : model.ranges) {
    json["ranges"].push_back({{"name", range.name},
                              {"section", range.section},
                              {"range", {range.value, range.min, range.step, range.max}},
                              {"place", {range.place.line, range.place.column}}});
  }
  for (const Notice& warning : model.warnings) {
    json["warnings"].push_back((warning.place.line > 0 ? to_string(warning.place) + ": " : "") + warning.text);
  }
  return json;
}

Result<Model> model_from_json(const nlohmann::json& json) {
  try {
    Model model = Reader(json).read();
    if (Status valid = validate(model); !valid) return valid.error();
    return model;
  } catch (const Fault& fault) {
    return Error{"cad/json", fault.place, fault.cause, "write it as parsel cad does"};
  }
}

}  // namespace parsel::cad
