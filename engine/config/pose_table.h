#pragma once

#include <optional>

#include "engine/config/toml_table.h"
#include "engine/geometry/camera_estimate.h"

namespace helical {

/// `rotation_wxyz` and `translation_m`. Finishes the table; its other keys have been read.
RigidTransform readPose(TomlTable& table);

/// `covariance`: of CameraEstimate's perturbation, nothing if the table has none. Throws Error(kInput) for what is
/// no covariance.
std::optional<Matrix6d> readCovariance(TomlTable& table);

}  // namespace helical
