#pragma once

#include <span>

#include "engine/calibration/marginal_resection.h"

namespace helical {

/// The pose that sees the markers of `world_from_body` mirrored about the line of sight to their centre: flat
/// markers seen from afar project almost alike from both (Schweighofer and Pinz 2006).
RigidTransform mirroredPose(const RigidTransform& camera_from_world, const RigidTransform& world_from_body,
                            const MarkerLayout& markers);

/// The best of several solutions for the same frames: from `current`, from its mirror image (in the newest
/// frame), from `guess` and, while none of these fits, from a flat layout's poses in one frame. `other_mode`
/// says that `current` is in another mode, or far from any solution. Allocates nothing.
struct ModeChoice {
  MarginalResection best;
  bool other_mode = false;
};
ModeChoice chooseMode(const CameraModel& camera, const MarkerLayout& markers,
                      std::span<const StoredFrame* const> frames, const RigidTransform& current,
                      const RigidTransform& guess);

/// When to look for other modes: at 8, 12, 17, ... frames, growing by half, so that it costs nothing in the
/// long run.
class ModeSchedule {
 public:
  bool due();  ///< counts one frame
  int seen() const { return seen_; }

 private:
  int seen_ = 0;
  int next_ = 8;
};

/// Frames that modes are compared on.
inline constexpr std::size_t kModeFrames = 24;

}  // namespace helical
