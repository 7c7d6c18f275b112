#include "engine/transmitter/transmitter_options.h"

#include <algorithm>
#include <cstdio>

#include "engine/base/error.h"
#include "engine/transmitter/crazyradio.h"
#include "engine/transmitter/mcc_analog_output.h"
#include "engine/transmitter/output_device.h"
#include "engine/transmitter/shared_output.h"

namespace helical {
namespace {

template <std::size_t N>
void copyText(const std::string& from, std::array<char, N>& to) {
  if (from.size() >= N)
    throw Error(ErrorKind::kInput, "device '" + from + "' is too long for the output process", {}, "give a shorter one");
  std::copy(from.begin(), from.end(), to.begin());
}

}  // namespace

std::array<std::string_view, 6> transmitterKinds() {
  return {"simulated", "output-process", kMccDevice, kCrazyradioDevice, "loopback", "none"};
}

bool isUsb(const TransmitterOptions& options) {
  return options.kind == kMccDevice || options.kind == kCrazyradioDevice;
}

std::string fingerprintText(const OutputChannels& channels) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(fingerprintOf(channels)));
  return text;
}

bool directionsChecked(const TransmitterOptions& options) {
  return options.channels.count > 0 && options.directions_checked == fingerprintText(options.channels);
}

OutputSettings outputSettings(const TransmitterOptions& options) {
  OutputSettings settings;
  copyText(isUsb(options) ? options.kind : "loopback", settings.device);
  copyText(options.device, settings.address);
  settings.rate_hz = options.rate_hz;
  settings.guard = options.guard;
  settings.channels = options.channels;
  settings.directions_checked = directionsChecked(options);
  settings.bench = options.bench;
  settings.trainer_input = options.kind == kMccDevice ? options.trainer_input : -1;
  settings.radio = options.radio;
  return settings;
}

void validate(const TransmitterOptions& options) {
  validate(options.guard);
  validate(options.radio);
  if (isUsb(options)) validate(options.channels, options.kind == kMccDevice ? kMccLimits : kCrazyradioLimits);
  if (options.channels.count > 0 && !isUsb(options))
    throw Error(ErrorKind::kInput, "channels are of USB devices, and kind is '" + options.kind + "'", {},
                "remove [[transmitter.channel]], or name a USB device");
  if (options.trainer_input >= 0 && options.kind != kMccDevice)
    throw Error(ErrorKind::kInput, "trainer_input is of MCC devices, and kind is '" + options.kind + "'", {},
                "remove it: what has no digital input knows of no trainer switch");
  if (!(options.rate_hz >= 50.0 && options.rate_hz <= 500.0))
    throw Error(ErrorKind::kInput, "rate_hz is " + std::to_string(options.rate_hz), {}, "give 50 to 500 Hz");
}

}  // namespace helical
