#include "engine/markers/colour_slices.h"

#include <bit>

namespace helical {

void ColourSlices::Span::include(int value) {
  low = static_cast<std::int16_t>(std::min<int>(low, value));
  high = static_cast<std::int16_t>(std::max<int>(high, value));
}

bool ColourSlices::derive(const std::vector<std::uint64_t>& table) {
  distances_ = {};
  leads_ = {};
  for (std::uint32_t word = 0; word < table.size(); ++word)
    for (std::uint64_t rest = table[word]; rest != 0; rest &= rest - 1) {
      const std::uint32_t colour = word * 64 + static_cast<std::uint32_t>(std::countr_zero(rest));
      const std::array<std::uint8_t, 3> c{static_cast<std::uint8_t>(colour),
                                          static_cast<std::uint8_t>(colour >> 8),
                                          static_cast<std::uint8_t>(colour >> 16)};
      const int high = std::max({c[0], c[1], c[2]}), apart = high - std::min({c[0], c[1], c[2]});
      const std::size_t top = brightestOf(c.data(), high);
      distances_[static_cast<std::size_t>(high)].include(apart);
      leads_[top][static_cast<std::size_t>(apart)].include(c[(top + 1) % 3] - c[(top + 2) % 3]);
    }
  return isSubsetOf(table);  // and holds all of it by construction
}

bool ColourSlices::isSubsetOf(const std::vector<std::uint64_t>& table) const {
  for (int high = 0; high < 256; ++high) {
    const Span distance = distances_[static_cast<std::size_t>(high)];
    for (int apart = distance.low; apart <= distance.high; ++apart)
      for (std::size_t top = 0; top < 3; ++top) {
        const Span leads = leads_[top][static_cast<std::size_t>(apart)];
        for (int lead = leads.low; lead <= leads.high; ++lead) {
          std::array<std::uint32_t, 3> c;
          const auto low = static_cast<std::uint32_t>(high - apart);
          c[top] = static_cast<std::uint32_t>(high);
          c[(top + 1) % 3] = low + static_cast<std::uint32_t>(std::max(0, lead));
          c[(top + 2) % 3] = low + static_cast<std::uint32_t>(std::max(0, -lead));
          const std::uint32_t colour = c[0] | c[1] << 8 | c[2] << 16;
          const std::array<std::uint8_t, 3> bytes{static_cast<std::uint8_t>(c[0]),
                                                  static_cast<std::uint8_t>(c[1]),
                                                  static_cast<std::uint8_t>(c[2])};
          // Where two channels are the brightest, the colour is the other one's.
          if (brightestOf(bytes.data(), high) == top && (table[colour >> 6] >> (colour & 63U) & 1U) == 0)
            return false;
        }
      }
  }
  return true;
}

}  // namespace helical
