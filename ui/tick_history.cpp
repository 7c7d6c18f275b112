#include "ui/tick_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/camera_perturbation.h"
#include "ui/status_words.h"

namespace helical {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

double toMs(TimeNs duration) {
  return duration > 0 ? 1e3 * toSeconds(duration) : kNothing;
}

}  // namespace

TickHistory::TickHistory(int cameras)
    : cameras_(cameras),
      times_(kCapacity),
      values_(static_cast<std::size_t>(static_cast<int>(FlightColumn::kCount) +
                                       cameras * static_cast<int>(CameraColumn::kCount)) *
              kCapacity) {}

void TickHistory::set(FlightColumn which, double value) {
  values_[static_cast<std::size_t>(column(which)) * kCapacity + slot(end_)] = static_cast<float>(value);
}

void TickHistory::set(int camera, CameraColumn which, double value) {
  values_[static_cast<std::size_t>(column(camera, which)) * kCapacity + slot(end_)] =
      static_cast<float>(value);
}

void TickHistory::add(const EngineSnapshot& tick) {
  if (end_ > 0 && toSeconds(tick.time) < time(end_ - 1)) end_ = 0;
  times_[slot(end_)] = toSeconds(tick.time);
  addFlight(tick);
  for (int i = 0; i < cameras_; ++i) addCamera(tick, i);
  ++end_;
}

void TickHistory::addFlight(const EngineSnapshot& tick) {
  const RigidTransform& pose = tick.tracked.state.world_from_body;
  const bool known = tick.pose_known;
  if (known) yaw_deg_ += toDegrees(wrapAngle(yawOf(pose.rotation) - toRadians(yaw_deg_)));
  set(FlightColumn::kX, known ? pose.translation.x() : kNothing);
  set(FlightColumn::kY, known ? pose.translation.y() : kNothing);
  set(FlightColumn::kZ, known ? pose.translation.z() : kNothing);
  set(FlightColumn::kYaw, known ? yaw_deg_ : kNothing);

  const bool wanted = hasReference(tick);
  const Eigen::Vector3d& place = tick.set_point.position_in_world;
  set(FlightColumn::kReferenceX, wanted ? place.x() : kNothing);
  set(FlightColumn::kReferenceY, wanted ? place.y() : kNothing);
  set(FlightColumn::kReferenceZ, wanted ? place.z() : kNothing);
  set(FlightColumn::kReferenceYaw,
      wanted ? yaw_deg_ + toDegrees(wrapAngle(tick.set_point.yaw - toRadians(yaw_deg_))) : kNothing);

  const bool compared = known && tick.has_truth;
  const RigidTransform& truth = tick.truth.world_from_body;
  set(FlightColumn::kPositionError, compared ? (pose.translation - truth.translation).norm() : kNothing);
  set(FlightColumn::kOrientationError,
      compared ? toDegrees(logSO3(pose.rotation * truth.rotation.conjugate()).norm()) : kNothing);
  set(FlightColumn::kPositionSigma,
      known ? std::sqrt(std::max(0.0, tick.tracked.pose_covariance.topLeftCorner<3, 3>().trace()))
            : kNothing);
  set(FlightColumn::kUpperRotor, tick.sticks.upper_rotor);
  set(FlightColumn::kLowerRotor, tick.sticks.lower_rotor);
  set(FlightColumn::kRoll, tick.sticks.roll);
  set(FlightColumn::kPitch, tick.sticks.pitch);
  set(FlightColumn::kServerLatency, toMs(tick.server_p99));
  set(FlightColumn::kCommandLatency, toMs(tick.frame_to_command_p99));
  set(FlightColumn::kGust, tick.gust_ordered ? 1.0 : 0.0);
}

void TickHistory::addCamera(const EngineSnapshot& tick, int camera) {
  const CameraSnapshot& state = tick.cameras[static_cast<std::size_t>(camera)];
  const bool learnt = state.calibration_method != nullptr;
  const Matrix6d& covariance = state.estimate.covariance;
  // Until a method has begun there is a guess without a covariance.
  const double position_variance = covariance.bottomRightCorner<3, 3>().trace();
  const bool spread = learnt && position_variance > 0.0;
  set(camera, CameraColumn::kPositionSigma, spread ? std::sqrt(position_variance) : kNothing);
  set(camera, CameraColumn::kOrientationSigma,
      spread ? toDegrees(std::sqrt(covariance.topLeftCorner<3, 3>().trace())) : kNothing);
  const bool compared = learnt && state.has_truth;
  const Vector6d error =
      compared ? cameraPerturbation(state.true_camera_from_world, state.estimate.camera_from_world)
               : Vector6d::Constant(kNothing);
  set(camera, CameraColumn::kOrientationError, toDegrees(error.head<3>().norm()));
  set(camera, CameraColumn::kPositionError, error.tail<3>().norm());
  const auto& bound = state.calibration_bound;
  set(camera, CameraColumn::kPositionBound, bound ? bound->position_m : kNothing);
  set(camera, CameraColumn::kOrientationBound, bound ? toDegrees(bound->orientation_rad) : kNothing);
  set(camera, CameraColumn::kEffective,
      state.effective_sample_size > 0.0 ? state.effective_sample_size : kNothing);

  const bool fresh = tick.time - state.track.exposure < kNanosecondsPerSecond / 4;
  const bool used = fresh && state.track.selected_count > 0;
  set(camera, CameraColumn::kResidual, used ? state.track.residual_px : kNothing);
  std::uint32_t selected = 0;
  for (int m = 0; used && m < tick.marker_count; ++m)
    if (state.track.markers[static_cast<std::size_t>(m)].selected) selected |= 1U << m;
  set(camera, CameraColumn::kSelected, selected);
  set(camera, CameraColumn::kCovered, state.hidden || state.boards > 0 ? 1.0 : 0.0);
  set(camera, CameraColumn::kTampered, state.lost_share > 0.0 || state.noise > 0.0 ? 1.0 : 0.0);
  std::uint64_t& frames = frames_[static_cast<std::size_t>(camera)];
  set(camera, CameraColumn::kLatency, state.frames > frames ? 1e3 * toSeconds(state.latency) : kNothing);
  frames = state.frames;
  set(camera, CameraColumn::kKnocks, state.knocks);
  set(camera, CameraColumn::kStatus, static_cast<double>(state.estimate.status));
  set(camera, CameraColumn::kByMisfit, state.labellings.by_misfit ? 1.0 : 0.0);
  static_assert(TriedLabellings::kMost ==
                static_cast<int>(CameraColumn::kLabelling6) - static_cast<int>(CameraColumn::kLabelling1) + 1);
  for (int i = 0; i < TriedLabellings::kMost; ++i)
    set(camera, static_cast<CameraColumn>(static_cast<int>(CameraColumn::kLabelling1) + i),
        i < state.labellings.count ? double(state.labellings.all[static_cast<std::size_t>(i)].value) : kNothing);
}

std::int64_t TickHistory::rowAt(double time) const {
  std::int64_t low = first(), high = end_;
  while (low < high) {
    const std::int64_t middle = (low + high) / 2;
    if (this->time(middle) < time)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

}  // namespace helical
