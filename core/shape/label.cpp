#include "core/shape/label.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "core/base/result.h"
#include "core/base/text.h"
#include "core/shape/label_text.h"

namespace parsel {
namespace {

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

std::string readable(std::string_view label) {
  std::string text;
  for (const char c : small_letters(label)) {
    if (c == '_' || c == '-') {
      if (!text.empty() && text.back() != ' ') text += ' ';
    } else {
      text += c;
    }
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "part" : text;
}

// Words for the negative and the positive side of each axis.
constexpr std::array<std::array<std::string_view, 2>, 3> sides = {
    {{"right", "left"}, {"bottom", "top"}, {"back", "front"}}};
// Vertical first, then depth, then width: "top front left".
constexpr std::array<int, 3> word_order = {1, 2, 0};

/// Centres are a line when they are off it by less than this share of its length. Less: legs of one side, one of them a
/// little further out, get corner words. More: the corners of a long table are a line.
constexpr double line_width = 0.2;
/// … or by less than this, when no two of three or more come closer along the line than this share of an even step:
/// side panels that stand left, centre and right, each of another height.
constexpr double loose_line_width = 0.6, loose_line_step = 0.5;
/// Coordinates closer than this share of the arrangement's largest extent are one level of a grid.
constexpr double grid_level = 0.1;
/// A part is on a side when it is off the middle by this share of the arrangement's largest half extent.
constexpr double side_share = 0.25;

std::vector<std::size_t> order_along(const std::vector<Vec3>& centres, int axis);

/// The axis along which the centres lie on a line, if they do.
std::optional<int> line_axis(const std::vector<Vec3>& centres) {
  Vec3 low = centres.front(), high = centres.front();
  for (const Vec3& c : centres) {
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  const Vec3 extent = high - low;
  int axis = 0;
  const double longest = extent.maxCoeff(&axis);
  const double across = std::max(extent[(axis + 1) % 3], extent[(axis + 2) % 3]);
  if (longest < 1e-6) return std::nullopt;
  if (across <= line_width * longest) return axis;
  if (centres.size() < 3 || across > loose_line_width * longest) return std::nullopt;
  const std::vector<std::size_t> order = order_along(centres, axis);
  const double step = longest / static_cast<double>(centres.size() - 1);
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    if (centres[order[i]][axis] - centres[order[i + 1]][axis] < loose_line_step * step) return std::nullopt;
  }
  return axis;
}

std::vector<std::size_t> order_along(const std::vector<Vec3>& centres, int axis) {
  std::vector<std::size_t> order(centres.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return centres[a][axis] > centres[b][axis]; });
  return order;  // the positive side (left, top, front) comes first
}

std::vector<std::string> line_words(const std::vector<Vec3>& centres, int axis) {
  const std::string first(sides[static_cast<std::size_t>(axis)][1]), last(sides[static_cast<std::size_t>(axis)][0]);
  static const std::string center = "center";
  const std::vector<std::vector<std::string>> words = {
      {first, last},
      {first, center, last},
      {first, first + "-" + center, last + "-" + center, last},
      {first, first + "-" + center, center, last + "-" + center, last}};
  const std::vector<std::size_t> order = order_along(centres, axis);
  std::vector<std::string> out(centres.size());
  for (std::size_t i = 0; i < order.size(); ++i) out[order[i]] = words[centres.size() - 2][i];
  return out;
}

/// Words by the sides of the common centre on which each part lies.
std::vector<std::string> side_words(const std::vector<Vec3>& centres) {
  Vec3 low = centres.front(), high = centres.front();
  for (const Vec3& c : centres) {
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  const Vec3 middle = (low + high) / 2;
  const double threshold = side_share * (high - low).maxCoeff() / 2;
  std::vector<std::string> out;
  for (const Vec3& c : centres) {
    std::string words;
    for (const int axis : word_order) {
      const double offset = c[axis] - middle[axis];
      if (std::abs(offset) <= threshold) continue;
      if (!words.empty()) words += ' ';
      words += sides[static_cast<std::size_t>(axis)][offset > 0 ? 1 : 0];
    }
    out.push_back(words.empty() ? "center" : words);
  }
  return out;
}

/// Words by rows and columns: every axis has at most three levels, told "front left", "front center", "front right".
/// Nothing for what is no such grid.
std::vector<std::string> grid_words(const std::vector<Vec3>& centres) {
  Vec3 low = centres.front(), high = centres.front();
  for (const Vec3& c : centres) {
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  const double step = grid_level * (high - low).maxCoeff();
  std::vector<std::string> out(centres.size());
  for (const int axis : word_order) {
    const std::vector<std::size_t> order = order_along(centres, axis);
    std::vector<std::size_t> level(centres.size(), 0);
    std::size_t last = 0;
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (centres[order[i - 1]][axis] - centres[order[i]][axis] > step) ++last;
      level[order[i]] = last;
    }
    if (last > 2) return {};
    for (std::size_t i = 0; i < centres.size() && last > 0; ++i) {
      const auto& ends = sides[static_cast<std::size_t>(axis)];
      if (!out[i].empty()) out[i] += ' ';
      out[i] += level[i] == 0 ? ends[1] : level[i] == last ? ends[0] : "center";
    }
  }
  return out;
}

/// "leg 2" was typed by a person, "leg.002" and "leg_2" come from a program.
bool has_typed_counter(std::string_view name) {
  std::size_t end = name.size();
  while (end > 0 && is_digit(name[end - 1])) --end;
  return end < name.size() && end > 0 && name[end - 1] == ' ';
}

bool all_different(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  return std::adjacent_find(words.begin(), words.end()) == words.end();
}

}  // namespace

std::string clean_label(std::string_view name) {
  constexpr std::size_t limit = 64;
  // Longer than the result may be, so that a bracket at the end is seen whole.
  std::string label = without_uuid(printable(name, 4 * limit));
  for (std::size_t before = label.size() + 1; label.size() < before;) {
    before = label.size();
    label = without_copy_mark(label);
    while (!label.empty() && (is_digit(label.back()) || (is_separator(label.back()) && label.back() != ')'))) {
      label.pop_back();
    }
    // "_L" and ".r", but not the last letter of a word.
    if (label.size() >= 2 && is_separator(label[label.size() - 2])) {
      const std::string last = small_letters(label.substr(label.size() - 1));
      if (last == "l" || last == "r") label.erase(label.size() - 2);
    }
  }
  std::size_t start = 0;
  while (start < label.size() && is_separator(label[start])) ++start;
  label = printable(std::string_view(label).substr(start), limit);  // a mark may have stood on the separators
  return label.empty() ? "part" : label;
}

std::string shown_name(std::string_view name) {
  std::string shown = without_copy_mark(without_uuid(printable(name, 256)));
  while (!shown.empty() && is_separator(shown.back()) && shown.back() != ')') shown.pop_back();
  return printable(shown);
}

std::string slug(std::string_view label) {
  std::string out;
  for (std::size_t at = 0; at < label.size();) {
    const Character character = character_at(label, at);
    const char c = label[at];
    at += character.size;
    const std::string_view latin = plain_latin(character.code);
    if (is_letter(c) || is_digit(c)) {
      out += small_letters(label.substr(at - character.size, 1));
    } else if (!latin.empty()) {
      out += latin;
    } else if (!joins_previous(character.code) && !out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "part" : out;
}

std::vector<PartName> name_parts(const std::vector<std::string>& labels, const std::vector<Vec3>& centres,
                                 const std::vector<std::string>& given) {
  PARSEL_ASSERT(labels.size() == centres.size(), "every part has a label and a centre");
  PARSEL_ASSERT(given.empty() || given.size() == labels.size(), "every part has a name");
  // Labels in other letters than Latin ones may have one slug, "part", and mean different things.
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> sharing;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string foreign = is_ascii(labels[i]) ? "" : readable(labels[i]);
    sharing[{slug(labels[i]), foreign}].push_back(i);
  }
  std::map<std::string, std::size_t> times;
  for (const std::string& name : given) ++times[name];

  std::vector<PartName> names(labels.size());
  for (const auto& [kind, parts] : sharing) {
    const std::string& stem = kind.first;
    const auto name = [&](std::size_t part, const std::string& words, bool in_front) -> std::string {
      const std::string shown = given.empty() || times[given[part]] > 1 ? "" : shown_name(given[part]);
      if (!shown.empty() && (words.empty() || has_typed_counter(shown))) return shown;
      const std::string label = readable(labels[part]);
      if (words.empty()) return label;
      if (!in_front) return label + " " + words;
      // "left doorleft" says less than "doorleft (left)".
      std::string plain = stem;
      std::erase(plain, '_');
      return grouping_key(labels[part]) == plain ? words + " " + label : label + " (" + words + ")";
    };
    if (parts.size() == 1) {
      names[parts[0]] = {stem, name(parts[0], "", true)};
      continue;
    }
    std::vector<Vec3> at;
    for (const std::size_t p : parts) at.push_back(centres[p]);
    const std::optional<int> axis = line_axis(at);
    std::vector<std::string> words;
    if (parts.size() <= 5) {
      words = axis ? line_words(at, *axis) : side_words(at);
    } else if (!axis) {
      words = grid_words(at);
    }
    if (!words.empty() && all_different(words)) {
      for (std::size_t i = 0; i < parts.size(); ++i) {
        names[parts[i]] = {stem + "_" + slug(words[i]), name(parts[i], words[i], true)};
      }
      continue;
    }
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (axis) order = order_along(at, *axis);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::string number = std::to_string(i + 1);
      names[parts[order[i]]] = {stem + "_" + number, name(parts[order[i]], number, false)};
    }
  }
  // "leg_front" as a label of its own may meet "leg" extended by "front".
  std::set<std::string> taken;
  for (PartName& name : names) {
    const std::string stem = name.id;
    for (int n = 2; !taken.insert(name.id).second; ++n) name.id = stem + "_" + std::to_string(n);
  }
  return names;
}

}  // namespace parsel
