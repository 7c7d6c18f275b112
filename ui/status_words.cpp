#include "ui/status_words.h"

#include <QCoreApplication>
#include <QStringList>
#include <array>
#include <utility>

#include "ui/theme.h"

namespace helical {
namespace {

constexpr TimeNs kTrackedFor = kNanosecondsPerSecond / 4;

QString tr(const char* text) {
  return QCoreApplication::translate("Status", text);
}

}  // namespace

StatusWord cameraStatusWord(CameraStatus status) {
  switch (status) {
    case CameraStatus::kUncalibrated:
      return {tr("Un-calibrated"), theme::kCaution};
    case CameraStatus::kCalibrating:
      return {tr("Calibrating"), theme::kActive};
    case CameraStatus::kCalibrated:
      return {tr("Calibrated"), theme::kHealthy};
    case CameraStatus::kRejected:
      return {tr("Rejected"), theme::kCaution};
  }
  return {};
}

StatusWord calibrationWord(const EngineSnapshot& snapshot, int camera) {
  const CameraSnapshot& state = snapshot.cameras[static_cast<std::size_t>(camera)];
  const StatusWord word = cameraStatusWord(state.estimate.status);
  if (state.estimate.status == CameraStatus::kCalibrated) return word;
  if (state.hidden) return {tr("Hidden"), theme::kCaution};
  int teachers = 0;
  for (int i = 0; i < snapshot.camera_count; ++i) {
    const CameraTrack& track = snapshot.cameras[static_cast<std::size_t>(i)].track;
    if (i != camera && track.selected_count > 0 && snapshot.time - track.exposure < kTrackedFor) ++teachers;
  }
  if (teachers < 2) return {tr("Needs two others"), theme::kCaution};
  switch (state.estimate.status) {
    case CameraStatus::kUncalibrated:
      return {tr("Searching labels"), theme::kActive};
    case CameraStatus::kCalibrating:
      return {tr("Converging"), theme::kActive};
    case CameraStatus::kRejected:
      return {tr("Knocked"), theme::kCaution};
    case CameraStatus::kCalibrated:
      break;
  }
  return word;
}

StatusWord phaseWord(FlightPhase phase) {
  switch (phase) {
    case FlightPhase::kIdle:
      return {tr("On the pad"), theme::kText};
    case FlightPhase::kSpinUp:
      return {tr("Spin-up"), theme::kActive};
    case FlightPhase::kLiftOff:
      return {tr("Take-off"), theme::kActive};
    case FlightPhase::kFlying:
      return {tr("Flying"), theme::kActive};
    case FlightPhase::kLanding:
      return {tr("Landing"), theme::kActive};
    case FlightPhase::kTouchdown:
      return {tr("Touchdown"), theme::kActive};
    case FlightPhase::kOff:
      return {tr("Rotors off"), theme::kText};
  }
  return {};
}

StatusWord safetyWord(SafetyState state) {
  switch (state) {
    case SafetyState::kNormal:
      return {tr("Normal"), theme::kHealthy};
    case SafetyState::kHolding:
      return {tr("Holding"), theme::kCaution};
    case SafetyState::kCoasting:
      return {tr("Coasting"), theme::kCaution};
    case SafetyState::kNeutral:
      return {tr("Neutral"), theme::kCaution};
    case SafetyState::kDescending:
      return {tr("Descending"), theme::kDanger};
    case SafetyState::kLandNow:
      return {tr("Land now"), theme::kCaution};
    case SafetyState::kCut:
      return {tr("Cut"), theme::kDanger};
  }
  return {};
}

StatusWord readinessWord(const EngineSnapshot& snapshot) {
  if (snapshot.safety == SafetyState::kCut) return safetyWord(snapshot.safety);
  if (snapshot.phase == FlightPhase::kOff) return {tr("Landed"), theme::kHealthy};
  if (snapshot.safety != SafetyState::kNormal) return safetyWord(snapshot.safety);
  if (inFlight(snapshot.phase)) return phaseWord(snapshot.phase);
  if (!snapshot.pose_known) return {tr("No pose"), theme::kCaution};
  if (snapshot.obstacle != nullptr) return {tr("Not ready"), theme::kCaution};
  if (snapshot.armed) return {tr("Armed"), theme::kCaution};
  if (snapshot.failing_checks != 0) return {tr("Not ready"), theme::kCaution};
  return {tr("Ready"), theme::kHealthy};
}

StatusWord pilotWord(const EngineSnapshot& snapshot) {
  if (snapshot.devices.transmitter.pilot_flies) return {tr("Pilot"), theme::kCaution};
  if (snapshot.safety != SafetyState::kCut && (snapshot.armed || inFlight(snapshot.phase)))
    return {tr("Helical"), theme::kActive};
  return {tr("Nobody"), theme::kFaint};
}

QString failsafeNames(std::uint32_t failsafes) {
  static const std::array<std::pair<Failsafe, const char*>, 17> names{{
      {Failsafe::kNoPoseCoast, QT_TRANSLATE_NOOP("Status", "coast")},
      {Failsafe::kNoPoseDescent, QT_TRANSLATE_NOOP("Status", "descent")},
      {Failsafe::kNoPoseCut, QT_TRANSLATE_NOOP("Status", "no-pose cut")},
      {Failsafe::kTilt, QT_TRANSLATE_NOOP("Status", "tilt")},
      {Failsafe::kFence, QT_TRANSLATE_NOOP("Status", "fence")},
      {Failsafe::kHardFence, QT_TRANSLATE_NOOP("Status", "hard fence")},
      {Failsafe::kFlightTime, QT_TRANSLATE_NOOP("Status", "flight time")},
      {Failsafe::kKill, QT_TRANSLATE_NOOP("Status", "stop")},
      {Failsafe::kLiftOffFailed, QT_TRANSLATE_NOOP("Status", "lift-off failed")},
      {Failsafe::kNoPoseNeutral, QT_TRANSLATE_NOOP("Status", "neutral")},
      {Failsafe::kFewCameras, QT_TRANSLATE_NOOP("Status", "no camera")},
      {Failsafe::kUncertain, QT_TRANSLATE_NOOP("Status", "doubtful pose")},
      {Failsafe::kUncertainLand, QT_TRANSLATE_NOOP("Status", "doubtful pose: landed")},
      {Failsafe::kSpeed, QT_TRANSLATE_NOOP("Status", "speed")},
      {Failsafe::kTransmitterLost, QT_TRANSLATE_NOOP("Status", "transmitter")},
      {Failsafe::kTransmitterStalled, QT_TRANSLATE_NOOP("Status", "transmitter: landed")},
      {Failsafe::kTransmitterSilent, QT_TRANSLATE_NOOP("Status", "transmitter: cut")},
  }};
  QStringList acted;
  for (const auto& [failsafe, name] : names)
    if (failsafes & static_cast<std::uint32_t>(failsafe)) acted << tr(name);
  return acted.join(QStringLiteral(", "));
}

bool inFlight(FlightPhase phase) {
  return phase != FlightPhase::kIdle && phase != FlightPhase::kOff;
}

bool hasReference(const EngineSnapshot& snapshot) {
  return inFlight(snapshot.phase) && snapshot.safety != SafetyState::kCut;
}

int trackedCameras(const EngineSnapshot& snapshot) {
  int tracked = 0;
  for (int i = 0; i < snapshot.camera_count; ++i) {
    const CameraTrack& track = snapshot.cameras[static_cast<std::size_t>(i)].track;
    if (track.selected_count > 0 && snapshot.time - track.exposure < kTrackedFor) ++tracked;
  }
  return tracked;
}

}  // namespace helical
