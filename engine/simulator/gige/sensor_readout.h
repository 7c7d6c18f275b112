#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/cameras/frame.h"
#include "engine/simulator/gige/device_state.h"

namespace helical::gige {

/// What a sensor makes of the light: region, brightness by exposure time, gain and white balance, colour filter.
/// One thread.
class SensorReadout {
 public:
  /// The lens' picture (BGR) is bright at this exposure time, without gain.
  static constexpr double kUsualExposureUs = 2000.0;

  /// Fills `pixels`, of the payload's size, with the region of `picture` that `exposing` asks for.
  void read(const ImageView& picture, const Exposing& exposing, std::span<std::uint8_t> pixels);

 private:
  using Curve = std::array<std::uint8_t, 256>;
  void setBrightness(const Exposing& exposing);
  void readMosaic(const ImageView& picture, const Exposing& exposing, std::uint8_t* to) const;
  void readPixels(const ImageView& picture, const Exposing& exposing, std::uint8_t* to) const;

  std::array<double, 3> factors_{};  ///< of blue, green, red
  std::array<Curve, 3> curves_{};
};

}  // namespace helical::gige
