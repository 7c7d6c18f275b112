#include "engine/flight/fence.h"

#include <algorithm>
#include <cmath>

namespace helical {

double beyondFence(const SupervisorOptions& options, const Eigen::Vector3d& place) {
  const double above = place.z() - options.fence_height;
  if (options.fence == FenceShape::kCylinder)
    return std::max(place.head<2>().norm() - options.fence_radius, above);
  return std::max(
      {std::abs(place.x()) - options.fence_half_x, std::abs(place.y()) - options.fence_half_y, above});
}

Eigen::Vector3d pushedBack(const SupervisorOptions& options, const Eigen::Vector3d& place) {
  const double margin = options.fence_warning_margin;
  Eigen::Vector3d inside = place;
  inside.z() = std::min(place.z(), options.fence_height - margin);
  if (options.fence == FenceShape::kCylinder) {
    const double reach = options.fence_radius - margin;
    inside.head<2>() *= std::min(1.0, reach / std::max(place.head<2>().norm(), 1e-9));
    return inside;
  }
  const Eigen::Vector2d reach(options.fence_half_x - margin, options.fence_half_y - margin);
  inside.head<2>() = place.head<2>().cwiseMax(-reach).cwiseMin(reach);
  return inside;
}

}  // namespace helical
