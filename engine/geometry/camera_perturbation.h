#pragma once

#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/rotation.h"

namespace helical {

/// The camera moved by `perturbation` as `CameraEstimate` counts it: rotation on the left of
/// `camera_from_world` [rad], then the shift of the camera's centre in the world [m].
inline RigidTransform perturbCamera(const RigidTransform& camera_from_world, const Vector6d& perturbation) {
  RigidTransform moved;
  moved.rotation = (expSO3(perturbation.head<3>()) * camera_from_world.rotation).normalized();
  moved.translation = -(moved.rotation * (camera_from_world.inverseTranslation() + perturbation.tail<3>()));
  return moved;
}

/// The perturbation that moves `from` to `to`: perturbCamera(from, cameraPerturbation(from, to)) == to.
inline Vector6d cameraPerturbation(const RigidTransform& from, const RigidTransform& to) {
  Vector6d perturbation;
  perturbation.head<3>() = logSO3(to.rotation * from.rotation.conjugate());
  perturbation.tail<3>() = to.inverseTranslation() - from.inverseTranslation();
  return perturbation;
}

}  // namespace helical
