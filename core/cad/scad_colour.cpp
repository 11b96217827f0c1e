#include "core/cad/scad_colour.h"

#include <algorithm>
#include <cstdint>

namespace parsel::cad {

namespace {

struct Named {
  std::string_view name;
  std::uint32_t colour;  ///< 0xRRGGBB
};
// The names of CSS that programs use most.
constexpr Named names[] = {
    {"aqua", 0x00ffff},        {"beige", 0xf5f5dc},      {"black", 0x000000},     {"blue", 0x0000ff},
    {"brown", 0xa52a2a},       {"burlywood", 0xdeb887},  {"chocolate", 0xd2691e}, {"coral", 0xff7f50},
    {"crimson", 0xdc143c},     {"cyan", 0x00ffff},       {"darkblue", 0x00008b},  {"darkgray", 0xa9a9a9},
    {"darkgreen", 0x006400},   {"darkred", 0x8b0000},    {"dimgray", 0x696969},   {"fuchsia", 0xff00ff},
    {"gold", 0xffd700},        {"gray", 0x808080},       {"green", 0x008000},     {"grey", 0x808080},
    {"indigo", 0x4b0082},      {"ivory", 0xfffff0},      {"khaki", 0xf0e68c},     {"lightblue", 0xadd8e6},
    {"lightgray", 0xd3d3d3},   {"lightgreen", 0x90ee90}, {"lime", 0x00ff00},      {"magenta", 0xff00ff},
    {"maroon", 0x800000},      {"navy", 0x000080},       {"olive", 0x808000},     {"orange", 0xffa500},
    {"peru", 0xcd853f},        {"pink", 0xffc0cb},       {"purple", 0x800080},    {"red", 0xff0000},
    {"saddlebrown", 0x8b4513}, {"salmon", 0xfa8072},     {"sienna", 0xa0522d},    {"silver", 0xc0c0c0},
    {"skyblue", 0x87ceeb},     {"slategray", 0x708090},  {"steelblue", 0x4682b4}, {"tan", 0xd2b48c},
    {"teal", 0x008080},        {"tomato", 0xff6347},     {"turquoise", 0x40e0d0}, {"violet", 0xee82ee},
    {"wheat", 0xf5deb3},       {"white", 0xffffff},      {"yellow", 0xffff00}};

std::array<double, 4> from_bits(std::uint32_t bits) {
  return {double(bits >> 16 & 0xff) / 255, double(bits >> 8 & 0xff) / 255, double(bits & 0xff) / 255, 1};
}

/// "#rgb" or "#rrggbb".
std::array<double, 4> from_hex(std::string_view text) {
  std::uint32_t bits = 0;
  for (const char c : text.substr(1)) {
    const std::size_t digit = std::string_view("0123456789abcdef").find(c);
    if (digit == std::string_view::npos) return {0, 0, 0, 0};
    bits = bits << 4 | static_cast<std::uint32_t>(digit);
    if (text.size() == 4) bits = bits << 4 | static_cast<std::uint32_t>(digit);
  }
  return text.size() == 4 || text.size() == 7 ? from_bits(bits) : std::array<double, 4>{0, 0, 0, 0};
}

}  // namespace

std::array<double, 4> read_colour(const CallArguments& given) {
  std::array<double, 4> colour{0, 0, 0, 0};
  if (const Vector* parts = given["c"].vector()) {
    colour[3] = 1;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, parts->size()); ++i) {
      if (const Number* number = (*parts)[i].number()) colour[i] = std::clamp(number->value, 0.0, 1.0);
    }
  } else if (const std::string* text = given["c"].string()) {
    std::string name = text->substr(0, 32);
    for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const auto* found =
        std::find_if(std::begin(names), std::end(names), [&](const Named& n) { return n.name == name; });
    if (found != std::end(names)) colour = from_bits(found->colour);
    if (name.starts_with('#')) colour = from_hex(name);
  }
  if (const auto alpha = given.number("alpha"); alpha && colour[3] > 0) colour[3] = std::clamp(alpha->value, 0.0, 1.0);
  return colour;
}

}  // namespace parsel::cad
