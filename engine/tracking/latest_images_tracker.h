#pragma once

#include <array>
#include <vector>

#include "engine/correspondence/label_keeper.h"
#include "engine/tracking/acquisition.h"
#include "engine/tracking/tracker.h"

namespace helical {

/// The tracker of the paper's system (section IV; Iwatani, Watanabe and Hashimoto 2008), kept to compare
/// with: features are selected in each image by where they were before, without regard to the cameras' poses;
/// the helicopter's pose is plain Gauss-Newton least squares (eq. 3) over the latest image of every usable
/// camera; velocities are its differences, low-passed. Where the paper's cameras were synchronised ours run
/// freely: each image is moved to the newest one's time by those velocities. It has neither gates in 3D nor
/// robust weights: a wrong camera pulls the pose along.
class LatestImagesTracker final : public Tracker {
 public:
  LatestImagesTracker(const MarkerLayout& markers, std::vector<CameraModel> cameras, double standing_height);

  void update(const Observation& observation, std::span<const CameraEstimate> cameras,
              std::span<const bool> usable, bool airborne) override;
  void correct(const MarkerLayout& markers, std::span<const CameraModel> cameras) override;
  void adopt(const Tracker& other) override;
  bool acquired() const override { return acquired_; }
  TimeNs lastUpdate() const override { return pose_time_; }
  /// At constant velocity, for at most 80 ms.
  TrackedState predict(TimeNs time, bool airborne) const override;
  const CameraTrack& track(CameraId camera) const override {
    return views_[static_cast<std::size_t>(camera.index())].track;
  }

 private:
  struct View {
    LabelKeeper keeper;
    Observation newest;
    Names names{};
    bool seen = false;
    CameraTrack track;
  };

  bool acquire(const Observation& observation, std::span<const CameraEstimate> cameras,
               std::span<const bool> usable);
  void select(std::size_t camera, const CameraEstimate& estimate);
  Names namesFromPose(std::size_t camera, const CameraEstimate& estimate) const;
  void solve(TimeNs time, std::span<const CameraEstimate> cameras, std::span<const bool> usable);
  void synchronise(std::size_t camera, const CameraEstimate& estimate, TimeNs time, Observation& moved) const;
  void moveTo(const PoseFit& fit, TimeNs time);
  void report(std::size_t camera, const CameraEstimate& estimate);

  MarkerLayout markers_;
  std::vector<CameraModel> cameras_;
  double standing_height_;
  Acquisition acquisition_;
  std::vector<View> views_;
  std::array<NamedView, kMaxCameras> solved_views_;  ///< scratch
  std::array<Observation, kMaxCameras> moved_;       ///< scratch: images at one time

  bool acquired_ = false;
  bool corrected_ = false;  ///< since the last pose: the next one's step is no motion
  TimeNs pose_time_ = 0;
  HelicopterState state_;
  Matrix6d covariance_ = Matrix6d::Identity();
};

}  // namespace helical
