#include "engine/tracking/tracker_options.h"

#include <string>

#include "engine/base/error.h"
#include "engine/base/require.h"

namespace helical {

void validate(const TrackerOptions& options) {
  requirePositive(options.acceleration_noise_lateral, "acceleration_noise_lateral");
  requirePositive(options.acceleration_noise_vertical, "acceleration_noise_vertical");
  requirePositive(options.spin_noise_tilt, "spin_noise_tilt");
  requirePositive(options.spin_noise_yaw, "spin_noise_yaw");
  requirePositive(options.spin_decay_s, "spin_decay_s");
  if (!(options.centroid_bias_px >= 0.0 && options.centroid_bias_px <= 100.0))
    throw Error(ErrorKind::kInput, "centroid_bias_px is " + std::to_string(options.centroid_bias_px), {},
                "give 0 to 100 pixels");
  requirePositive(options.gate_chi2, "gate_chi2");
  requirePositive(options.reacquire_after_s, "reacquire_after_s");
}

}  // namespace helical
