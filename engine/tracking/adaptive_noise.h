#pragma once

#include <array>

#include "engine/tracking/motion_model.h"

namespace helical {

/// Process noise that follows what the helicopter does. If the filter's model is right, a correction of a
/// velocity has the variance by which it lowers that velocity's covariance (innovation consistency; Mehra
/// 1970). Each group of axes multiplies its density up while its corrections are larger than that, and down
/// while they are smaller: calm in the hover, awake when the skids let go. One thread.
class AdaptiveNoise {
 public:
  /// Starts at `nominal` and stays within fixed factors of it.
  explicit AdaptiveNoise(const MotionNoise& nominal);

  /// After a measurement update: the corrections and the variances expected of them, for velocity in world
  /// and angular velocity in body. On the ground the noise never falls below nominal: the skids may let go at
  /// any time.
  void learn(const Eigen::Vector3d& velocity_correction, const Eigen::Vector3d& velocity_variance,
             const Eigen::Vector3d& spin_correction, const Eigen::Vector3d& spin_variance, bool airborne);
  /// Back to nominal, after a gap.
  void reset();

  const MotionNoise& noise() const { return noise_; }

 private:
  enum Group { kLateral, kVertical, kTilt, kYaw, kGroups };
  void move(Group group, double surprise, double lowest);

  MotionNoise nominal_;
  MotionNoise noise_;
  std::array<double, kGroups> log_scale_{};
};

}  // namespace helical
