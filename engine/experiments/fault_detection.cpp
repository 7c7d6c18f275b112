#include "engine/experiments/fault_detection.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace helical {
namespace {

constexpr double kPatience = 1.5;  // limits, that a fault must last to count
constexpr double kUsedIfSoonerS = 0.02;  // frames that are later than this may come too late for the pose
constexpr double kShortLimitS = 0.5;  // within it a starved processor has but a few ticks

bool alarms(const EngineSnapshot& tick, Failsafe failsafe) {
  return (tick.alarms & bitOf(failsafe)) != 0;
}

const CameraSnapshot& cameraOf(const Fault& fault, const EngineSnapshot& tick) {
  return tick.cameras[static_cast<std::size_t>(fault.camera.index())];
}

bool isAbout(const Fault& fault, CameraId camera) {
  return fault.camera == camera || (fault.kind == FaultKind::kCamerasSwapped && fault.other == camera);
}

bool isByImage(FaultKind kind) {
  return kind == FaultKind::kCameraKnocked || kind == FaultKind::kCamerasSwapped;
}

/// Whether `other` leaves nothing there to notice `fault` by in the time that it has: nothing comes from the camera,
/// there is nothing in its images, or no processor runs.
bool isHiddenBehind(const Fault& fault, const Fault& other) {
  const double limit_s = detectionLimit(fault.kind);
  if (other.from_s > fault.from_s + kPatience * limit_s || other.to_s < fault.from_s) return false;
  const bool by_image = isByImage(fault.kind);
  const bool by_frame = by_image || fault.kind == FaultKind::kCameraLate || fault.kind == FaultKind::kClockJump;
  switch (other.kind) {
    case FaultKind::kProcessorStarved:
      return limit_s <= kShortLimitS && fault.kind != FaultKind::kProcessorStarved;
    case FaultKind::kCameraLost:
      return by_frame && isAbout(fault, other.camera);
    case FaultKind::kCameraHidden:
      return by_image && isAbout(fault, other.camera);
    case FaultKind::kCamerasHidden:
      return by_image;
    default:
      return false;
  }
}

/// When the frames that show `fault` are used; infinite: not in this flight.
double usedFrom(const Fault& fault, const std::vector<Fault>& faults) {
  double from_s = fault.from_s;
  for (const Fault& other : faults) {
    const bool left_out = other.kind == FaultKind::kClockJump ||
                          (other.kind == FaultKind::kCameraLate && other.amount > kUsedIfSoonerS);
    if (left_out && isAbout(fault, other.camera) && other.from_s < from_s + detectionLimit(fault.kind))
      from_s = std::max(from_s, other.to_s + other.amount);
  }
  return from_s;
}

/// Those whose rule needs rotors that turn.
bool needsRotors(FaultKind kind) {
  return kind == FaultKind::kCamerasHidden || kind == FaultKind::kCamerasSwapped || kind == FaultKind::kCameraKnocked;
}

}  // namespace

FaultDetection::FaultDetection(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    const bool hidden = std::any_of(faults.begin(), faults.end(),
                                    [&](const Fault& other) { return isHiddenBehind(fault, other); });
    if (std::isnan(detectionLimit(fault.kind)) || hidden) continue;
    watched_.push_back({.fault = fault, .used_from_s = isByImage(fault.kind) ? usedFrom(fault, faults) : fault.from_s});
  }
}

bool FaultDetection::isNoticed(const Watched& watched, const EngineSnapshot& tick) {
  const CameraSnapshot& camera = cameraOf(watched.fault, tick);
  switch (watched.fault.kind) {
    case FaultKind::kCamerasHidden:
      return alarms(tick, Failsafe::kNoPoseCoast);
    case FaultKind::kCameraLost:
      return alarms(tick, Failsafe::kCameraSilent);
    case FaultKind::kCameraLate:
    case FaultKind::kClockJump:
      return alarms(tick, Failsafe::kCameraClock);
    case FaultKind::kCameraKnocked:
    case FaultKind::kCamerasSwapped:
      return camera.knocks_found > watched.knocks_before || tick.cables_changed != watched.changes_before ||
             camera.estimate.status == CameraStatus::kRejected || tick.cameras_disagree ||
             alarms(tick, Failsafe::kUncertain) || alarms(tick, Failsafe::kNoPoseCoast);
    case FaultKind::kTransmitterUnplugged:
    case FaultKind::kTransmitterStalled:
      return alarms(tick, Failsafe::kTransmitterFault);
    case FaultKind::kProcessorStarved:
      return alarms(tick, Failsafe::kOverrun);
    case FaultKind::kDiskFull:
      return alarms(tick, Failsafe::kRecord);
    default:
      return false;
  }
}

void FaultDetection::add(const EngineSnapshot& tick) {
  const double time_s = toSeconds(tick.time);
  for (Watched& w : watched_) {
    if (time_s < w.fault.from_s) continue;
    const bool over = tick.phase == FlightPhase::kOff || tick.verdict.crashed || time_s >= w.fault.to_s;
    const bool watchable = !over && (!needsRotors(w.fault.kind) || rotorsTurn(tick.phase)) && tick.has_truth;
    if (!w.began) {
      w.began = true;
      w.knocks_before = cameraOf(w.fault, tick).knocks_found;
      w.changes_before = tick.cables_changed;
      w.counts = watchable && !isNoticed(w, tick);
    }
    if (!w.counts || w.detected_s >= 0.0) continue;
    if (watchable) w.watched_until_s = time_s;
    if (isNoticed(w, tick)) w.detected_s = time_s;
    if (!watchable) w.counts = w.detected_s >= 0.0 || wasWatchedForLong(w);
  }
}

bool FaultDetection::wasWatchedForLong(const Watched& watched) {
  return watched.watched_until_s - watched.used_from_s > kPatience * detectionLimit(watched.fault.kind);
}

std::vector<Detection> FaultDetection::result() const {
  std::vector<Detection> all;
  for (const Watched& w : watched_) {
    const bool detected = w.detected_s >= 0.0;
    const bool too_early_to_count = detected && w.detected_s < w.used_from_s;
    if (!w.counts || too_early_to_count || (!detected && !wasWatchedForLong(w))) continue;
    all.push_back({w.fault.kind, detected ? w.detected_s - w.used_from_s : std::numeric_limits<double>::infinity()});
  }
  return all;
}

}  // namespace helical
