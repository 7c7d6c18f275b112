#pragma once

namespace helical {

/// What a refinement of all cameras solves for, beside where they stand, and how far that may be off. 0: it is what
/// the rig says.
struct SelfCalibrationOptions {
  double marker_sigma_m = 0.0;  ///< of the balls' places on the helicopter, per axis
  double focal_sigma = 0.0;     ///< of focal lengths, as a share

  bool any() const { return marker_sigma_m > 0.0 || focal_sigma > 0.0; }
};

/// Throws Error(kInput) naming the offending key.
void validate(const SelfCalibrationOptions& options);

}  // namespace helical
