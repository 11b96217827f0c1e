// Colours of the gallery: woods, textiles and metals that go together.
#pragma once

#include <cstdint>

namespace parsel::gallery {

struct Finish {
  const char* name;
  std::uint32_t colour;  ///< 0xRRGGBB in sRGB, as designers write it
  double roughness;
  double metallic;
};

namespace finish {
inline constexpr Finish oak{"oak", 0xC99E6E, 0.62, 0};
inline constexpr Finish walnut{"walnut", 0x80573B, 0.55, 0};
inline constexpr Finish beech{"beech", 0xDFBF94, 0.6, 0};
inline constexpr Finish birch{"birch", 0xE9D8B6, 0.6, 0};
inline constexpr Finish cherry{"cherry", 0xA9643F, 0.5, 0};
inline constexpr Finish cedar{"cedar", 0xB77F57, 0.75, 0};
inline constexpr Finish white{"white lacquer", 0xF2EFE8, 0.45, 0};
inline constexpr Finish cream{"cream", 0xEADFC8, 0.6, 0};
inline constexpr Finish sage{"sage green", 0x93A88D, 0.6, 0};
inline constexpr Finish forest{"forest green", 0x55725E, 0.6, 0};
inline constexpr Finish teal{"teal", 0x46808A, 0.65, 0};
inline constexpr Finish slate{"slate", 0x5D6B76, 0.7, 0};
inline constexpr Finish navy{"navy", 0x3B4E68, 0.7, 0};
inline constexpr Finish terracotta{"terracotta", 0xC4714F, 0.75, 0};
inline constexpr Finish mustard{"mustard", 0xD8A850, 0.8, 0};
inline constexpr Finish rose{"dusty rose", 0xCB938B, 0.8, 0};
inline constexpr Finish linen{"linen", 0xDCD1BD, 0.9, 0};
inline constexpr Finish charcoal{"charcoal", 0x43464B, 0.6, 0};
inline constexpr Finish brass{"brass", 0xCBA765, 0.35, 0.6};
inline constexpr Finish steel{"steel", 0xA3AAAF, 0.35, 0.6};
}  // namespace finish

}  // namespace parsel::gallery
