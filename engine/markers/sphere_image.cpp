#include "engine/markers/sphere_image.h"

#include <cmath>

namespace helical {

void moveToBallCentres(const CameraModel& camera, Observation& observation) {
  for (int i = 0; i < observation.count; ++i) {
    Centroid& centroid = observation.centroids[static_cast<std::size_t>(i)];
    const Eigen::Vector2d outline = camera.bearing(centroid.pixel);
    // With R the ball's radius and z its depth, the outline's half axes are R/z and R/z sqrt(1 + bearing^2), its
    // centre is bearing / (1 - (R/z)^2). The radius that was found is that of the disc of its area.
    const double ratio = centroid.radius_px / camera.fx();
    const double shrink = 1.0 - ratio * ratio / std::sqrt(1.0 + outline.squaredNorm());
    const Eigen::Vector2d centre = shrink * outline;
    if (const auto pixel = camera.project({centre.x(), centre.y(), 1.0})) centroid.pixel = *pixel;
  }
}

}  // namespace helical
