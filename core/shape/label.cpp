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

namespace parsel {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
bool is_separator(char c) {
  return c == ' ' || c == '_' || c == '-' || c == '.' || c == '#' || c == '(' || c == ')' || c == ':' || c == '/';
}

// Longest first, so that "center" goes before a shorter word inside it.
constexpr std::array<std::string_view, 16> glued_words = {"bottom", "middle", "center", "centre", "right", "front",
                                                          "upper",  "lower",  "inner",  "outer",  "left",  "back",
                                                          "rear",   "top",    "bot",    "mid"};
constexpr std::array<std::string_view, 10> short_words = {"l", "r", "lf", "rf", "lb", "rb", "fl", "fr", "bl", "br"};

/// Takes direction words off both ends of a word, glued or whole.
std::string without_direction(std::string word) {
  if (std::find(short_words.begin(), short_words.end(), word) != short_words.end()) return "";
  for (bool changed = true; changed && !word.empty();) {
    changed = false;
    for (const std::string_view direction : glued_words) {
      if (word.size() >= direction.size() && std::string_view(word).starts_with(direction)) {
        word.erase(0, direction.size());
        changed = true;
      } else if (word.size() >= direction.size() && std::string_view(word).ends_with(direction)) {
        word.erase(word.size() - direction.size());
        changed = true;
      }
      if (changed) break;
    }
  }
  return word;
}

std::string readable(std::string_view label) {
  std::string text;
  for (const char c : label) {
    if (c == '_' || c == '-') {
      if (!text.empty() && text.back() != ' ') text += ' ';
    } else {
      text += lower(c);
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
  if (longest < 1e-6 || across > 0.2 * longest) return std::nullopt;
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

/// Words by the sides of the common centre on which each part lies; an axis counts when the part is off centre along it
/// by more than a quarter of the arrangement's largest extent.
std::vector<std::string> side_words(const std::vector<Vec3>& centres) {
  Vec3 low = centres.front(), high = centres.front();
  for (const Vec3& c : centres) {
    low = low.cwiseMin(c);
    high = high.cwiseMax(c);
  }
  const Vec3 middle = (low + high) / 2;
  const double threshold = 0.25 * (high - low).maxCoeff() / 2;
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

bool all_different(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  return std::adjacent_find(words.begin(), words.end()) == words.end();
}

}  // namespace

std::string clean_label(std::string_view name) {
  std::string label = printable(name);
  for (bool changed = true; changed;) {
    changed = false;
    std::size_t end = label.size();
    while (end > 0 && (is_digit(label[end - 1]) || is_separator(label[end - 1]))) --end;
    if (end < label.size()) {
      label.erase(end);
      changed = true;
    }
    // "_L" and ".r", but not the last letter of a word.
    if (label.size() >= 2 && is_separator(label[label.size() - 2]) &&
        (lower(label.back()) == 'l' || lower(label.back()) == 'r')) {
      label.erase(label.size() - 2);
      changed = true;
    }
  }
  std::size_t start = 0;
  while (start < label.size() && is_separator(label[start])) ++start;
  label = printable(label.substr(start));  // a mark may have stood on the separators
  return label.empty() ? "part" : label;
}

std::string grouping_key(std::string_view label) {
  std::string whole, key, word;
  const auto finish_word = [&] {
    whole += word;
    key += without_direction(word);
    word.clear();
  };
  for (std::size_t i = 0; i < label.size(); ++i) {
    const char c = label[i];
    // A capital after a small letter starts a word: "legFrontLeft".
    const bool hump = i > 0 && c >= 'A' && c <= 'Z' && label[i - 1] >= 'a' && label[i - 1] <= 'z';
    if (is_separator(c) || is_digit(c) || hump) finish_word();
    if (!is_separator(c) && !is_digit(c)) word += lower(c);
  }
  finish_word();
  if (!key.empty()) return key;
  return whole.empty() ? "part" : whole;
}

std::string slug(std::string_view label) {
  std::string out;
  for (std::size_t at = 0; at < label.size();) {
    const Character character = character_at(label, at);
    const char c = label[at];
    at += character.size;
    const std::string_view latin = plain_latin(character.code);
    if (is_letter(c) || is_digit(c)) {
      out += lower(c);
    } else if (!latin.empty()) {
      out += latin;
    } else if (!joins_previous(character.code) && !out.empty() && out.back() != '_') {
      out += '_';
    }
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() ? "part" : out;
}

std::vector<PartName> name_parts(const std::vector<std::string>& labels, const std::vector<Vec3>& centres) {
  PARSEL_ASSERT(labels.size() == centres.size(), "every part has a label and a centre");
  // Labels in other letters than Latin ones may have one slug, "part", and mean different things.
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> sharing;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string foreign = is_ascii(labels[i]) ? "" : readable(labels[i]);
    sharing[{slug(labels[i]), foreign}].push_back(i);
  }

  std::vector<PartName> names(labels.size());
  for (const auto& [label, parts] : sharing) {
    const std::string& stem = label.first;
    if (parts.size() == 1) {
      names[parts[0]] = {stem, readable(labels[parts[0]])};
      continue;
    }
    std::vector<Vec3> at;
    for (const std::size_t p : parts) at.push_back(centres[p]);
    const std::optional<int> axis = line_axis(at);
    std::vector<std::string> words;
    if (parts.size() <= 5) words = axis ? line_words(at, *axis) : side_words(at);
    if (!words.empty() && all_different(words)) {
      for (std::size_t i = 0; i < parts.size(); ++i) {
        names[parts[i]] = {stem + "_" + slug(words[i]), words[i] + " " + readable(labels[parts[i]])};
      }
      continue;
    }
    std::vector<std::size_t> order(parts.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (axis) order = order_along(at, *axis);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::string number = std::to_string(i + 1);
      names[parts[order[i]]] = {stem + "_" + number, readable(labels[parts[order[i]]]) + " " + number};
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
