#include "engine/simulator/gige/sensor_readout.h"

#include <algorithm>
#include <cmath>

#include "engine/simulator/gige/pixel_formats.h"

namespace helical::gige {
namespace {

constexpr int kBlue = 0, kGreen = 1, kRed = 2;

/// Colours of the four pixels that repeat: of row 0, then of row 1.
std::array<int, 4> filterOf(std::uint32_t format) {
  switch (format) {
    case kBayerGr8:
      return {kGreen, kRed, kBlue, kGreen};
    case kBayerGb8:
      return {kGreen, kBlue, kRed, kGreen};
    case kBayerBg8:
      return {kBlue, kGreen, kGreen, kRed};
    default:
      return {kRed, kGreen, kGreen, kBlue};
  }
}

}  // namespace

void SensorReadout::setBrightness(const Exposing& exposing) {
  const double light = exposing.gain * exposing.exposure_us / kUsualExposureUs;
  const std::array<double, 3> factors{light * exposing.balance[2], light * exposing.balance[1],
                                      light * exposing.balance[0]};
  if (factors == factors_) return;
  factors_ = factors;
  for (std::size_t colour = 0; colour < 3; ++colour)
    for (std::size_t level = 0; level < 256; ++level)
      curves_[colour][level] = static_cast<std::uint8_t>(
          std::min(255L, std::lround(factors[colour] * static_cast<double>(level))));
}

void SensorReadout::read(const ImageView& picture, const Exposing& exposing, std::span<std::uint8_t> pixels) {
  setBrightness(exposing);
  if (isBayer(exposing.format))
    readMosaic(picture, exposing, pixels.data());
  else
    readPixels(picture, exposing, pixels.data());
}

void SensorReadout::readMosaic(const ImageView& picture, const Exposing& exposing, std::uint8_t* to) const {
  const std::array<int, 4> filter = filterOf(exposing.format);
  for (int y = 0; y < exposing.height; ++y) {
    const std::uint8_t* from = picture.row(exposing.offset_y + y) + 3 * exposing.offset_x;
    const auto first = static_cast<std::size_t>(filter[static_cast<std::size_t>(2 * (y % 2))]);
    const auto second = static_cast<std::size_t>(filter[static_cast<std::size_t>(2 * (y % 2) + 1)]);
    for (int x = 0; x < exposing.width; x += 2, from += 6) {
      *to++ = curves_[first][from[first]];
      *to++ = curves_[second][from[3 + second]];
    }
  }
}

void SensorReadout::readPixels(const ImageView& picture, const Exposing& exposing, std::uint8_t* to) const {
  const bool mono = exposing.format == kMono8, red_first = exposing.format == kRgb8;
  for (int y = 0; y < exposing.height; ++y) {
    const std::uint8_t* from = picture.row(exposing.offset_y + y) + 3 * exposing.offset_x;
    for (int x = 0; x < exposing.width; ++x, from += 3) {
      const int blue = curves_[kBlue][from[0]], green = curves_[kGreen][from[1]], red = curves_[kRed][from[2]];
      if (mono) {
        *to++ = static_cast<std::uint8_t>((29 * blue + 150 * green + 77 * red) >> 8);
        continue;
      }
      *to++ = static_cast<std::uint8_t>(red_first ? red : blue);
      *to++ = static_cast<std::uint8_t>(green);
      *to++ = static_cast<std::uint8_t>(red_first ? blue : red);
    }
  }
}

}  // namespace helical::gige
