#include "engine/helicopter/marker_layout.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "engine/base/error.h"

namespace helical {

MarkerLayout::MarkerLayout(std::span<const Eigen::Vector3d> markers_in_body, double radius) {
  if (markers_in_body.size() < 3 || markers_in_body.size() > kMaxMarkers)
    throw Error(ErrorKind::kInput, "a helicopter has " + std::to_string(markers_in_body.size()) + " markers",
                {}, "give 3 to " + std::to_string(kMaxMarkers) + " marker positions");
  if (!(radius > 0.0))
    throw Error(ErrorKind::kInput, "the marker radius is not positive", {}, "give it in metres");
  const Eigen::Vector3d& first = markers_in_body.front();
  double widest = 0.0;
  for (const auto& a : markers_in_body)
    for (const auto& b : markers_in_body) widest = std::max(widest, (a - first).cross(b - first).norm());
  if (widest < 1e-4)
    throw Error(ErrorKind::kInput, "the markers lie on one line", {},
                "spread them over a plane of some centimetres");
  std::copy(markers_in_body.begin(), markers_in_body.end(), markers_.begin());
  count_ = static_cast<int>(markers_in_body.size());
  radius_ = radius;
}

MarkerLayout MarkerLayout::paper() {
  const std::array<Eigen::Vector3d, 4> markers{
      {{0.15, 0.12, -0.05}, {-0.13, 0.15, -0.05}, {-0.16, -0.11, -0.05}, {0.11, -0.16, -0.05}}};
  return MarkerLayout(markers, 0.018);
}

}  // namespace helical
