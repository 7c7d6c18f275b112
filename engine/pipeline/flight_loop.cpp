#include "engine/pipeline/flight_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/clock.h"
#include "engine/pipeline/ball_forecast.h"

namespace helical {
namespace {

// What took longer to get here says nothing about now; used, it would keep the no-pose failsafes silent.
constexpr TimeNs kLatest = 150 * kNanosecondsPerMillisecond;
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
      control_set_(rig),
      cables_(rig.markers_in_body, models(rig), rig.helicopter.standing_height),
      health_(rig),
      autopilot_(plan, rig.control, rig.safety, rig.helicopter) {
  snapshot_.camera_count = static_cast<int>(rig.cameras.size());
  snapshot_.marker_count = rig.markers_in_body.count();
  snapshot_.markers = rig.markers_in_body;
}

void FlightLoop::onObservation(const Observation& observation, TimeNs now) {
  const CameraId camera = cables_.cameraOf(observation.camera);
  if (camera == observation.camera) return use(observation, now);
  of_its_camera_ = observation;
  of_its_camera_.camera = camera;
  use(of_its_camera_, now);
}

void FlightLoop::use(const Observation& observation, TimeNs now) {
  const TimeNs begin = stopwatch().now();
  const auto index = static_cast<std::size_t>(observation.camera.index());
  last_used_ = index;
  count(observation, now);
  health_.onObservation(observation, now);
  if (now - observation.exposure > kLatest || health_.clockHasJumped(observation.camera)) return;
  if (control_set_.takeCorrection()) {
    tracker_->correct(control_set_.markers(), control_set_.models());
    cables_.correct(control_set_.markers(), control_set_.models());
  }
  const TimeNs last_update = tracker_->lastUpdate();
  tracker_->update(observation, control_set_.estimates(), control_set_.usable(), airborne_);
  // Frames that waited for a starved processor are as old as they are.
  if (tracker_->lastUpdate() != last_update)
    pose_time_ = std::max(pose_time_, std::min(now, observation.arrival));
  control_set_.learn(observation, *tracker_, airborne_);
  watchCables(observation);
  snapshot_.cameras[index].track = tracker_->track(observation.camera);
  work_since_tick_ += stopwatch().now() - begin;
}

void FlightLoop::watchCables(const Observation& observation) {
  // Before the first calibration somebody carries the helicopter about, and nothing agrees.
  if (!airborne_ && control_set_.instruction() != nullptr) return;
  const CableWatch::Verdict verdict =
      cables_.add(observation, control_set_.places(), control_set_.usable(), *tracker_, airborne_);
  if (verdict.finding == CableWatch::Finding::kNothing) return;
  if (verdict.finding == CableWatch::Finding::kChanged) exchangeStreams(verdict.camera, verdict.other);
  control_set_.standsAsBefore(verdict.camera);
  control_set_.standsAsBefore(verdict.other);
}

/// What is counted of frames is counted of streams: each has a sequence of its own.
void FlightLoop::exchangeStreams(CameraId a, CameraId b) {
  const auto first = static_cast<std::size_t>(a.index());
  const auto second = static_cast<std::size_t>(b.index());
  std::swap(snapshot_.streams[first], snapshot_.streams[second]);
  std::swap(counters_[first], counters_[second]);
  health_.exchange(a, b);
}

void FlightLoop::swapPlan(FlightPlan& plan) {
  autopilot_.swapPlan(plan);
  ++snapshot_.plans;
}

void FlightLoop::setControl(const ControllerOptions& control) {
  autopilot_.setControl(control);
  ++snapshot_.controls;
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

const StickDemand& FlightLoop::onTick(TimeNs now, const OperatorCommands& commands,
                                      const DeviceStatus& devices) {
  const TimeNs begin = stopwatch().now();
  AutopilotInput input;
  input.now = now;
  input.pose_known = tracker_->acquired();
  input.pose_age_s = toSeconds(now - pose_time_);
  input.state = tracker_->predict(now + fromSeconds(rig_.control.output_delay_s), airborne_).state;
  input.commands = commands;
  input.health = health_.onTick(now, control_set_.usable(), snapshot_, devices);
  snapshot_.devices = devices;
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
  snapshot_.alarms = output.alarms;
  snapshot_.armed = output.armed;
  snapshot_.failing_checks = output.failing_checks;
  snapshot_.arm_refused = output.arm_refused;
  snapshot_.holding = output.holding;
  snapshot_.tracked = tracker_->predict(now, airborne_);
  snapshot_.set_point = output.set_point;
  snapshot_.hovering = output.hovering;
  snapshot_.pad_height = output.pad_height;
  snapshot_.sticks = output.sticks;
  snapshot_.obstacle = output.obstacle;
  snapshot_.refusal = output.refusal;
  snapshot_.ticks_per_second = rig_.control.rate_hz;
  snapshot_.markers = control_set_.markers();
  snapshot_.refinement = control_set_.refinement();
  snapshot_.cameras_disagree = control_set_.camerasDisagree();
  snapshot_.cables_changed = cables_.changes();
  snapshot_.cold_start = airborne_ || snapshot_.pose_known ? nullptr : control_set_.instruction();
  for (std::size_t i = 0; i < rig_.cameras.size(); ++i) {
    const CameraId id = cameraId(static_cast<int>(i));
    CameraSnapshot& camera = snapshot_.cameras[i];
    camera.estimate = control_set_.estimates()[i];
    camera.focal_scale = control_set_.focalScale(id);
    camera.hidden = control_set_.hidden(id);
    camera.calibration_method = control_set_.method(id);
    camera.calibration_bound = control_set_.bound(id);
    camera.knocks_found = control_set_.knocksFound(id);
    camera.frozen = control_set_.frozen(id);
    const CameraCalibration* calibration = control_set_.calibration(id);
    camera.labellings = calibration != nullptr ? calibration->labellings() : TriedLabellings{};
  }
}

BallPredictions FlightLoop::expectedBalls(CameraId stream) const {
  const CameraId camera = cables_.cameraOf(stream);
  const auto index = static_cast<std::size_t>(camera.index());
  if (!snapshot_.pose_known || !control_set_.usable()[index]) return {};
  return forecastBalls(snapshot_.tracked, control_set_.estimates()[index], control_set_.models()[index],
                       control_set_.markers());
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
