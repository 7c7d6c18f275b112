#pragma once

#include <cstdint>

namespace helical::gige {

/// Pixel formats as GigE Vision numbers them: those that the virtual camera offers.
inline constexpr std::uint32_t kMono8 = 0x01080001;
inline constexpr std::uint32_t kBayerGr8 = 0x01080008;
inline constexpr std::uint32_t kBayerRg8 = 0x01080009;
inline constexpr std::uint32_t kBayerGb8 = 0x0108000a;
inline constexpr std::uint32_t kBayerBg8 = 0x0108000b;
inline constexpr std::uint32_t kRgb8 = 0x02180014;
inline constexpr std::uint32_t kBgr8 = 0x02180015;

constexpr bool isBayer(std::uint32_t format) {
  return format >= kBayerGr8 && format <= kBayerBg8;
}
constexpr bool isOffered(std::uint32_t format) {
  return format == kMono8 || isBayer(format) || format == kRgb8 || format == kBgr8;
}

}  // namespace helical::gige
