#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// The two poses a camera can have towards coplanar points: a planar target seen from afar and its mirror
/// image about the line of sight project almost alike (Schweighofer and Pinz 2006).
struct PlanarPose {
  RigidTransform camera_from_body;
  double rms_px = 0.0;  ///< reprojection, per axis
};

struct PlanarPoses {
  std::array<PlanarPose, 2> poses;  ///< the better one first
  int count = 0;                    ///< 0 when the points are degenerate
};

/// Pose from 4 or more coplanar points in a common plane z = const of the body, by a homography (direct
/// linear transform, normalised) and its mirror image, each refined by Levenberg-Marquardt on pixels.
/// `points_in_body` and `pixels` have the same length. Allocates nothing for up to kMaxMarkers points.
PlanarPoses solvePlanarPnp(const CameraModel& camera, std::span<const Eigen::Vector3d> points_in_body,
                           std::span<const Eigen::Vector2d> pixels);

}  // namespace helical
