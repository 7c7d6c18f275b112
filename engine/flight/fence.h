#pragma once

#include <Eigen/Core>

#include "engine/flight/supervisor_options.h"

namespace helical {

/// How far a place is outside the fence [m]; negative inside. `place`: x and y from the pad's centre in the
/// world's axes, z above the pad. The ground is no fence.
double beyondFence(const SupervisorOptions& options, const Eigen::Vector3d& place);

/// The nearest place that is inside by the warning margin.
Eigen::Vector3d pushedBack(const SupervisorOptions& options, const Eigen::Vector3d& place);

}  // namespace helical
