#pragma once

#include "engine/base/time.h"

namespace helical::gige {

/// A camera's own clock beside this machine's: it starts at 0 with the camera, is off by a constant, and runs fast by
/// `drift`. Nanoseconds on both sides.
struct DeviceClock {
  TimeNs started = 0;  ///< on this machine's clock
  TimeNs offset = 0;
  double drift = 0.0;  ///< relative

  TimeNs device(TimeNs host) const {
    const TimeNs age = host - started;
    return age + static_cast<TimeNs>(drift * static_cast<double>(age)) + offset;
  }
  TimeNs host(TimeNs device_time) const {
    const double age = static_cast<double>(device_time - offset);
    return started + (device_time - offset) - static_cast<TimeNs>(age * drift / (1.0 + drift));
  }
};

}  // namespace helical::gige
