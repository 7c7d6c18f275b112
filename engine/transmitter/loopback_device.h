#pragma once

#include <string>

#include "engine/transmitter/transmitter.h"

namespace helical {

/// A transmitter that is none: it writes down what it puts out, a line each
/// `time_ns upper_rotor lower_rotor roll pitch heartbeat`. One thread.
class LoopbackDevice final : public Transmitter {
 public:
  /// Appends to `log`; an empty name logs nothing. Throws Error(kDevice).
  explicit LoopbackDevice(const std::string& log);
  ~LoopbackDevice() override;
  LoopbackDevice(const LoopbackDevice&) = delete;
  LoopbackDevice& operator=(const LoopbackDevice&) = delete;

  void send(const StickDemand& demand, TimeNs now) override;
  void beat(bool level) override { level_ = level; }
  TransmitterStatus status() const override { return status_; }

 private:
  int file_ = -1;
  bool level_ = false;
  TransmitterStatus status_;
};

}  // namespace helical
