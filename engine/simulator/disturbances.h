#pragma once

#include "engine/base/random.h"
#include "engine/geometry/rigid_transform.h"
#include "engine/simulator/simulation_options.h"

namespace helical {

/// A camera turned by `angle` about a random axis and shifted by `distance` in a random direction.
RigidTransform displaced(const RigidTransform& camera_from_world, double angle, double distance,
                         Random random);

/// What happens to one simulated camera during a session: boards before it and knocks. A pure function of
/// time; any thread.
class CameraDisturbances {
 public:
  /// `random` draws the knocks' axes and directions.
  CameraDisturbances(CameraId camera, const SimulationOptions& options,
                     const RigidTransform& camera_from_world, Random random);

  /// Share of the image's width that a white board covers, from the left: it slides in and out in a quarter
  /// of a second.
  double boardCover(double time_s) const;

  /// Where the camera is; it moves at once when it is knocked.
  RigidTransform cameraFromWorld(double time_s) const;

 private:
  struct Knock {
    double at_s;
    RigidTransform camera_from_world;  ///< after it
  };
  std::vector<Occlusion> occlusions_;
  RigidTransform initial_;
  std::vector<Knock> knocks_;
};

}  // namespace helical
