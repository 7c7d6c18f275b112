#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace helical {

/// A line through zero that byte arithmetic evaluates: about x * eighths / 8 - less, never below 0. `of` is
/// what the vector code computes, rounding and all.
struct ByteLine {
  std::uint8_t eighths = 8;
  std::uint8_t less = 0;

  constexpr int of(int x) const {
    int y = eighths == 8 ? x : 0;
    for (int bit = 0; bit < 3; ++bit) y = (y + ((eighths >> bit & 1) != 0 || eighths == 8 ? x : 0) + 1) / 2;
    return y > less ? y - less : 0;
  }
};

/// What is cheap to say about a set of colours. With `special` and the two other channels a and b, brightest
/// value v, darkest value m: every colour of the set meets the outer bounds; every colour that meets the
/// inner bounds (if there are any) is of the set.
struct ColourBounds {
  enum class Shape : std::uint8_t {
    kDominant,   ///< `special` is the brightest: max(a, b) <= special - lead
    kRecessive,  ///< `special` is the darkest: min(a, b) >= special + lead
    kAny
  };
  Shape shape = Shape::kAny;
  std::uint8_t special = 1;
  std::uint8_t lead = 0;
  std::uint8_t chroma = 0;  ///< v - m >= chroma
  std::uint8_t value_low = 0;
  ByteLine darkest_at_most;  ///< m <= line(v)
  ByteLine darkest_at_least{0, 0};

  // Shape kDominant only, with c = special - m.
  bool has_inner = false;
  std::uint8_t inner_value_low = 0;
  std::uint8_t inner_value_high = 255;
  ByteLine inner_darkest_at_most;  ///< m <= line(special)
  ByteLine inner_a_over_b;         ///< a - b <= line(c)
  ByteLine inner_b_over_a;
};

/// Channels a and b of `special`, in cyclic order.
constexpr int otherA(int special) {
  return (special + 1) % 3;
}
constexpr int otherB(int special) {
  return (special + 2) % 3;
}

/// Colours between two values of each channel, in memory's order.
struct ColourBox {
  std::array<std::uint8_t, 3> low{255, 255, 255};
  std::array<std::uint8_t, 3> high{0, 0, 0};
};

/// This box grown alike to all sides as far as all of it surely meets the inner bounds; none if it itself
/// does not.
std::optional<ColourBox> grownInside(const ColourBounds& bounds, const ColourBox& box);

class ColourClass;
struct ColourRange;

/// The tightest outer bounds that fit the table, and inner bounds checked against it.
ColourBounds deriveBounds(const ColourClass& colours, const ColourRange& options);

}  // namespace helical
