#include "engine/pipeline/announcer.h"

#include <cstdio>

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

struct SafetyText {
  Severity severity;
  const char* text;
};

SafetyText safetyText(SafetyState state) {
  switch (state) {
    case SafetyState::kNormal:
      return {Severity::kGood, "Pose regained"};
    case SafetyState::kCoasting:
      return {Severity::kCaution, "No pose: coasting on trim"};
    case SafetyState::kDescending:
      return {Severity::kDanger, "No pose for 0.5 s: open-loop descent"};
    case SafetyState::kLandNow:
      return {Severity::kDanger, "Failsafe: lands where it is"};
    case SafetyState::kCut:
      return {Severity::kDanger, "Rotors cut, latched"};
  }
  return {Severity::kInfo, ""};
}

}  // namespace

Announcer::Announcer(const RigConfig& rig) {
  for (const auto& camera : rig.cameras) names_.push_back(camera.name);
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
  announceRecord(now, raise);
  if (now.gust_ordered && !gust_blew_) raise(event(now.time, Severity::kInfo, "A gust"));
  gust_blew_ = now.gust_ordered;
  announceChanges(now, raise);
  if (now.phase != phase_) raise(event(now.time, Severity::kInfo, phaseText(now.phase)));
  if (now.safety != safety_) {
    const SafetyText text = safetyText(now.safety);
    raise(event(now.time, text.severity, text.text));
  }
  phase_ = now.phase;
  safety_ = now.safety;
}

void Announcer::announceRecord(const EngineSnapshot& now, const Sink& raise) {
  if (now.record.cut_off && !record_.cut_off)
    raise(event(now.time, Severity::kDanger,
                "The disk refuses the record: the flight goes on without one; see the log"));
  // Once: how much is lost, the counter tells.
  if (now.record.lost > 0 && record_.lost == 0)
    raise(event(now.time, Severity::kCaution, "The disk is too slow: the record of this flight has gaps"));
  if (now.record.lost_images > 0 && record_.lost_images == 0)
    raise(event(now.time, Severity::kCaution, "The disk is too slow: images are missing in the record"));
  record_ = now.record;
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
  before = {status, state.hidden, state.boards, state.knocks, state.lost_share, state.noise};
}

}  // namespace helical
