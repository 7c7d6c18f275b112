#pragma once

#include "engine/transmitter/output_process.h"
#include "engine/transmitter/transmitter_options.h"

namespace helical {

/// One stick out of rest, and what the operator has to see then.
struct DirectionStep {
  StickAxis axis;
  StickDemand demand;
  const char* question;
};
DirectionStep directionStep(StickAxis axis);

/// Sticks that stay where they were put, through the output process as in flight, for an operator who looks which way
/// they go; motors off. Back at rest and the process ended when it goes. One thread.
class HeldSticks {
 public:
  /// Waits until the device answers, 3 seconds at most. Throws Error(kDevice) when it is missing.
  explicit HeldSticks(const TransmitterOptions& options);

  /// Again and again, every few hundredths of a second: a demand that is not renewed goes back to rest. Throws
  /// Error(kDevice) when the device is lost.
  void hold(const StickDemand& demand);

 private:
  [[noreturn]] void lose() const;

  OutputProcess output_;
};

}  // namespace helical
