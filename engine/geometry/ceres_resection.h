#pragma once

#include <span>

#include "engine/geometry/camera_resection.h"

namespace helical {

/// What a solver hands over: a pose, and whether its steps came to rest there.
struct ResectionSolution {
  RigidTransform camera_from_world;
  int iterations = 0;
  ResectionStatus status = ResectionStatus::kDiverged;
};

/// Squared residual [px^2] that stands for a point which the camera model cannot project: far beyond any real
/// one, and flat, so that it pulls nowhere.
inline constexpr double kUnseenResidual2 = 1e6;

/// `resectCamera` by Ceres. Allocates.
ResectionSolution solveByCeres(const CameraModel& camera, std::span<const WorldPoint> points,
                               const RigidTransform& initial, const ResectionOptions& options);

}  // namespace helical
