// Variations: other instances of what a model is one of ("bench", "bar stool"), with numbers for every part that they
// have (ReparamCAD §3.2, §3.3; here they are given, by hand, by a language model or by an edit, not fitted to images).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/family/layout.h"

namespace parsel::family {

struct Variation {
  std::string name;
  std::string source = "hand";  ///< "hand", "model" or "edit"
  int votes = 1;
  Values values;             ///< in the layout's order; of absent parts as in the base, until fill() finds better
  std::vector<bool> absent;  ///< by part

  bool has(std::size_t part) const { return !absent[part]; }
};

struct VariationLimits {
  static constexpr std::size_t variations = 100;
  static constexpr std::size_t name_bytes = 64;
};

/// Format `parsel/variations` v1: {"format","version","variations":[{"name","source"?,"votes"?,"bounds"?:{part id:
/// [[x0,x1],[y0,y1],[z0,z1]]},"values"?:{parameter name: number},"absent"?:[part ids]}]}. Bounds are of the part's size
/// about its centre, in the model's frame and unit; values come after bounds; what is not given is as in the base.
/// Refuses unknown parts and parameters by name, sizes that are not positive, and a name used twice. Error place is a
/// JSON pointer.
Result<std::vector<Variation>> variations_from_json(const nlohmann::json& json, const Layout& layout,
                                                    const cad::Model& model);
nlohmann::json to_json(const std::vector<Variation>& variations, const Layout& layout, const cad::Model& model);

}  // namespace parsel::family
