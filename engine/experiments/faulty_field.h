#pragma once

#include <memory>
#include <vector>

#include "engine/base/clock.h"
#include "engine/experiments/fault_plan.h"
#include "engine/experiments/faulty_devices.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {

/// The rig of a seed with its simulated devices, on a clock of its own, and the faults that happen to them. One thread.
class FaultyField {
 public:
  /// Without images.
  FaultyField(const RigConfig& rig, std::uint64_t seed, std::vector<Fault> faults);

  const RigConfig& rig() const { return rig_; }
  TimeNs now() const { return clock_->now(); }
  double tickPeriod() const { return 1.0 / rig_.control.rate_hz; }

  /// One millisecond on, with the gusts and knocks that begin in it.
  void advance();
  std::vector<std::unique_ptr<ObservationSource>>& sources() { return hardware_.sources; }
  OutputLoop& output() { return output_; }
  /// As the flight thread is told; the record's are those of the faults.
  DeviceStatus devices();
  /// What the helicopter is told: its rotors are powered.
  bool powered() const;
  const RigHardware& hardware() const { return hardware_; }
  /// The true place over the pad, and how far it is outside the hard fence [m].
  double beyondHardFence(const HelicopterState& truth) const;
  /// How late the next tick is because the processor has other things to do; 0: it is not.
  TimeNs starvation() const;

 private:
  RigConfig rig_;
  std::vector<Fault> faults_;
  std::shared_ptr<ManualClock> clock_;
  RigHardware hardware_;
  FaultyTransmitter* transmitter_;  ///< hardware_'s
  OutputLoop output_;
  double before_s_ = 0.0;
};

}  // namespace helical
