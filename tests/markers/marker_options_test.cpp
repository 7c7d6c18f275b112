#include "engine/markers/marker_options.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace helical {
namespace {

TEST(MarkerOptions, DefaultsAreValid) {
  EXPECT_NO_THROW(validate(MarkerOptions{}));
}

TEST(MarkerOptions, NamesTheKeyThatIsWrong) {
  using Break = std::function<void(MarkerOptions&)>;
  const std::vector<std::pair<std::string, Break>> cases{
      {"hue_low", [](MarkerOptions& o) { o.hue_low = 180; }},
      {"hue_high", [](MarkerOptions& o) { o.hue_high = -1; }},
      {"saturation_low", [](MarkerOptions& o) { o.saturation_low = 200, o.saturation_high = 100; }},
      {"value_high", [](MarkerOptions& o) { o.value_high = 256; }},
      {"background_threshold", [](MarkerOptions& o) { o.background_threshold = 256; }},
      {"background_frames", [](MarkerOptions& o) { o.background_frames = 0; }},
      {"background_rows", [](MarkerOptions& o) { o.background_rows = -1; }},
      {"whole_every", [](MarkerOptions& o) { o.whole_every = 0; }},
      {"opening_px", [](MarkerOptions& o) { o.opening_px = 4; }},
      {"closing_px", [](MarkerOptions& o) { o.closing_px = 17; }},
      {"minimum_area_px", [](MarkerOptions& o) { o.minimum_area_px = 30000; }},
      {"maximum_area_px", [](MarkerOptions& o) { o.maximum_area_px = 0; }},
      {"centroid_sigma_px", [](MarkerOptions& o) { o.centroid_sigma_px = 0.0; }},
  };
  for (const auto& [key, breakOption] : cases) {
    MarkerOptions options;
    breakOption(options);
    try {
      validate(options);
      ADD_FAILURE() << key << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(error.problem().find(key), std::string::npos) << error.problem();
      EXPECT_FALSE(error.cure().empty());
    }
  }
}

TEST(MarkerOptions, HueMayWrapThroughRed) {
  MarkerOptions options;
  options.hue_low = 170;
  options.hue_high = 10;
  EXPECT_NO_THROW(validate(options));
}

}  // namespace
}  // namespace helical
