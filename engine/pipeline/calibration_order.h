#pragma once

#include <array>
#include <cstdint>

#include "engine/base/ids.h"
#include "engine/geometry/camera_estimate.h"

namespace helical {

/// What an operator may decide about a camera's calibration, beside starting it anew.
enum class CalibrationOrderKind : std::uint8_t {
  kFreeze,    ///< learns no more and stays where it is; when it is knocked it leaves the control set all the same
  kResume,    ///< learns on
  kAccept,    ///< comes into the control set with what it knows now, whatever the rule of admission says
  kTrustRig,  ///< stands where the rig file says
  kAdopt,     ///< stands where the order says, from a calibration that was saved
  kRefine,    ///< all cameras, whichever is named, are solved for together: see RigRefinement
};

inline constexpr std::array<CalibrationOrderKind, 6> kCalibrationOrderKinds{
    CalibrationOrderKind::kFreeze, CalibrationOrderKind::kResume, CalibrationOrderKind::kAccept,
    CalibrationOrderKind::kTrustRig, CalibrationOrderKind::kAdopt, CalibrationOrderKind::kRefine};

/// A plain value on its way to the flight thread.
struct CalibrationOrder {
  CalibrationOrderKind kind = CalibrationOrderKind::kFreeze;
  CameraId camera;
  RigidTransform camera_from_world;         ///< of kAdopt
  Matrix6d covariance = Matrix6d::Zero();  ///< of kAdopt; order of CameraEstimate
  double focal_scale = 1.0;                 ///< of kAdopt, over the rig's: with which that place holds
  double balls_off_m = 0.0;  ///< of kAdopt: that ball by which the place holds which is farthest from where
                             ///< it is flown with; balls are not taken over
};

/// In one word, as sessions have it.
const char* toString(CalibrationOrderKind kind);

}  // namespace helical
