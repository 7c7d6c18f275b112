#pragma once

#include <array>
#include <span>

#include "engine/calibration/marginal_resection.h"

namespace helical {

/// The pose that sees the markers of `world_from_body` mirrored about the line of sight to their centre: flat
/// markers seen from afar project almost alike from both (Schweighofer and Pinz 2006).
RigidTransform mirroredPose(const RigidTransform& camera_from_world, const RigidTransform& world_from_body,
                            const MarkerLayout& markers);

/// Frames that modes are compared on.
inline constexpr std::size_t kModeFrames = 24;

/// Outcome of a ModeSearch. `other_mode` says that the pose in use is in another mode, or far from any
/// solution.
struct ModeChoice {
  MarginalResection best;
  bool other_mode = false;
};

/// The best of several solutions for the same frames: from the pose in use, from its mirror image (in the
/// newest frame), from a guess and, while none of these fits, from a flat layout's poses in one frame. Goes
/// on a little with every image, so that none waits for it. Allocates nothing. One thread.
class ModeSearch {
 public:
  ModeSearch(const CameraModel& camera, const MarkerLayout& markers) : camera_(camera), markers_(markers) {}
  ModeSearch(const ModeSearch&) = delete;
  ModeSearch& operator=(const ModeSearch&) = delete;

  /// See ExtrinsicCalibrator.
  void correct(const CameraModel& camera, const MarkerLayout& markers) {
    camera_ = camera;
    markers_ = markers;
  }

  /// Copies `frames`, 1 to kModeFrames of them.
  void start(std::span<const StoredFrame* const> frames, const RigidTransform& in_use,
             const RigidTransform& guess);
  void stop() { stage_ = Stage::kIdle; }
  bool running() const { return stage_ != Stage::kIdle; }

  /// Goes on until it is done or has looked at `budget` frames, from which it takes what it used. `in_use`:
  /// the pose in use by now.
  void advance(const RigidTransform& in_use, int& budget);

  /// Of a search that is done.
  const ModeChoice& choice() const { return choice_; }

 private:
  /// What is solved from.
  enum class Stage { kInUse, kMirrored, kGuess, kFirstPlanar, kSecondPlanar, kCompare, kIdle };

  RigidTransform startPose(const RigidTransform& in_use) const;
  void take(const MarginalResection& solution);
  void consider(const MarginalResection& solution);
  Stage afterGuess();

  CameraModel camera_;
  MarkerLayout markers_;
  std::array<StoredFrame, kModeFrames> frames_;
  std::array<const StoredFrame*, kModeFrames> order_{};
  std::size_t count_ = 0;
  RigidTransform first_, guess_, refined_;
  std::array<RigidTransform, 2> planar_;
  int planar_count_ = 0;
  Stage stage_ = Stage::kIdle;
  ResectionRun run_;
  ModeChoice choice_;
};

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

/// Frames that methods look at, on top of their step, for each image: bounds what modes and solving over many
/// frames cost in one. A count, not a time, so that a flight repeats.
inline constexpr int kFramesPerStep = 128;

}  // namespace helical
