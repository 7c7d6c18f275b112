#pragma once

#include "engine/geometry/camera_model.h"
#include "engine/markers/observation.h"

namespace helical {

/// The outline of a ball beside the optical axis is an ellipse whose centre lies farther out than the image of
/// the ball's centre, by radius^2 tan(angle) / f: 0.025 px at a radius of 5 px, 30 degrees and f = 568 px. Moves
/// the centroids to where the balls' centres are seen. Done here rather than in what a tracker predicts: the
/// radius that the image shows is enough for it, no pose has to be known, and trackers, calibrators and
/// labelling alike get pixels of the points that they know.
void moveToBallCentres(const CameraModel& camera, Observation& observation);

}  // namespace helical
