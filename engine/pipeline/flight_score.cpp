#include "engine/pipeline/flight_score.h"

#include <Eigen/Cholesky>
#include <bit>
#include <cmath>

#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr TimeNs kSettle = 2 * kNanosecondsPerSecond;

/// Failsafes after which a flight that ends well has still not done what the plan asked.
constexpr std::uint32_t kEndingFailsafes =
    static_cast<std::uint32_t>(Failsafe::kNoPoseCut) | static_cast<std::uint32_t>(Failsafe::kTilt) |
    static_cast<std::uint32_t>(Failsafe::kFence) | static_cast<std::uint32_t>(Failsafe::kHardFence) |
    static_cast<std::uint32_t>(Failsafe::kFlightTime) | static_cast<std::uint32_t>(Failsafe::kKill) |
    static_cast<std::uint32_t>(Failsafe::kLiftOffFailed) | bitOf(Failsafe::kUncertainLand) |
    bitOf(Failsafe::kSpeed) | bitOf(Failsafe::kTransmitterLost) |
    bitOf(Failsafe::kTransmitterStalled) | bitOf(Failsafe::kTransmitterSilent);

double normalised(const Eigen::VectorXd& error, const Eigen::MatrixXd& covariance) {
  return error.dot(covariance.ldlt().solve(error));
}

}  // namespace

double RunningRms::value() const {
  return count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_)) : 0.0;
}

void FlightScore::add(const EngineSnapshot& tick) {
  const double dt = last_time_ > 0 ? toSeconds(tick.time - last_time_) : 0.0;
  last_time_ = tick.time;
  failsafes_ |= tick.failsafes;
  failing_checks_ = tick.failing_checks;
  armed_ = armed_ || tick.armed;
  has_flown_ = has_flown_ || inTheAir(tick.phase);
  if (!rotorsTurn(tick.phase)) return;
  if (!tick.pose_known) lost_s_ += dt;
  for (std::size_t c = 0; c < static_cast<std::size_t>(tick.camera_count); ++c) {
    const CameraTrack& track = tick.cameras[c].track;
    if (track.exposure == last_exposure_[c]) continue;
    last_exposure_[c] = track.exposure;
    selected_[c] += static_cast<std::uint64_t>(track.selected_count);
    shown_[c] += static_cast<std::uint64_t>(tick.marker_count);
  }
  if (!tick.has_truth) return;
  if (inTheAir(tick.phase) && tick.pose_known) addTracking(tick);
  addControl(tick);
  addCalibration(tick);
}

void FlightScore::addCalibration(const EngineSnapshot& tick) {
  for (std::size_t c = 0; c < static_cast<std::size_t>(tick.camera_count); ++c) {
    const CameraSnapshot& camera = tick.cameras[c];
    if (camera.calibration_method == nullptr || !camera.has_truth || converged_s_[c] >= 0.0) continue;
    const CameraError error = cameraError(camera.estimate.camera_from_world, camera.true_camera_from_world);
    if (error.position < 0.01 && error.orientation < toRadians(0.5)) converged_s_[c] = toSeconds(tick.time);
  }
}

void FlightScore::addTracking(const EngineSnapshot& tick) {
  const RigidTransform& estimate = tick.tracked.state.world_from_body;
  const RigidTransform& truth = tick.truth.world_from_body;
  Vector6d error;
  error.head<3>() = truth.translation - estimate.translation;
  error.tail<3>() = logSO3(estimate.rotation.conjugate() * truth.rotation);
  tracked_position_.add(error.head<3>().norm());
  tracked_orientation_.add(error.tail<3>().norm());
  const Matrix6d& p = tick.tracked.pose_covariance;
  nees_[0] += normalised(error, p);
  nees_[1] += normalised(error.segment<2>(0), p.block<2, 2>(0, 0));
  nees_[2] += normalised(error.segment<1>(2), p.block<1, 1>(2, 2));
  nees_[3] += normalised(error.segment<2>(3), p.block<2, 2>(3, 3));
  nees_[4] += normalised(error.segment<1>(5), p.block<1, 1>(5, 5));
  ++nees_samples_;
}

void FlightScore::addControl(const EngineSnapshot& tick) {
  if (!tick.hovering) return;
  if (hover_since_ < 0) hover_since_ = tick.time;
  if (tick.time - hover_since_ < kSettle) return;
  const Eigen::Vector3d off = tick.truth.world_from_body.translation - tick.set_point.position_in_world;
  hover_horizontal_.add(off.head<2>().norm());
  hover_height_.add(off.z());
  hover_yaw_.add(wrapAngle(yawOf(tick.truth.world_from_body.rotation) - tick.set_point.yaw));
}

double FlightScore::selectedShare(CameraId camera) const {
  const auto index = static_cast<std::size_t>(camera.index());
  return shown_[index] > 0 ? static_cast<double>(selected_[index]) / static_cast<double>(shown_[index]) : 0.0;
}

CameraError cameraError(const RigidTransform& estimated, const RigidTransform& truth) {
  return {(estimated.inverseTranslation() - truth.inverseTranslation()).norm(),
          estimated.rotation.angularDistance(truth.rotation)};
}

double calibrationNees(const CameraEstimate& estimate, const RigidTransform& true_camera_from_world) {
  const Vector6d error = cameraPerturbation(estimate.camera_from_world, true_camera_from_world);
  return error.dot(estimate.covariance.ldlt().solve(error));
}

std::string outcomeOf(const Verdict& verdict, std::uint32_t failsafes) {
  if (verdict.crashed) return "crashed";
  if (!verdict.has_flown || !verdict.at_rest) return "aborted";
  return (failsafes & kEndingFailsafes) != 0 ? "failsafe-landed" : "landed";
}

std::vector<std::string> checkReasons(std::uint32_t failing_checks) {
  std::vector<std::string> reasons;
  for (std::uint32_t bits = failing_checks; bits != 0; bits &= bits - 1)
    reasons.emplace_back(toString(static_cast<PreArmCheck>(bits & (~bits + 1))));
  return reasons;
}

std::string outcomeOf(const EngineSnapshot& last, const FlightScore& score) {
  Verdict verdict = last.verdict;
  if (!last.has_truth) {
    verdict.has_flown = score.hasFlown();
    verdict.at_rest = last.phase == FlightPhase::kOff;
  }
  return outcomeOf(verdict, score.failsafes());
}

std::vector<std::string> failsafeNames(std::uint32_t failsafes) {
  std::vector<std::string> names;
  for (std::uint32_t bits = failsafes; bits != 0; bits &= bits - 1)
    names.emplace_back(toString(static_cast<Failsafe>(bits & (~bits + 1))));
  return names;
}

}  // namespace helical
