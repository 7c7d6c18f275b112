#pragma once

#include <memory>
#include <vector>

#include "engine/markers/colour_class.h"

namespace helical {

/// Colours to look for and the tables that extractors need of them. Building those takes a tenth of a second:
/// who orders other colours does it, so that the thread that reads a camera need not.
struct MarkerColours {
  MarkerColours() = default;
  /// Throws Error(kInput) for a range that is none.
  explicit MarkerColours(std::vector<ColourRange> colours);

  std::vector<ColourRange> ranges;  ///< the base's first
  std::vector<std::shared_ptr<const ColourClass>> bgr;
  std::vector<std::shared_ptr<const ColourClass>> rgb;
};

}  // namespace helical
