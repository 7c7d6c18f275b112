#pragma once

#include "engine/base/random.h"
#include "engine/correspondence/labelling_search.h"

namespace helical {

/// One view of a random layout by a random camera whose pose is known only roughly: what the experiment on
/// naming centroids draws.
struct RandomView {
  MarkerLayout layout;   ///< in a plane of the body; with four markers almost a square, as in the paper
  RigidTransform guess;  ///< camera_from_world, 15 degrees and 0.4 m off, as the paper's camera 3
  LabellingFrame frame;  ///< the helicopter stands on its pad; centroids in random order, sigma 0.5 px
  Labelling truth;
};

CameraModel randomViewCamera();

RandomView randomView(Random& random, int markers);

}  // namespace helical
