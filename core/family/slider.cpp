#include "core/family/slider.h"

#include <algorithm>
#include <set>

namespace parsel::family {

namespace {

/// What a size of a part is called. `along` marks the part's sizes that change alike with the slider.
std::string size_word(const cad::Part& part, int axis, const std::array<bool, 3>& along) {
  constexpr const char* words[] = {"width", "height", "depth"};
  const auto count = std::count(along.begin(), along.end(), true);
  if (part.kind == cad::Kind::sphere && count > 1) return "diameter";
  if (part.kind == cad::Kind::cylinder || part.kind == cad::Kind::cone) {
    if (count == 3) return "size";
    if (axis != part.axis) return count == 2 ? "diameter" : words[axis];
    if (axis == 1) return "height";
    return part.size[axis] < part.size[(axis + 1) % 3] ? "width" : "length";
  }
  if (count == 3) return "size";
  if (count == 2) return "section";
  Vec3 sorted = part.size;
  std::sort(sorted.data(), sorted.data() + 3);
  const bool is_thin = part.size[axis] == sorted[0] && sorted[0] <= sorted[1] / 4;
  return is_thin ? "thickness" : words[axis];
}

std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

class Namer {
 public:
  Namer(const Layout& layout, const cad::Model& model, const Basis& basis)
      : layout_(layout), model_(model), basis_(basis) {}

  void name(Slider& slider, Eigen::Index column) {
    const Parameter& own = layout_.parameters[slider.parameter];
    const cad::Part& part = model_.parts[own.part];
    // Of several parts alike that change alike the slider speaks for all: "leg", not "front left leg".
    const std::string stem = cad::stem(part);
    bool speaks_for_all = false;
    std::array<bool, 3> along{false, false, false};
    for (const std::size_t i : slider.moves) {
      const Parameter& other = layout_.parameters[i];
      if (other.quantity == Quantity::size && other.part == own.part) {
        along[static_cast<std::size_t>(other.axis)] = basis_.matrix(static_cast<Eigen::Index>(i), column) == 1;
      }
      speaks_for_all |= other.part != own.part && other.quantity == own.quantity && other.axis == own.axis &&
                        cad::stem(model_.parts[other.part]) == stem;
    }
    const std::string whole = speaks_for_all ? stem : part.name;
    std::string word;
    if (own.quantity == Quantity::size) word = size_word(part, own.axis, along);
    if (own.quantity == Quantity::centre) word = own.axis == 0 ? "sideways" : own.axis == 1 ? "level" : "forward";
    if (own.quantity == Quantity::top) word = layout_.vocabulary == Vocabulary::paper ? "top share" : "top diameter";
    slider.section = capitalised(spaced(whole));
    slider.name = unique(spaced(whole) + " " + word, " ", names_);
    slider.variable = unique(variable_name(slider.name), "_", variables_);
  }

 private:
  static std::string unique(const std::string& wanted, const char* joint, std::set<std::string>& taken) {
    std::string name = wanted;
    for (int k = 2; !taken.insert(name).second; ++k) name = wanted + joint + std::to_string(k);
    return name;
  }

  const Layout& layout_;
  const cad::Model& model_;
  const Basis& basis_;
  std::set<std::string> names_, variables_;
};

}  // namespace

std::string variable_name(std::string_view words) {
  std::string made;
  for (const char c : words) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (is_letter || (c >= '0' && c <= '9')) {
      made += is_letter && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    } else if (!made.empty() && made.back() != '_') {
      made += '_';
    }
  }
  while (made.ends_with('_')) made.pop_back();
  return made.empty() || (made[0] >= '0' && made[0] <= '9') ? "v" + (made.empty() ? made : "_" + made) : made;
}

std::vector<Slider> find_sliders(const Layout& layout, const cad::Model& model, const Basis& basis,
                                 const Eigen::VectorXd& base, const std::vector<Variation>& variations,
                                 const std::vector<Eigen::VectorXd>& settings) {
  std::vector<Slider> sliders;
  Namer namer(layout, model, basis);
  for (std::size_t k = 0; k < basis.free.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    Slider slider;
    slider.parameter = basis.free[k];
    slider.value = slider.min = slider.max = base[column];
    for (std::size_t i = 0; i < layout.size(); ++i) {
      if (!basis.coefficients[i][k].is_zero()) slider.moves.push_back(i);
    }
    for (std::size_t v = 0; v < variations.size(); ++v) {
      const bool counts = std::any_of(slider.moves.begin(), slider.moves.end(),
                                      [&](std::size_t i) { return variations[v].has(layout.parameters[i].part); });
      if (!counts) continue;
      slider.min = std::min(slider.min, settings[v][column]);
      slider.max = std::max(slider.max, settings[v][column]);
    }
    namer.name(slider, column);
    sliders.push_back(std::move(slider));
  }
  return sliders;
}

}  // namespace parsel::family
