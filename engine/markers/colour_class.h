#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/markers/marker_options.h"

namespace helical {

/// Which of the 2^24 colours are a marker's, as a bit table built with OpenCV's own conversion, hence exact;
/// and a cheap necessary condition derived from the table: 16 pixels at a time are thrown out without looking
/// them up. Immutable; extractors with the same range share one (2 MB). Any thread.
class ColourClass {
 public:
  static std::shared_ptr<const ColourClass> of(const MarkerOptions& options);

  explicit ColourClass(const MarkerOptions& options);

  /// `bgr` points to one pixel.
  bool contains(const std::uint8_t* bgr) const {
    const std::uint32_t colour =
        bgr[0] | static_cast<std::uint32_t>(bgr[1]) << 8 | static_cast<std::uint32_t>(bgr[2]) << 16;
    return (table_[colour >> 6] >> (colour & 63U) & 1U) != 0;
  }

  /// False only if none of the 64 pixels from `bgr` on is of the class.
  bool mayContain64(const std::uint8_t* bgr) const;

 private:
  void deriveBounds();

  std::vector<std::uint64_t> table_;
  // Necessary: max(others) <= dominant - lead and min(others) <= dominant - chroma, saturating at 0.
  int dominant_ = 1;
  int other_a_ = 0;
  int other_b_ = 2;
  std::uint8_t lead_ = 0;
  std::uint8_t chroma_ = 0;
  bool has_dominant_ = false;
};

}  // namespace helical
