#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/ids.h"
#include "engine/config/rig_config.h"
#include "engine/pipeline/calibration_order.h"
#include "engine/pipeline/snapshot.h"

namespace helical {

/// Tells what has changed from one control tick to the next in an operator's words. One thread; allocates at
/// construction only.
class Announcer {
 public:
  using Sink = std::function<void(const EngineEvent&)>;

  explicit Announcer(const RigConfig& rig);

  /// `gave_up`: the output fell back to rotors off because nobody told it anything.
  void announce(const EngineSnapshot& now, bool gave_up, const Sink& raise);

  static EngineEvent event(TimeNs time, Severity severity, const char* text);
  /// "NAME: text".
  EngineEvent event(TimeNs time, Severity severity, std::size_t camera, const char* text) const;
  /// What came of an order; `refusal` says why nothing, or null.
  EngineEvent ordered(TimeNs time, const CalibrationOrder& order, const char* refusal) const;

 private:
  /// What of a camera is announced when it changes.
  struct Camera {
    CameraStatus status = CameraStatus::kUncalibrated;
    bool hidden = false;
    int boards = 0;
    std::uint32_t knocks = 0;
    LinkState link = LinkState::kAlways;
    double lost_share = 0.0;
    double noise = 0.0;
  };
  struct Changes {
    std::uint32_t plans = 0;
    std::uint32_t controls = 0;
    std::uint32_t colours = 0;
    std::uint32_t backgrounds = 0;
  };
  void announceRefinement(const EngineSnapshot& now, const Sink& raise);
  void announceRecord(const EngineSnapshot& now, const Sink& raise);
  void announceArming(const EngineSnapshot& now, const Sink& raise);
  void announceSafety(const EngineSnapshot& now, const Sink& raise);
  void announceLink(const EngineSnapshot& now, std::size_t camera, const Sink& raise) const;
  void announceChanges(const EngineSnapshot& now, const Sink& raise);
  void announceCamera(const EngineSnapshot& now, std::size_t camera, const Sink& raise);

  std::vector<std::string> names_;
  std::vector<bool> recordings_;  ///< cameras that are files
  FlightPhase phase_ = FlightPhase::kIdle;
  SafetyState safety_ = SafetyState::kNormal;
  std::uint32_t alarms_ = 0;
  std::array<TimeNs, kFailsafeCount> warned_at_;
  bool armed_ = false;
  bool holding_ = false;
  bool had_pose_ = false;
  bool gave_up_ = false;
  bool gust_blew_ = false;
  bool disagreed_ = false;
  std::uint32_t cables_changed_ = 0;
  std::uint32_t refinements_ = 0;
  const char* cold_start_ = nullptr;
  RecordHealth record_;
  std::array<Camera, kMaxCameras> cameras_{};
  Changes changes_;
};

}  // namespace helical
