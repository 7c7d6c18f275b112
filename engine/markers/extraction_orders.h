#pragma once

#include <cstdint>
#include <optional>

#include "engine/base/latest_value.h"
#include "engine/markers/marker_options.h"

namespace helical {

/// What an operator changes of an extractor at work. Orders are counted, so that one is obeyed once.
struct ExtractionOrders {
  std::optional<ColourRange> colour;  ///< of the markers; the options' own without
  std::uint32_t backgrounds = 0;      ///< how often a new background was asked for
};

/// Written by the operator's thread, read by the camera's capture thread.
using ExtractionChannel = LatestValue<ExtractionOrders>;

}  // namespace helical
