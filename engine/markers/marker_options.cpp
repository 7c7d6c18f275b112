#include "engine/markers/marker_options.h"

#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

void checkRange(const char* key, int value, int low, int high) {
  if (value >= low && value <= high) return;
  throw Error(ErrorKind::kInput, std::string(key) + " is " + std::to_string(value), {},
              "give " + std::to_string(low) + " to " + std::to_string(high));
}

void checkOrder(const char* low_key, int low, const char* high_key, int high) {
  if (low <= high) return;
  throw Error(ErrorKind::kInput, std::string(low_key) + " is larger than " + high_key, {},
              "exchange the two");
}

void checkOdd(const char* key, int value) {
  checkRange(key, value, 1, 15);
  if (value % 2 == 1) return;
  throw Error(ErrorKind::kInput, std::string(key) + " is even", {},
              "give an odd number of pixels; 1 switches it off");
}

}  // namespace

void validate(const ColourRange& c) {
  checkRange("hue_low", c.hue_low, 0, 179);
  checkRange("hue_high", c.hue_high, 0, 179);
  checkRange("saturation_low", c.saturation_low, 0, 255);
  checkRange("saturation_high", c.saturation_high, 0, 255);
  checkOrder("saturation_low", c.saturation_low, "saturation_high", c.saturation_high);
  checkRange("value_low", c.value_low, 0, 255);
  checkRange("value_high", c.value_high, 0, 255);
  checkOrder("value_low", c.value_low, "value_high", c.value_high);
}

void validate(const MarkerOptions& o) {
  validate(static_cast<const ColourRange&>(o));
  for (const ColourRange& colour : o.other_colours) validate(colour);
  checkRange("background_threshold", o.background_threshold, 0, 255);
  checkRange("background_frames", o.background_frames, 1, 10000);
  checkRange("background_rows", o.background_rows, 0, 10000);
  checkRange("whole_every", o.whole_every, 1, 10000);
  checkOdd("opening_px", o.opening_px);
  checkOdd("closing_px", o.closing_px);
  checkRange("minimum_area_px", o.minimum_area_px, 1, 1'000'000'000);
  checkRange("maximum_area_px", o.maximum_area_px, 1, 1'000'000'000);
  checkOrder("minimum_area_px", o.minimum_area_px, "maximum_area_px", o.maximum_area_px);
  if (!(o.centroid_sigma_px > 0.0 && o.centroid_sigma_px <= 100.0))
    throw Error(ErrorKind::kInput, "centroid_sigma_px is " + std::to_string(o.centroid_sigma_px), {},
                "give a standard deviation above 0 and up to 100 pixels");
}

}  // namespace helical
