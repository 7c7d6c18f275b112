#pragma once

#include <array>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/observation.h"

namespace helical {

inline constexpr double kStandingHeight = 0.06;
inline constexpr double kCentroidSigma = 0.1;

/// Cameras around the pad, all calibrated, and what they see of a helicopter.
struct Field {
  MarkerLayout markers = MarkerLayout::paper();
  std::vector<CameraModel> models;
  std::vector<CameraEstimate> estimates;
  std::array<bool, kMaxCameras> usable{};

  /// Three cameras look at a point 0.3 m above the pad from 2.7 m.
  Field();

  /// The balls of a helicopter in `world_from_body`, in the layout's order, with white noise of `sigma`
  /// pixels per axis. A ball outside the image is left out.
  Observation observe(int camera, TimeNs exposure, const RigidTransform& world_from_body, double sigma,
                      Random& random) const;

  std::span<const bool> usableCameras() const { return {usable.data(), models.size()}; }
};

/// Standing somewhere on the pad with a yaw in +-`yaw_range`.
RigidTransform onPad(Random& random, double yaw_range);

/// How far apart two poses are: metres and radians.
double distanceBetween(const RigidTransform& a, const RigidTransform& b);
double angleBetween(const RigidTransform& a, const RigidTransform& b);

/// One more region in the image.
void addCentroid(Observation& observation, const Eigen::Vector2d& pixel, double area_px);

}  // namespace helical
