#pragma once

#include <span>

#include "engine/calibration/rig_moment.h"

namespace helical {

/// By how much offsets of the centroids that stay from moment to moment widen the covariance of what is solved for
/// over the moments, beyond what their own noise does: `sigma_px` per axis, correlated over `time_s`. `moments` in
/// the order of time; 1 for fewer than two.
double lastingInflation(std::span<const RigMoment> moments, double sigma_px, double time_s);

}  // namespace helical
