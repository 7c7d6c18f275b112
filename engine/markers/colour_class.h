#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/markers/colour_bounds.h"
#include "engine/markers/colour_slices.h"
#include "engine/markers/marker_options.h"

namespace helical {

/// Which of the 2^24 colours are a marker's, as a bit table built with OpenCV's own conversion, hence exact;
/// and bounds derived from the table that throw out or accept most pixels without looking them up. Immutable;
/// extractors with the same range share one (2 MB). Any thread.
class ColourClass {
 public:
  enum class Order : std::uint8_t { kBgr, kRgb };  ///< of the bytes in memory

  static std::shared_ptr<const ColourClass> of(const ColourRange& options, Order order);

  ColourClass(const ColourRange& options, Order order);

  /// `colour` points to three bytes in this class's order.
  bool contains(const std::uint8_t* colour) const {
    // The table lies in memory's far corners, a page a colour.
    if (has_slices_) return slices_.contains(colour);
    return contains(colour[0] | static_cast<std::uint32_t>(colour[1]) << 8 |
                    static_cast<std::uint32_t>(colour[2]) << 16);
  }
  bool contains(std::uint32_t index) const { return (table_[index >> 6] >> (index & 63U) & 1U) != 0; }

  /// 2^18 words, one bit a colour; bit number = first byte + 256 second + 65536 third.
  const std::vector<std::uint64_t>& table() const { return table_; }
  Order order() const { return order_; }
  const ColourBounds& bounds() const { return bounds_; }

 private:
  Order order_;
  std::vector<std::uint64_t> table_;
  ColourBounds bounds_;
  bool has_slices_ = false;
  ColourSlices slices_;  ///< the same as the table
};

}  // namespace helical
