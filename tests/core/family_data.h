// The five programs of ReparamCAD with variations, and what is expected of them: data that is not part of the project.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/family/variation.h"

namespace parsel::test {

struct FamilyCase {
  std::string name;
  cad::Model model;
  nlohmann::json expected;  ///< the model's entry
};

/// The models in metres, parts in order. None, and a line that says so, where PARSEL_DATA has no reparamcad.json.
inline const std::vector<FamilyCase>& family_cases() {
  static const std::vector<FamilyCase> cases = [] {
    std::vector<FamilyCase> made;
    const char* data = std::getenv("PARSEL_DATA");
    const std::filesystem::path path = std::filesystem::path(data == nullptr ? "" : data) / "reparamcad.json";
    if (data == nullptr || !std::filesystem::exists(path)) {
      std::cerr << "skipped: PARSEL_DATA has no reparamcad.json\n";
      return made;
    }
    std::ifstream file(path);
    const nlohmann::json json = nlohmann::json::parse(file);
    for (const char* name : {"bottle", "camera", "chair", "table", "car"}) {
      const nlohmann::json& entry = json["models"][name];
      FamilyCase one{name, {}, entry};
      one.model.name = name;
      one.model.unit = "m";
      for (const nlohmann::json& primitive : entry["primitives"]) {
        cad::Part part;
        part.id = part.label = part.name = primitive["name"];
        const std::string kind = primitive["kind"];
        for (int i = 0; i < 3; ++i) {
          part.centre[i] = primitive["centre"][static_cast<std::size_t>(i)];
          part.size[i] = primitive["size"][static_cast<std::size_t>(i)];
        }
        if (kind != "cube") {
          part.kind = cad::Kind::cylinder;
          part.axis = kind.back() - 'x';
        }
        if (primitive.contains("r_top")) {
          part.kind = cad::Kind::cone;
          part.top = primitive["r_top"].get<double>() * 2 * part.size[(part.axis + 1) % 3];
        }
        one.model.tree.children.push_back({cad::Node::Op::leaf, one.model.parts.size(), {}});
        one.model.parts.push_back(std::move(part));
      }
      made.push_back(std::move(one));
    }
    return made;
  }();
  return cases;
}

/// The hand-made variations of one of its sets of votes, values in the paper's vocabulary.
inline std::vector<family::Variation> variations_of(const FamilyCase& one, std::size_t set = 0) {
  std::vector<family::Variation> made;
  for (const auto& [name, entry] : one.expected["votes"][set]["variations"].items()) {
    family::Variation variation;
    variation.name = name;
    const auto numbers = entry["parameters"].get<std::vector<double>>();
    variation.values = Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
    variation.absent.assign(one.model.parts.size(), false);
    for (const nlohmann::json& part : entry["absent"]) {
      variation.absent[static_cast<std::size_t>(one.model.find(part.get<std::string>()) - one.model.parts.data())] =
          true;
    }
    made.push_back(std::move(variation));
  }
  return made;
}

}  // namespace parsel::test
