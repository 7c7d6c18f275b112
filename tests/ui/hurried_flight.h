#pragma once

#include <deque>
#include <vector>

#include "engine/pipeline/flight_view.h"
#include "engine/pipeline/lock_step.h"

namespace helical {

/// A simulated flight that goes on by so many control ticks each time the window looks: minutes of it in seconds.
/// Its pictures are noise with the observations of none.
class HurriedFlight final : public FlightView {
 public:
  HurriedFlight(const RigConfig& rig, const FlightPlan& plan, int ticks_a_poll);

  const RigConfig& rig() const override { return rig_; }
  const FlightPlan& plan() const override { return plan_; }
  bool poll() override;
  const EngineSnapshot& snapshot() const override { return snapshot_; }
  bool pollPicture(CameraId camera) override;
  const CameraPicture& picture(CameraId camera) const override;
  bool pollCalibration(CameraId) override { return true; }
  const CalibrationView& calibration(CameraId) const override { return belief_; }
  bool nextTick(EngineSnapshot& tick) override;
  bool nextEvent(EngineEvent& event) override;
  std::uint64_t lostTicks() const override { return 0; }

 private:
  RigConfig rig_;
  FlightPlan plan_;
  int ticks_a_poll_;
  LockStep flight_;
  Announcer announcer_;
  OperatorCommands commands_;
  EngineSnapshot snapshot_;
  CalibrationView belief_;
  std::deque<EngineSnapshot> ticks_;
  std::deque<EngineEvent> events_;
  std::vector<CameraPicture> pictures_;
};

}  // namespace helical
