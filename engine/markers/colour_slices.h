#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace helical {

/// A set of colours that is a box in hue, saturation and value, exactly, in a few lines of memory where a bit
/// a colour takes 2 MB: how far the brightest and the darkest channel may be apart, by the brightest value,
/// and by how much one of the two other channels may lead the other, by that distance. Immutable once
/// derived.
class ColourSlices {
 public:
  /// From one bit a colour, as in ColourClass. False: this set is not of that kind.
  bool derive(const std::vector<std::uint64_t>& table);

  /// Three bytes in the table's order.
  bool contains(const std::uint8_t* c) const {
    const int high = std::max({c[0], c[1], c[2]}), apart = high - std::min({c[0], c[1], c[2]});
    const Span distance = distances_[static_cast<std::size_t>(high)];
    if (apart < distance.low || apart > distance.high) return false;
    const std::size_t top = brightestOf(c, high);
    const int lead = c[(top + 1) % 3] - c[(top + 2) % 3];
    const Span leads = leads_[top][static_cast<std::size_t>(apart)];
    return lead >= leads.low && lead <= leads.high;
  }

 private:
  struct Span {
    std::int16_t low = 256;
    std::int16_t high = -256;
    void include(int value);
  };

  static std::size_t brightestOf(const std::uint8_t* c, int high) {
    return c[1] == high ? 1 : c[0] == high ? 0 : 2;
  }
  bool isSubsetOf(const std::vector<std::uint64_t>& table) const;

  std::array<Span, 256> distances_{};
  std::array<std::array<Span, 256>, 3> leads_{};  ///< by the brightest channel
};

}  // namespace helical
