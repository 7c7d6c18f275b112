#include "engine/markers/marker_colours.h"

#include <utility>

#include "engine/base/error.h"

namespace helical {

MarkerColours::MarkerColours(std::vector<ColourRange> colours) : ranges(std::move(colours)) {
  if (ranges.empty())
    throw Error(ErrorKind::kInput, "there is no colour to look for", {}, "give at least the base's");
  for (const ColourRange& range : ranges) {
    validate(range);
    bgr.push_back(ColourClass::of(range, ColourClass::Order::kBgr));
    rgb.push_back(ColourClass::of(range, ColourClass::Order::kRgb));
  }
}

}  // namespace helical
