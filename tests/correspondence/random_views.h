#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/base/random.h"
#include "engine/correspondence/labelling_search.h"

namespace helical {

/// A random layout in a plane of the body, seen from above by a camera 2.3 to 3.2 m away while the helicopter
/// hovers somewhere; centroids in random order.
struct RandomView {
  MarkerLayout layout;
  std::vector<Eigen::Vector2d> in_plane;
  RigidTransform camera_from_world;
  RigidTransform world_from_body;
  std::vector<Eigen::Vector2d> pixels;
  Labelling truth;
};

CameraModel viewCamera();

RandomView randomView(Random& random, int markers, double sigma_px);

/// What the same camera sees, in the same order, of another pose.
LabellingFrame frameOf(const RandomView& view, const RigidTransform& world_from_body, double sigma_px,
                       Random& random);

RigidTransform randomHover(Random& random);

/// The camera turned and shifted by this much, in random directions.
RigidTransform guessOf(const RandomView& view, double angle, double distance, Random& random);

}  // namespace helical
