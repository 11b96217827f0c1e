// What of a label says the kind of a part: without directions, counters and what exporters add.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/shape/label.h"
#include "core/shape/label_text.h"

namespace parsel {
namespace {

// Glued to other words as well: "leftwall", "legfrontleft", "Vorderbein". Longest first where one is inside another.
constexpr std::array<std::string_view, 32> glued_words = {
    "bottom", "middle", "center", "centre", "right", "front",  "upper", "lower",  "inner",  "outer",  "left",
    "back",   "rear",   "top",    "bot",    "mid",   "rechts", "links", "vorder", "vorne",  "vorn",   "hinter",
    "hinten", "gauche", "droite", "droit",  "avant", "unten",  "oben",  "mittel", "linkes", "rechtes"};

// Whole words only, beside the glued ones; spelled in small letters, accents as UTF-8.
const std::set<std::string_view>& direction_words() {
  static const std::set<std::string_view> words = {
      // English, and what modellers shorten it to
      "l", "r", "lf", "rf", "lb", "rb", "fl", "fr", "bl", "br", "lh", "rh", "lhs", "rhs", "central",
      // German
      "linke", "linker", "rechte", "rechter", "vordere", "vorderer", "vorderes", "hintere", "hinterer", "hinteres",
      "obere", "oberer", "oberes", "untere", "unterer", "unteres", "ober", "unter", "mitte", "mittlere", "mittlerer",
      "mittleres", "innen", "außen", "aussen", "vl", "vr", "hl", "hr",
      // French
      "arrière", "arriere", "haut", "haute", "bas", "basse", "supérieur", "supérieure", "superieur", "superieure",
      "inférieur", "inférieure", "inferieur", "inferieure", "milieu", "centrale", "devant", "derrière", "derriere",
      "intérieur", "extérieur",
      // Spanish
      "izquierda", "izquierdo", "izq", "derecha", "derecho", "der", "delantera", "delantero", "trasera", "trasero",
      "superior", "inferior", "frontal", "posterior", "arriba", "abajo", "centro", "medio", "media",
      // Italian
      "sinistra", "sinistro", "sx", "destra", "destro", "dx", "anteriore", "posteriore", "davanti", "dietro",
      "superiore", "inferiore", "alto", "alta", "basso", "bassa", "sopra", "sotto", "medio"};
  return words;
}

// Anywhere in a word of Chinese or Japanese, which are written without spaces: left, right, front, back (two forms),
// top, bottom, middle, inside, outside; side (two forms); and the Japanese particle between a direction and its noun.
constexpr std::array<std::string_view, 13> han_directions = {"左", "右", "前", "后", "後", "上", "下",
                                                             "中", "内", "外", "侧", "側", "の"};

/// Words that exporters and modellers write where they mean no part of a thing in particular.
const std::set<std::string_view>& exporter_words() {
  static const std::set<std::string_view> words = {
      "mesh",     "geo",   "geom",        "geometry",  "node",    "object",   "obj",     "component",
      "instance", "inst",  "clone",       "copy",      "kopie",   "copie",    "copia",   "primitive",
      "prim",     "lod",   "material",    "mat",       "shape",   "group",    "grp",     "root",
      "rootnode", "scene", "model",       "sketchfab", "unnamed", "untitled", "default", "defaultmaterial",
      "entity",   "brep",  "polysurface", "part"};
  return words;
}

/// Takes direction words off both ends of a word, glued or whole.
std::string without_direction(std::string word) {
  if (direction_words().count(word) > 0) return "";
  for (bool changed = true; changed && !word.empty();) {
    changed = false;
    for (const std::string_view direction : glued_words) {
      if (std::string_view(word).starts_with(direction)) {
        word.erase(0, direction.size());
        changed = true;
      } else if (std::string_view(word).ends_with(direction)) {
        word.erase(word.size() - direction.size());
        changed = true;
      }
      if (changed) break;
    }
  }
  for (const std::string_view direction : han_directions) {
    for (std::size_t at = word.find(direction); at != std::string::npos; at = word.find(direction)) {
      word.erase(at, direction.size());
    }
  }
  return word;
}

/// Words in small letters: split at separators, digits and where a capital follows a small letter, "legFrontLeft".
/// Hexadecimal numbers are no words.
std::vector<std::string> words_of(std::string_view label) {
  std::vector<std::string> words(1);
  std::string token;
  const auto finish = [&] {
    if (!is_hexadecimal(token)) {
      for (std::size_t i = 0; i < token.size(); ++i) {
        const bool hump = i > 0 && is_upper(token[i]) && is_letter(token[i - 1]) && !is_upper(token[i - 1]);
        if (is_digit(token[i]) || hump) words.emplace_back();
        if (!is_digit(token[i])) words.back() += token[i];
      }
    }
    words.emplace_back();
    token.clear();
  };
  for (const char c : label) {
    if (is_separator(c)) {
      finish();
    } else {
      token += c;
    }
  }
  finish();
  std::erase_if(words, [](const std::string& word) { return word.empty(); });
  for (std::string& word : words) word = small_letters(word);
  return words;
}

/// Bytes at the start that two texts share.
std::size_t shared_start(std::string_view a, std::string_view b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

/// Names are alike that share this share of the shorter one, and at least so many bytes. Less: "door" and "drawer".
/// More: "lega" and "legb" are two kinds.
constexpr double alike_share = 0.6;
constexpr std::size_t alike_bytes = 3;

}  // namespace

std::string grouping_key(std::string_view label) {
  std::string named, directed;
  for (const std::string& word : words_of(without_uuid(label))) {
    if (exporter_words().count(word) > 0) continue;
    directed += word;
    named += without_direction(word);
  }
  if (!named.empty()) return named;
  // What is nothing but directions is a name; what is nothing but an exporter's is none.
  return directed.empty() ? "part" : directed;
}

bool alike(std::string_view a, std::string_view b) {
  const std::size_t shorter = std::min(a.size(), b.size());
  const std::size_t start = shared_start(a, b);
  const std::string back_a(a.rbegin(), a.rend()), back_b(b.rbegin(), b.rend());
  const std::size_t end = std::min(shared_start(back_a, back_b), shorter - start);
  return start + end >=
         std::max(alike_bytes, static_cast<std::size_t>(std::ceil(alike_share * static_cast<double>(shorter))));
}

}  // namespace parsel
