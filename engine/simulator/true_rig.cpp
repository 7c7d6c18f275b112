#include "engine/simulator/true_rig.h"

#include <array>

#include "engine/simulator/random_streams.h"

namespace helical {

MarkerLayout trueMarkers(const MarkerLayout& told, const SimulationOptions& options) {
  const MarkerLayout& before = options.markers_before ? *options.markers_before : told;
  if (!(options.marker_error_m > 0.0)) return before;
  Random random = randomStream(options.seed, RandomStream::kMarkers);
  std::array<Eigen::Vector3d, kMaxMarkers> balls;
  for (int m = 0; m < before.count(); ++m) {
    Eigen::Vector3d& ball = balls[static_cast<std::size_t>(m)];
    ball = before.inBody(markerId(m));
    for (double& each : ball) each += options.marker_error_m * random.normal();
  }
  return {{balls.data(), static_cast<std::size_t>(before.count())}, before.radius()};
}

CameraModel trueModel(CameraId camera, const CameraModel& told, const SimulationOptions& options) {
  const auto index = static_cast<std::size_t>(camera.index());
  const bool replaced = index < options.models_before.size() && options.models_before[index].has_value();
  const CameraModel& before = replaced ? *options.models_before[index] : told;
  if (!(options.focal_error > 0.0)) return before;
  Random random = randomStream(options.seed, RandomStream::kFocalLengths, camera);
  return before.withFocalScale(1.0 + options.focal_error * random.normal());
}

}  // namespace helical
