#include "engine/pipeline/announcer.h"

#include <bit>
#include <cstdio>

#include "engine/flight/supervisor.h"

namespace helical {
namespace {

const char* phaseText(FlightPhase phase) {
  switch (phase) {
    case FlightPhase::kIdle:
      return "Idle";
    case FlightPhase::kSpinUp:
      return "Rotors start";
    case FlightPhase::kLiftOff:
      return "Lift-off";
    case FlightPhase::kFlying:
      return "Airborne";
    case FlightPhase::kLanding:
      return "Landing";
    case FlightPhase::kTouchdown:
      return "Touchdown";
    case FlightPhase::kOff:
      return "Rotors off";
  }
  return "";
}

constexpr TimeNs kRepeat =
    30 * kNanosecondsPerSecond;  // a warning that comes and goes is not said more often
constexpr double kTellBallsM = 5e-5;  // what is told has one decimal of a millimetre
constexpr TimeNs kNever = -kRepeat;

Severity severityOf(SafetyState demand) {
  switch (demand) {
    case SafetyState::kNormal:
    case SafetyState::kHolding:
    case SafetyState::kCoasting:
    case SafetyState::kNeutral:
      return Severity::kCaution;
    case SafetyState::kLandNow:
    case SafetyState::kDescending:
    case SafetyState::kCut:
      return Severity::kDanger;
  }
  return Severity::kDanger;
}

const char* calibrationText(CalibrationOrderKind kind) {
  switch (kind) {
    case CalibrationOrderKind::kFreeze:
      return "frozen by the operator: it learns no more";
    case CalibrationOrderKind::kResume:
      return "learns on";
    case CalibrationOrderKind::kAccept:
      return "accepted by the operator";
    case CalibrationOrderKind::kTrustRig:
      return "believed to stand where the rig file says";
    case CalibrationOrderKind::kAdopt:
      return "believed to stand where the loaded calibration says";
    case CalibrationOrderKind::kRefine:
      break;  // is no camera's own
  }
  return "";
}

}  // namespace

Announcer::Announcer(const RigConfig& rig) {
  warned_at_.fill(kNever);
  for (const auto& camera : rig.cameras) {
    names_.push_back(camera.name);
    recordings_.push_back(camera.source.starts_with("file:"));
  }
}

EngineEvent Announcer::event(TimeNs time, Severity severity, const char* text) {
  EngineEvent result{time, severity, {}};
  std::snprintf(result.text.data(), result.text.size(), "%s", text);
  return result;
}

EngineEvent Announcer::event(TimeNs time, Severity severity, std::size_t camera, const char* text) const {
  EngineEvent result{time, severity, {}};
  std::snprintf(result.text.data(), result.text.size(), "%s: %s", names_[camera].c_str(), text);
  return result;
}

EngineEvent Announcer::ordered(TimeNs time, const CalibrationOrder& order, const char* refusal) const {
  const auto camera = static_cast<std::size_t>(order.camera.index());
  if (order.kind == CalibrationOrderKind::kRefine) {
    if (refusal == nullptr) return event(time, Severity::kInfo, "Refinement of all cameras begins");
    std::array<char, 112> why{};
    std::snprintf(why.data(), why.size(), "Refinement refused: %s", refusal);
    return event(time, Severity::kCaution, why.data());
  }
  std::array<char, 96> text{};
  if (refusal == nullptr && order.balls_off_m > kTellBallsM) {
    std::array<char, 16> by{};
    std::snprintf(by.data(), by.size(), "%.1f mm", 1e3 * order.balls_off_m);
    std::snprintf(text.data(), text.size(),
                  "placed by the loaded calibration, but its balls are not used, off by up to: %s",
                  by.data());
    return event(time, Severity::kCaution, camera, text.data());
  }
  if (refusal == nullptr) return event(time, Severity::kInfo, camera, calibrationText(order.kind));
  std::snprintf(text.data(), text.size(), "order refused: %s", refusal);
  return event(time, Severity::kCaution, camera, text.data());
}

void Announcer::announce(const EngineSnapshot& now, bool gave_up, const Sink& raise) {
  if (now.pose_known && !had_pose_) {
    had_pose_ = true;
    raise(event(now.time, Severity::kGood, "Helicopter found"));
  }
  if (now.refusal != nullptr) {
    std::array<char, 112> text{};
    std::snprintf(text.data(), text.size(), "Take-off refused: %s", now.refusal);
    raise(event(now.time, Severity::kCaution, text.data()));
  }
  if (gave_up && !gave_up_) {
    gave_up_ = true;
    raise(event(now.time, Severity::kDanger, "Output fell back to rotors off: the flight thread was silent"));
  }
  for (std::size_t i = 0; i < names_.size(); ++i) announceCamera(now, i, raise);
  announceRefinement(now, raise);
  announceRecord(now, raise);
  if (now.cameras_disagree && !disagreed_)
    raise(event(now.time, Severity::kDanger, "Two cameras disagree: one was moved, and which one is not known"));
  disagreed_ = now.cameras_disagree;
  if (now.cables_changed != cables_changed_)
    raise(event(now.time, Severity::kCaution, "Two cameras have changed cables: each is taken for the other one now"));
  cables_changed_ = now.cables_changed;
  if (now.cold_start != nullptr && now.cold_start != cold_start_)
    raise(event(now.time, Severity::kInfo, now.cold_start));
  cold_start_ = now.cold_start;
  if (now.gust_ordered && !gust_blew_) raise(event(now.time, Severity::kInfo, "A gust"));
  gust_blew_ = now.gust_ordered;
  announceChanges(now, raise);
  if (now.phase != phase_) raise(event(now.time, Severity::kInfo, phaseText(now.phase)));
  announceArming(now, raise);
  announceSafety(now, raise);
  phase_ = now.phase;
}

void Announcer::announceArming(const EngineSnapshot& now, const Sink& raise) {
  if (now.armed && !armed_) raise(event(now.time, Severity::kCaution, "Armed: the rotors may turn"));
  if (!now.armed && armed_) raise(event(now.time, Severity::kInfo, "Disarmed"));
  armed_ = now.armed;
  if (now.holding != holding_)
    raise(event(now.time, Severity::kInfo, now.holding ? "Holds where it is" : "Hold ended"));
  holding_ = now.holding;
  for (std::uint32_t bits = now.arm_refused; bits != 0; bits &= bits - 1) {
    std::array<char, 112> text{};
    std::snprintf(text.data(), text.size(), "Not armed: %s",
                  toString(static_cast<PreArmCheck>(bits & (~bits + 1))));
    raise(event(now.time, Severity::kCaution, text.data()));
  }
}

void Announcer::announceSafety(const EngineSnapshot& now, const Sink& raise) {
  for (std::uint32_t bits = now.alarms & ~alarms_; bits != 0; bits &= bits - 1) {
    const auto index = static_cast<std::size_t>(std::countr_zero(bits));
    const SafetyRule& rule = safetyRules()[index];
    const bool only_warns = rule.demands == SafetyState::kNormal;
    if (only_warns && now.time - warned_at_[index] < kRepeat) continue;
    warned_at_[index] = now.time;
    raise(event(now.time, severityOf(rule.demands), messageOf(rule.failsafe)));
  }
  if (now.safety == SafetyState::kNormal && safety_ > SafetyState::kLandNow)
    raise(event(now.time, Severity::kGood, "Pose regained"));
  if (now.safety == SafetyState::kCut && safety_ != SafetyState::kCut)
    raise(event(now.time, Severity::kDanger, "Rotors cut, latched"));
  alarms_ = now.alarms;
  safety_ = now.safety;
}

void Announcer::announceRefinement(const EngineSnapshot& now, const Sink& raise) {
  const RefinementReport& report = now.refinement;
  if (report.ended == refinements_) return;
  refinements_ = report.ended;
  std::array<char, 112> text{};
  std::array<char, 32> by{};
  switch (report.outcome) {
    case RefinementOutcome::kNone:
      return;
    case RefinementOutcome::kCameras:
      return raise(event(now.time, Severity::kGood, "Refined: cameras stand where all of them together say"));
    case RefinementOutcome::kCorrected:
      std::snprintf(by.data(), by.size(), "%.1f mm, %.2f %%", 1e3 * report.balls_off_m, 1e2 * report.focal_off);
      std::snprintf(text.data(), text.size(), "Flown on with corrected balls and focal lengths, off the rig's by up to: %s",
                    by.data());
      return raise(event(now.time, Severity::kGood, text.data()));
    case RefinementOutcome::kKept:
      if (report.balls_hardly_seen == 0)
        return raise(
            event(now.time, Severity::kGood, "Refined: images ask for no other balls and focal lengths"));
      std::snprintf(text.data(), text.size(),
                    "Balls stay; not judged, for they hardly ever lay where the pose says: %s",
                    std::to_string(report.balls_hardly_seen).c_str());
      return raise(event(now.time, Severity::kCaution, text.data()));
    case RefinementOutcome::kUnsound:
      return raise(event(now.time, Severity::kCaution,
                         "Balls and focal lengths stay: none that marker_sigma_m and focal_sigma allow fit "
                         "the images"));
    case RefinementOutcome::kTooFar:
      return raise(event(now.time, Severity::kCaution,
                         "Balls and focal lengths stay: by those found the pose would jump too far to fly on"));
    case RefinementOutcome::kNoAnswer:
      return raise(event(now.time, Severity::kCaution,
                         "Refinement without an answer: the images do not fit together; nothing is changed"));
    case RefinementOutcome::kCamerasTooFar:
      return raise(event(now.time, Severity::kCaution,
                         "Nothing is changed: by the refined cameras the pose would jump too far to fly on"));
    case RefinementOutcome::kOvertaken:
      return raise(event(now.time, Severity::kCaution,
                         "Refinement broken off: a camera was moved, frozen or placed meanwhile; nothing was "
                         "changed. Ask again"));
  }
}

void Announcer::announceRecord(const EngineSnapshot& now, const Sink& raise) {
  if (now.devices.record.cut_off && !record_.cut_off)
    raise(event(now.time, Severity::kDanger,
                "The disk refuses the record: the flight goes on without one; see the log"));
  // Once: how much is lost, the counter tells.
  if (now.devices.record.lost > 0 && record_.lost == 0)
    raise(event(now.time, Severity::kCaution, "The disk is too slow: the record of this flight has gaps"));
  if (now.devices.record.lost_images > 0 && record_.lost_images == 0)
    raise(event(now.time, Severity::kCaution, "The disk is too slow: images are missing in the record"));
  record_ = now.devices.record;
}

void Announcer::announceLink(const EngineSnapshot& now, std::size_t camera, const Sink& raise) const {
  const CameraSnapshot& state = now.cameras[camera];
  if (recordings_[camera]) {
    if (state.link == LinkState::kLost) raise(event(now.time, Severity::kInfo, camera, "its recording has ended"));
    if (state.link == LinkState::kStalled)
      raise(event(now.time, Severity::kDanger, camera, "its recording is damaged: see the log"));
    return;
  }
  switch (state.link) {
    case LinkState::kStalled:
      return raise(event(now.time, Severity::kCaution, camera, "sends no frame any more, looked for again"));
    case LinkState::kTaken:
      return raise(event(now.time, Severity::kCaution, camera, "controlled by another host"));
    case LinkState::kLost:
      return raise(event(now.time, Severity::kCaution, camera, "does not answer: cable or power?"));
    case LinkState::kStreaming:
      if (state.returns > 0) raise(event(now.time, Severity::kGood, camera, "is back, with its settings"));
      return;
    case LinkState::kOpening:
    case LinkState::kAlways:
      return;
  }
}

void Announcer::announceChanges(const EngineSnapshot& now, const Sink& raise) {
  const Changes changes{now.plans, now.controls, now.colours, now.cameras[0].backgrounds};
  const auto raise_if = [&](bool changed, const char* text) {
    if (changed) raise(event(now.time, Severity::kInfo, text));
  };
  raise_if(changes.plans != changes_.plans, "The plan is changed");
  raise_if(changes.controls != changes_.controls, "Gains and trims are changed");
  raise_if(changes.colours != changes_.colours, "The markers' colour is changed");
  raise_if(changes.backgrounds != changes_.backgrounds, "The cameras take a new background");
  changes_ = changes;
}

void Announcer::announceCamera(const EngineSnapshot& now, std::size_t camera, const Sink& raise) {
  const CameraSnapshot& state = now.cameras[camera];
  Camera& before = cameras_[camera];
  const auto raise_if = [&](bool changed, Severity severity, const char* text) {
    if (changed) raise(event(now.time, severity, camera, text));
  };
  raise_if(state.hidden && !before.hidden, Severity::kCaution, "hidden by the operator");
  raise_if(!state.hidden && before.hidden, Severity::kInfo, "shown again");
  raise_if(state.boards > before.boards, Severity::kCaution, "a white board is held before it");
  raise_if(state.boards < before.boards, Severity::kInfo, "a white board is taken away");
  raise_if(state.lost_share > before.lost_share, Severity::kCaution, "loses frames by order");
  raise_if(state.lost_share < before.lost_share, Severity::kInfo, "loses fewer frames by order");
  raise_if(state.noise > before.noise, Severity::kCaution, "gets noise by order");
  raise_if(state.noise < before.noise, Severity::kInfo, "gets less noise by order");
  raise_if(state.knocks != before.knocks, Severity::kCaution, "knocked by the operator");
  const CameraStatus status = state.estimate.status;
  if (status != before.status && now.tick > 1) {
    raise_if(status == CameraStatus::kCalibrated, Severity::kGood, "calibrated, in the control set");
    raise_if(status == CameraStatus::kRejected, Severity::kCaution, "disagrees, out of the control set");
    raise_if(status == CameraStatus::kCalibrating && before.status == CameraStatus::kCalibrated,
             Severity::kCaution, "out of the control set, calibrating");
  }
  if (state.link != before.link) announceLink(now, camera, raise);
  before = {status, state.hidden, state.boards, state.knocks, state.link, state.lost_share, state.noise};
}

}  // namespace helical
