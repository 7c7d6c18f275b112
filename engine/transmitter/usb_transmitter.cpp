#include "engine/transmitter/usb_transmitter.h"

#include <utility>

namespace helical {
namespace {

constexpr TimeNs kTryAgainAfter = 500 * kNanosecondsPerMillisecond;

}  // namespace

UsbTransmitter::UsbTransmitter(UsbWanted wanted) : wanted_(std::move(wanted)) {
  status_.present = status_.self_test_passed = false;
}

void UsbTransmitter::tryToOpen(TimeNs now) {
  if (now < next_try_) return;
  next_try_ = now + kTryAgainAfter;
  UsbDevice::Opening opening = UsbDevice::open(wanted_);
  status_.trouble = opening.trouble;
  if (!opening.device) return;
  status_.trouble = begin(*opening.device);
  if (status_.trouble == TransmitterTrouble::kNone) device_ = std::move(opening.device);
}

void UsbTransmitter::send(const StickDemand& demand, TimeNs now) {
  if (!device_) tryToOpen(now);
  if (device_) {
    status_.trouble = transmit(*device_, demand, now, level_);
    if (status_.trouble == TransmitterTrouble::kAbsent) {
      device_.reset();
      next_try_ = now + kTryAgainAfter;
    }
  }
  status_.present = status_.self_test_passed = device_ != nullptr;
  status_.fault = status_.trouble != TransmitterTrouble::kNone;
}

}  // namespace helical
