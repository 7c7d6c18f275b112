#pragma once

#include <array>
#include <optional>

#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/observation.h"
#include "engine/simulator/world.h"

namespace helical {

/// How observations differ from where the markers truly were: the yardstick by which image-free observations
/// are compared with those from rendered images. One camera.
class ObservationStatistics {
 public:
  void add(const Observation& observation, const WorldSample& truth, const CameraModel& model,
           const RigidTransform& camera_from_world, const MarkerLayout& markers);

  double rms() const;           ///< px per axis, of whole balls
  double white() const;         ///< px per axis: the part that changes from frame to frame
  double slow() const;          ///< px per axis: the rest
  double dropoutShare() const;  ///< of the balls that should be seen
  double partlyHiddenShare() const;
  double falsePerFrame() const;

 private:
  std::array<std::optional<Eigen::Vector2d>, kMaxMarkers> last_error_;
  double squares_ = 0.0, step_squares_ = 0.0;
  int whole_ = 0, steps_ = 0, expected_ = 0, dropped_ = 0, hidden_ = 0, false_ = 0, frames_ = 0;
};

}  // namespace helical
