#pragma once

#include <umockdev.h>

#include <memory>

#include "engine/transmitter/output_channel.h"
#include "tests/transmitter/emulated_port.h"

namespace helical {

/// A USB bus of our own, in place of the machine's. Make it before anything opens a device.
class EmulatedBus {
 public:
  EmulatedBus() : bed_(umockdev_testbed_new()) {}
  ~EmulatedBus() { g_object_unref(bed_); }
  EmulatedBus(const EmulatedBus&) = delete;
  EmulatedBus& operator=(const EmulatedBus&) = delete;

  std::unique_ptr<EmulatedPort> plug(int address, std::shared_ptr<EmulatedDevice> device,
                                     EmulatedPort::Access access = EmulatedPort::Access::kFree) {
    return std::make_unique<EmulatedPort>(bed_, address, std::move(device), access);
  }

 private:
  UMockdevTestbed* bed_;
};

/// Into a hobby transmitter: rotors from 0.3 V, the swash plate around 2.5 V, on outputs out of order.
inline OutputChannels voltageChannels() {
  OutputChannels channels;
  channels.count = 4;
  channels.all[0] = {StickAxis::kUpperRotor, 2, 0.3, 2.4, 4.7, 0.0, false, 0.0};
  channels.all[1] = {StickAxis::kLowerRotor, 0, 0.2, 2.5, 4.8, 0.0, false, 0.0};
  channels.all[2] = {StickAxis::kRoll, 3, 0.5, 2.5, 4.5, 0.1, true, 0.0};
  channels.all[3] = {StickAxis::kPitch, 1, -4.0, 0.5, 4.0, 0.0, false, 0.0};
  return channels;
}

/// Degrees, degrees a second, thrust.
inline OutputChannels radioChannels() {
  OutputChannels channels;
  channels.count = 4;
  channels.all[0] = {StickAxis::kThrottle, 0, 0.0, 30000.0, 60000.0, 0.0, false, 0.0};
  channels.all[1] = {StickAxis::kYaw, 1, -200.0, 0.0, 200.0, 0.0, false, 0.0};
  channels.all[2] = {StickAxis::kRoll, 2, -20.0, 0.0, 20.0, 0.0, false, 0.0};
  channels.all[3] = {StickAxis::kPitch, 3, -20.0, 0.0, 20.0, 0.0, false, 0.0};
  return channels;
}

}  // namespace helical
