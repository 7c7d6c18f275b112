#include "engine/pipeline/flight_loop.h"

#include <algorithm>
#include <cmath>

#include "engine/base/clock.h"

namespace helical {
namespace {

// What took longer to get here says nothing about now; used, it would keep the no-pose failsafes silent.
constexpr TimeNs kLatest = 150 * kNanosecondsPerMillisecond;
constexpr TimeNs kTeaching = 50 * kNanosecondsPerMillisecond;
constexpr TimeNs kRateWindow = kNanosecondsPerSecond / 2;
constexpr int kPercentileTicks = 30;  // percentiles cost a pass over the bins: not at every tick

/// Wall time of this thread's work; the flight's own clock may be simulated.
const MonotonicClock& stopwatch() {
  static const MonotonicClock clock;
  return clock;
}

std::vector<CameraModel> models(const RigConfig& rig) {
  std::vector<CameraModel> result;
  for (const auto& camera : rig.cameras) result.push_back(camera.model);
  return result;
}

}  // namespace

FlightLoop::FlightLoop(const RigConfig& rig, const FlightPlan& plan)
    : rig_(rig),
      tracker_(makeTracker(rig.tracker, rig.tracking, rig.markers_in_body, models(rig),
                           rig.helicopter.standing_height)),
      autopilot_(plan, rig.control, rig.safety, rig.helicopter) {
  snapshot_.camera_count = static_cast<int>(rig.cameras.size());
  snapshot_.marker_count = rig.markers_in_body.count();
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraConfig& camera = rig.cameras[i];
    if (!camera.camera_from_world) continue;
    estimates_[i].camera_from_world = *camera.camera_from_world;
    // A pose that the rig file vouches for flies; a first guess waits for its calibration.
    estimates_[i].status = camera.pose_is_guess ? CameraStatus::kCalibrating : CameraStatus::kCalibrated;
    if (camera.pose_is_guess)
      calibrations_[i] =
          std::make_unique<CameraCalibration>(rig.calibrator, camera.model, rig.markers_in_body,
                                              *camera.camera_from_world, rig.simulation.seed + i);
  }
  const bool anybody = std::any_of(calibrations_.begin(), calibrations_.end(),
                                   [](const auto& calibration) { return calibration != nullptr; });
  if (anybody && !rig.learn_from_own_pose)
    teacher_ = makeTracker(rig.tracker, rig.tracking, rig.markers_in_body, models(rig),
                           rig.helicopter.standing_height);
}

void FlightLoop::hideCamera(CameraId camera, bool hidden) {
  snapshot_.cameras[static_cast<std::size_t>(camera.index())].hidden = hidden;
}

void FlightLoop::swapCalibration(CameraId camera, std::unique_ptr<CameraCalibration>& calibration) {
  const auto index = static_cast<std::size_t>(camera.index());
  if (!calibrations_[index] || !calibration) return;
  calibrations_[index].swap(calibration);
  estimates_[index] = calibrations_[index]->estimate();
  bounds_[index].restart();
}

const CameraCalibration* FlightLoop::calibration(CameraId camera) const {
  return calibrations_[static_cast<std::size_t>(camera.index())].get();
}

void FlightLoop::onObservation(const Observation& observation, TimeNs now) {
  const TimeNs begin = stopwatch().now();
  const auto index = static_cast<std::size_t>(observation.camera.index());
  count(observation, now);
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i)
    usable_[i] = estimates_[i].status == CameraStatus::kCalibrated && !snapshot_.cameras[i].hidden;
  const std::size_t cameras = rig_.cameras.size();
  if (now - observation.exposure > kLatest) return;
  const TimeNs last_update = tracker_->lastUpdate();
  tracker_->update(observation, {estimates_.data(), cameras}, {usable_.data(), cameras}, airborne_);
  if (teacher_ && !calibrations_[index])
    teacher_->update(observation, {estimates_.data(), cameras}, {usable_.data(), cameras}, airborne_);
  if (tracker_->lastUpdate() != last_update) pose_time_ = now;
  calibrate(observation);
  snapshot_.cameras[index].track = tracker_->track(observation.camera);
  work_since_tick_ += stopwatch().now() - begin;
}

void FlightLoop::calibrate(const Observation& observation) {
  const auto index = static_cast<std::size_t>(observation.camera.index());
  const Tracker& teacher = teacher_ ? *teacher_ : *tracker_;
  if (!calibrations_[index] || snapshot_.cameras[index].hidden || !teacher.acquired()) return;
  // The pose must come from cameras whose own pose was given, two at least. A camera that teaches itself
  // confirms its own error, and two that were taught in flight would confirm each other's.
  int teachers = 0;
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    const CameraTrack& track = teacher.track(cameraId(static_cast<int>(i)));
    if (usable_[i] && !calibrations_[i] && track.selected_count >= 2 &&
        observation.exposure - track.exposure < kTeaching)
      ++teachers;
  }
  if (teachers < 2 && !rig_.learn_from_own_pose) return;
  if (observation.exposure - teacher.lastUpdate() > kTeaching) return;
  const TrackedState helicopter = teacher.predict(observation.exposure, airborne_);
  calibrations_[index]->step(observation, helicopter);
  estimates_[index] = calibrations_[index]->estimate();
  addToBound(observation, helicopter.state.world_from_body);
}

void FlightLoop::addToBound(const Observation& observation, const RigidTransform& world_from_body) {
  if (observation.count == 0) return;
  const auto index = static_cast<std::size_t>(observation.camera.index());
  BoundFrame frame;
  frame.world_from_body = world_from_body;
  frame.sigma_px = std::sqrt(0.5 * observation.centroids[0].covariance.trace());
  // Before the camera knows the names only the number of its balls is known.
  frame.balls = std::min(observation.count, rig_.markers_in_body.count());
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    const CameraTrack& track = tracker_->track(cameraId(static_cast<int>(i)));
    if (i == index || !usable_[i] || observation.exposure - track.exposure >= kTeaching) continue;
    std::array<MarkerId, kMaxMarkers> seen;
    std::size_t count = 0;
    for (int m = 0; m < rig_.markers_in_body.count(); ++m)
      if (track.markers[static_cast<std::size_t>(m)].selected) seen[count++] = markerId(m);
    frame.pose_information +=
        poseInformation(rig_.cameras[i].model, estimates_[i].camera_from_world, rig_.markers_in_body,
                        {seen.data(), count}, world_from_body, frame.sigma_px);
  }
  bounds_[index].add(rig_.cameras[index].model, rig_.markers_in_body,
                     calibrations_[index]->calibrator().estimate(), frame);
  snapshot_.cameras[index].calibration_bound = bounds_[index].bound();
}

void FlightLoop::count(const Observation& observation, TimeNs now) {
  const auto index = static_cast<std::size_t>(observation.camera.index());
  CameraSnapshot& camera = snapshot_.cameras[index];
  CameraCounters& counters = counters_[index];
  if (counters.seen && observation.sequence > counters.last_sequence + 1)
    camera.dropped += observation.sequence - counters.last_sequence - 1;
  if (!counters.seen) counters.window_start = now;
  counters.seen = true;
  counters.last_sequence = observation.sequence;
  counters.unused_arrival = observation.arrival;
  ++counters.window_frames;
  ++camera.frames;
  camera.latency = now - observation.exposure;
  camera.centroids = observation.count;
  if (observation.extraction > 0) extraction_time_[index].add(observation.extraction);
}

const StickDemand& FlightLoop::onTick(TimeNs now, const OperatorCommands& commands) {
  const TimeNs begin = stopwatch().now();
  AutopilotInput input;
  input.now = now;
  input.pose_known = tracker_->acquired();
  input.pose_age_s = toSeconds(now - pose_time_);
  input.state = tracker_->predict(now + fromSeconds(rig_.control.output_delay_s), airborne_).state;
  input.commands = commands;
  const AutopilotOutput output = autopilot_.step(input);
  airborne_ = output.airborne;
  fillSnapshot(now, output);

  server_time_.add(work_since_tick_ + stopwatch().now() - begin);
  work_since_tick_ = 0;
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    if (counters_[i].unused_arrival >= 0) frame_to_command_.add(now - counters_[i].unused_arrival);
    counters_[i].unused_arrival = -1;
  }
  measureRates(now);
  return snapshot_.sticks;
}

void FlightLoop::fillSnapshot(TimeNs now, const AutopilotOutput& output) {
  const double age = toSeconds(now - pose_time_);
  if (snapshot_.phase == FlightPhase::kIdle && output.phase != FlightPhase::kIdle) started_ = now;
  if (output.phase != FlightPhase::kOff && started_ >= 0) snapshot_.flight_time_s = toSeconds(now - started_);
  snapshot_.time = now;
  ++snapshot_.tick;
  snapshot_.pose_known = tracker_->acquired() && age <= rig_.safety.coast_after_s;
  snapshot_.pose_age = now - pose_time_;
  snapshot_.phase = output.phase;
  snapshot_.safety = output.safety;
  snapshot_.failsafes = output.failsafes;
  snapshot_.tracked = tracker_->predict(now, airborne_);
  snapshot_.set_point = output.set_point;
  snapshot_.hovering = output.hovering;
  snapshot_.pad_height = output.pad_height;
  snapshot_.sticks = output.sticks;
  snapshot_.obstacle = output.obstacle;
  snapshot_.refusal = output.refusal;
  snapshot_.ticks_per_second = rig_.control.rate_hz;
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    snapshot_.cameras[i].estimate = estimates_[i];
    snapshot_.cameras[i].calibration_method =
        calibrations_[i] ? calibrations_[i]->calibrator().name() : nullptr;
  }
}

void FlightLoop::measureRates(TimeNs now) {
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    CameraCounters& counters = counters_[i];
    const TimeNs elapsed = now - counters.window_start;
    if (!counters.seen || elapsed < kRateWindow) continue;
    snapshot_.cameras[i].frames_per_second = static_cast<double>(counters.window_frames) / toSeconds(elapsed);
    counters.window_start = now;
    counters.window_frames = 0;
  }
  if (snapshot_.tick % kPercentileTicks != 0) return;
  snapshot_.server_p50 = server_time_.percentile(0.50);
  snapshot_.server_p99 = server_time_.percentile(0.99);
  snapshot_.frame_to_command_p50 = frame_to_command_.percentile(0.50);
  snapshot_.frame_to_command_p99 = frame_to_command_.percentile(0.99);
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    snapshot_.cameras[i].extraction_p50 = extraction_time_[i].percentile(0.50);
    snapshot_.cameras[i].extraction_p99 = extraction_time_[i].percentile(0.99);
  }
}

}  // namespace helical
