#include "engine/tracking/adaptive_noise.h"

#include <algorithm>
#include <cmath>

namespace helical {
namespace {

constexpr double kGain =
    0.015;  // per observation and unit of surprise: half a second at 120 observations a second
constexpr double kLargest = 25.0;  // a single surprise counts no more than this
const double kLowest = std::log(0.1), kHighest = std::log(12.0);

double ratio(double correction, double variance) {
  return variance > 0.0 ? correction * correction / variance : 1.0;
}

}  // namespace

AdaptiveNoise::AdaptiveNoise(const MotionNoise& nominal) : nominal_(nominal), noise_(nominal) {}

void AdaptiveNoise::reset() {
  log_scale_.fill(0.0);
  noise_ = nominal_;
}

void AdaptiveNoise::move(Group group, double surprise, double lowest) {
  double& scale = log_scale_[group];
  scale = std::clamp(scale + kGain * (std::min(surprise, kLargest) - 1.0), lowest, kHighest);
}

void AdaptiveNoise::learn(const Eigen::Vector3d& velocity, const Eigen::Vector3d& velocity_variance,
                          const Eigen::Vector3d& spin, const Eigen::Vector3d& spin_variance, bool airborne) {
  const double lowest = airborne ? kLowest : 0.0;
  move(kLateral,
       0.5 * (ratio(velocity.x(), velocity_variance.x()) + ratio(velocity.y(), velocity_variance.y())),
       lowest);
  move(kVertical, ratio(velocity.z(), velocity_variance.z()), lowest);
  move(kTilt, 0.5 * (ratio(spin.x(), spin_variance.x()) + ratio(spin.y(), spin_variance.y())), lowest);
  move(kYaw, ratio(spin.z(), spin_variance.z()), lowest);
  noise_.lateral = nominal_.lateral * std::exp(log_scale_[kLateral]);
  noise_.vertical = nominal_.vertical * std::exp(log_scale_[kVertical]);
  noise_.tilt = nominal_.tilt * std::exp(log_scale_[kTilt]);
  noise_.yaw = nominal_.yaw * std::exp(log_scale_[kYaw]);
}

}  // namespace helical
