#pragma once

#include <array>
#include <bitset>

#include "engine/base/ids.h"
#include "engine/base/time.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// The balls as several cameras see them at one and the same time, with names: what a camera saw before and after
/// is moved to that time by interpolation in its image, which for a hand-held or flying helicopter errs by less
/// than a hundredth of a pixel. So cameras that are not synchronised see one helicopter pose.
struct RigMoment {
  struct View {
    std::bitset<kMaxMarkers> seen;
    std::array<Eigen::Vector2f, kMaxMarkers> pixels;  ///< of those
    float variance = 0.25F;                           ///< of a centroid, per axis [px^2]
  };

  TimeNs time = 0;
  RigidTransform world_from_body;  ///< as well as it is known
  bool pose_is_given = false;      ///< it defines the world: standing on the pad
  std::array<View, kMaxCameras> views;
};

}  // namespace helical
