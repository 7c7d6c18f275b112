#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/base/ids.h"

namespace helical {

/// One labelling that a camera's calibration has weighed up.
struct TriedLabelling {
  std::array<std::uint8_t, kMaxMarkers> marker{};  ///< of the balls from left to right in the image
  int count = 0;                                   ///< balls
  float value = 0.0F;  ///< De, the distance of its pose from the first guess [m]; see TriedLabellings
};

/// The best labellings that a camera's calibration has weighed up, for display: the one it took, or would take now,
/// first, the others by their value.
struct TriedLabellings {
  static constexpr int kMost = 6;

  std::array<TriedLabelling, kMost> all{};
  int count = 0;
  /// By a method that is not chosen by De: its `value` is the misfit to the frames [standard deviations].
  bool by_misfit = false;

  /// Keeps the best ones from the second place on in order. Allocates nothing.
  void add(const TriedLabelling& labelling);
};

/// By the place of their balls in the image: `markers[i]` is the ball at `pixels[i]`. No more than kMaxMarkers.
TriedLabelling fromLeftToRight(std::span<const std::uint8_t> markers, std::span<const Eigen::Vector2d> pixels,
                               double value);

/// Long enough for writeNames.
using LabellingNames = std::array<char, static_cast<std::size_t>(TriedLabellings::kMost) * kMaxMarkers * 3>;

/// As sessions have them and people read them: "2-0-1-3 0-2-1-3". The text lies in `buffer`.
std::string_view writeNames(const TriedLabellings& labellings, LabellingNames& buffer);
/// Back again, without values; what is too long or no number is left out.
TriedLabellings readNames(std::string_view text);

}  // namespace helical
