#pragma once

#include <memory>

#include "engine/transmitter/transmitter.h"
#include "engine/transmitter/usb_device.h"

namespace helical {

/// A transmitter that is a USB device, and may come and go: what is missing is looked for every half second, what
/// comes back is set up anew. It says in its status what is wrong and never throws; that nothing spins up by itself
/// when a device comes back is OutputGuard's work. One thread.
class UsbTransmitter : public Transmitter {
 public:
  void send(const StickDemand& demand, TimeNs now) final;
  void beat(bool level) final { level_ = level; }
  TransmitterStatus status() const final { return status_; }

 protected:
  /// The trainer switch, as the device has just seen it.
  void tellPilotFlies(bool flies) { status_.pilot_flies = flies; }

  explicit UsbTransmitter(UsbWanted wanted);

  /// Sets up a device that was just opened; its outputs are at rest after it.
  virtual TransmitterTrouble begin(UsbDevice& device) = 0;
  /// `level`: of the heartbeat, which must not be seen to change unless the demand has gone out.
  virtual TransmitterTrouble transmit(UsbDevice& device, const StickDemand& demand, TimeNs now, bool level) = 0;

 private:
  void tryToOpen(TimeNs now);

  UsbWanted wanted_;
  std::unique_ptr<UsbDevice> device_;
  TimeNs next_try_ = 0;
  bool level_ = false;
  TransmitterStatus status_;
};

}  // namespace helical
