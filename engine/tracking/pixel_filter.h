#pragma once

#include <array>
#include <vector>

#include "engine/correspondence/prediction_naming.h"
#include "engine/tracking/acquisition.h"
#include "engine/tracking/adaptive_noise.h"
#include "engine/tracking/jump_guard.h"
#include "engine/tracking/motion_model.h"
#include "engine/tracking/tracker.h"

namespace helical {

/// Helicopter pose and velocity from the named centroids of every usable camera, each at its own exposure
/// time: an extended Kalman filter on pixels (position, velocity, attitude, body rates), tightly coupled, so
/// that any number of markers in any number of cameras counts, down to a few in one. Features are selected as
/// follows: predict the pose and project the balls; gate by Mahalanobis distance; drop the worst until the
/// rest pass a joint test; let a rejected feature back in after it has agreed twice; coast on the motion
/// model when none is left. In the air a place out of reach is not believed. A gap longer than
/// `reacquire_after_s` ends in a new acquisition. Allocates nothing after construction. One thread.
class PixelFilter final : public Tracker {
 public:
  PixelFilter(const TrackerOptions& options, const MarkerLayout& markers, std::vector<CameraModel> cameras,
              double standing_height);

  /// Observations of different cameras may come out of order by 30 ms; older ones are not used.
  void update(const Observation& observation, std::span<const CameraEstimate> cameras,
              std::span<const bool> usable, bool airborne) override;
  void correct(const MarkerLayout& markers, std::span<const CameraModel> cameras) override;
  void adopt(const Tracker& other) override;
  bool acquired() const override { return acquired_; }
  TimeNs lastUpdate() const override { return last_update_; }
  /// The covariance includes what offsets of the centroids that stay for many frames may do: averaging over
  /// frames does not lower it.
  TrackedState predict(TimeNs time, bool airborne) const override;
  const CameraTrack& track(CameraId camera) const override {
    return tracks_[static_cast<std::size_t>(camera.index())];
  }

 private:
  using Jacobian = Eigen::Matrix<double, 2, 6>;  // of a pixel to (position, rotation vector)
  struct Feature {
    MarkerPrediction prediction;
    Jacobian d_pose = Jacobian::Zero();
    Jacobian d_camera = Jacobian::Zero();
    Eigen::Vector2d innovation = Eigen::Vector2d::Zero();
    Eigen::Matrix2d noise = Eigen::Matrix2d::Identity();
    bool agrees = false;  ///< inside the gate
    bool selected = false;
  };
  using Features = std::array<Feature, kMaxMarkers>;

  /// Whether it may have got there since it was last seen; on the ground it may be carried.
  bool isWithinReach(const Eigen::Vector3d& place, TimeNs time, bool airborne);
  PosePrior priorAt(TimeNs time, bool airborne) const;
  void restart(const PoseFit& fit, TimeNs time);
  void predictFeatures(const Observation& observation, const CameraEstimate& estimate,
                       Features& features) const;
  void nameFeatures(const Observation& observation, Features& features, CameraTrack& track) const;
  void select(CameraId camera, const CameraEstimate& estimate, Features& features);
  /// Kalman update with the selected features; false if it would not be finite, or leads out of reach.
  bool correctWithinReach(const CameraEstimate& estimate, const Features& features, bool airborne);
  bool correct(const CameraEstimate& estimate, const Features& features, bool airborne);
  Matrix6d biasCovariance(TimeNs time) const;
  void report(const Observation& observation, const CameraEstimate& estimate, const Features& features,
              CameraTrack& track) const;

  TrackerOptions options_;
  MarkerLayout markers_;
  std::vector<CameraModel> cameras_;
  double standing_height_;
  MotionModel model_;
  AdaptiveNoise noise_;
  Acquisition acquisition_;
  JumpGuard jumps_;

  bool acquired_ = false;
  TimeNs time_ = 0;
  TimeNs last_update_ = 0;
  HelicopterState state_;
  Matrix12d covariance_ = Matrix12d::Identity();
  HelicopterState last_good_;
  double agreement_ = 1.0;  ///< running share of the centroids in view that fitted
  std::array<std::array<std::uint8_t, kMaxMarkers>, kMaxCameras> probation_{};
  std::array<Matrix6d, kMaxCameras> view_information_;  ///< of a camera's newest selected features, per px^-2
  std::array<CameraTrack, kMaxCameras> tracks_{};
};

}  // namespace helical
