#include "core/family/family_scad.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/cad/placing.h"
#include "core/cad/scad_print.h"

namespace parsel::family {

namespace {

/// A parameter as a sum of variables, "leg_section / 2 - seat_width / 2 + 3"; negated on demand.
std::string sum_text(const Family& family, std::size_t parameter, bool negated) {
  std::string out;
  const auto append = [&](bool is_negative, const std::string& term) {
    out += out.empty() ? (is_negative ? "-" : "") : (is_negative ? " - " : " + ");
    out += term;
  };
  for (std::size_t k = 0; k < family.sliders.size(); ++k) {
    const Rational& c = family.basis.coefficients[parameter][k];
    if (c.is_zero()) continue;
    const std::int64_t times = std::abs(c.numerator());
    std::string term = (times == 1 ? "" : std::to_string(times) + " * ") + family.sliders[k].variable;
    if (c.denominator() != 1) term += " / " + std::to_string(c.denominator());
    append((c.numerator() < 0) != negated, term);
  }
  const double constant =
      cad::tidy(family.basis.pin_matrix.row(static_cast<Eigen::Index>(parameter)).dot(family.pinned)) *
      (negated ? -1 : 1);
  if (constant != 0 || out.empty()) append(constant < 0, cad::decimal(std::abs(constant)));
  return out;
}

cad::PartText part_text(const Family& family, std::size_t p) {
  const cad::Part& part = family.model.parts[p];
  cad::PartText text;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    text.centre[i] = sum_text(family, family.layout.centre(p, axis), false);
    text.size[i] = sum_text(family, family.layout.extent(p, axis), false);
  }
  text.minus_z = sum_text(family, family.layout.centre(p, 2), true);
  const auto u = static_cast<std::size_t>((part.axis + 1) % 3), v = static_cast<std::size_t>((part.axis + 2) % 3);
  text.is_round = text.size[u] == text.size[v];
  if (part.kind == cad::Kind::cone) {
    text.top = sum_text(family, family.layout.top(p), false);
    if (family.options.vocabulary == Vocabulary::paper) text.top = "2 * (" + text.top + ") * (" + text.size[u] + ")";
  }
  return text;
}

/// A step that divides the range into some hundred, 1, 2 or 5 times a power of ten.
double step_of(double range) {
  const double power = std::pow(10, std::floor(std::log10(range / 100)));
  for (const double times : {1.0, 2.0, 5.0}) {
    if (range / (times * power) <= 200) return cad::tidy(times * power);
  }
  return cad::tidy(10 * power);
}

std::string declaration(const Family& family, std::size_t k, double value) {
  const Slider& slider = family.sliders[k];
  double low = slider.min, high = slider.max;
  if (!(high - low > family.tolerance)) {  // no variation changes it
    const Interval range = reach(family, k);
    low = range.low;
    high = range.high;
  }
  low = std::min(low, value);
  high = std::max(high, value);
  std::string text = slider.variable + " = " + cad::decimal(cad::tidy(value)) + ";";
  if (high - low > family.tolerance) {
    text += " // [" + cad::decimal(cad::tidy(low)) + " : " + cad::decimal(step_of(high - low)) + " : " +
            cad::decimal(cad::tidy(high)) + "]";
  }
  return text + "\n";
}

}  // namespace

std::string group_variable(const Family& family, const OptionalGroup& group) {
  const cad::Part& first = family.model.parts[group.parts.front()];
  const bool is_alike = std::all_of(group.parts.begin(), group.parts.end(), [&](std::size_t p) {
    return cad::stem(family.model.parts[p]) == cad::stem(first);
  });
  return "with_" + variable_name(is_alike && group.parts.size() > 1 ? cad::stem(first) : first.id);
}

Shown at_base(const Family& family) {
  return {family.base_setting, std::vector<bool>(family.optional.size(), true)};
}

std::string family_scad(const Family& family, const Shown& shown) {
  PARSEL_ASSERT(shown.setting.size() == family.base_setting.size() && shown.with.size() == family.optional.size(),
                "a value a slider, and a choice an optional group");
  std::string out;
  std::vector<std::string> sections;
  for (const Slider& slider : family.sliders) {
    if (std::find(sections.begin(), sections.end(), slider.section) == sections.end())
      sections.push_back(slider.section);
  }
  for (const std::string& section : sections) {
    std::string title = section;
    std::replace_if(
        title.begin(), title.end(), [](char c) { return c == ']' || c == '*' || c == '/'; }, ' ');
    out += "/* [" + title + "] */\n";
    for (std::size_t k = 0; k < family.sliders.size(); ++k) {
      if (family.sliders[k].section == section)
        out += declaration(family, k, shown.setting[static_cast<Eigen::Index>(k)]);
    }
    out += "\n";
  }
  if (!family.optional.empty()) {
    out += "/* [Parts] */\n";
    for (std::size_t g = 0; g < family.optional.size(); ++g) {
      out += group_variable(family, family.optional[g]) + (shown.with[g] ? " = true;\n" : " = false;\n");
    }
    out += "\n";
  }
  out += "/* [Hidden] */\n$fn = 128;\n\n";
  return out + cad::tree_text(family.model, [&](std::size_t p, const std::string& indent) {
           std::string text = indent + "// " + family.model.parts[p].label + "\n" + indent;
           for (const OptionalGroup& group : family.optional) {
             const bool is_in = std::find(group.parts.begin(), group.parts.end(), p) != group.parts.end();
             if (is_in) text += "if (" + group_variable(family, group) + ") ";
           }
           return text + cad::statement_of(family.model.parts[p], part_text(family, p)) + "\n";
         });
}

nlohmann::json parameter_sets(const Family& family) {
  nlohmann::json sets = nlohmann::json::object();
  for (std::size_t v = 0; v < family.variations.size(); ++v) {
    nlohmann::json& set = sets[family.variations[v].name];
    for (std::size_t k = 0; k < family.sliders.size(); ++k) {
      set[family.sliders[k].variable] = cad::decimal(cad::tidy(family.settings[v][static_cast<Eigen::Index>(k)]));
    }
    for (const OptionalGroup& group : family.optional) {
      set[group_variable(family, group)] = family.variations[v].has(group.parts.front()) ? "true" : "false";
    }
  }
  return {{"fileFormatVersion", "1"}, {"parameterSets", std::move(sets)}};
}

}  // namespace parsel::family
