#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/geometry/camera_model.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// A camera that may be flown on.
struct CoveringCamera {
  const CameraModel* model = nullptr;
  RigidTransform camera_from_world;
};

/// The border of the space that at least two cameras see, as contour lines at these heights [m]: pairs of
/// points. Nothing where the border is more than `reach` from the pad.
std::vector<Eigen::Vector3d> coverageContours(const std::vector<CoveringCamera>& cameras,
                                              const std::vector<double>& heights, double reach);

}  // namespace helical
