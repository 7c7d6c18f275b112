#pragma once

#include <span>
#include <vector>

#include "engine/calibration/rig/rig_camera.h"
#include "engine/calibration/rig/sightings.h"
#include "engine/calibration/self_calibration_options.h"

namespace helical {

/// A body's points and the cameras' focal lengths as unknowns, with what was given as their prior. The prior
/// holds what no image tells: the body's own frame, and its size where no two given cameras set the scale.
struct FreeBody {
  SelfCalibrationOptions sigmas;
  double sigma_px = 1.0;                       ///< of a pixel, per axis: what the prior is weighed against
  std::vector<Eigen::Vector3d> given, points;  ///< in the body, as given and as found
  std::vector<int> point;                      ///< of each sighting: index into those
  std::vector<RigCamera> given_cameras;
  std::vector<double> focal_scales;  ///< of each camera, over the given focal lengths
};

/// Of a recording with body coordinates. Throws Error(kInput) where they are too many for one body.
FreeBody freeBody(const SightingTable& table, std::span<const RigCamera> cameras,
                  const SelfCalibrationOptions& sigmas, const std::string& file);

/// Puts what was found in the place of what was given.
void takeOver(const FreeBody& body, SightingTable& table, std::span<RigCamera> cameras);

}  // namespace helical
