#pragma once

#include <array>
#include <cstdint>

namespace helical {

/// How the radio finds the helicopter; as its owner has set it there.
struct RadioOptions {
  int channel = 80;                                               ///< 2400 MHz and so many
  int rate_kbps = 2000;                                           ///< 250, 1000, 2000
  std::array<std::uint8_t, 5> address{0xE7, 0xE7, 0xE7, 0xE7, 0xE7};
  int power = 3;                                                  ///< 0 .. 3, of -18, -12, -6 and 0 dBm
};

/// Throws Error(kInput) naming the offending key.
void validate(const RadioOptions& options);

}  // namespace helical
