#pragma once

#include "engine/geometry/camera_estimate.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/markers/ball_prediction.h"
#include "engine/tracking/track.h"

namespace helical {

/// Where a camera should see the balls of a helicopter in this state: what its extractor reads by. Balls that
/// are only partly in the image are in it, those behind the camera are not. Any thread.
BallPredictions forecastBalls(const TrackedState& tracked, const CameraEstimate& estimate,
                              const CameraModel& camera, const MarkerLayout& markers);

}  // namespace helical
