#pragma once

#include <array>
#include <string>
#include <string_view>

#include "engine/transmitter/output_channel.h"
#include "engine/transmitter/output_guard.h"
#include "engine/transmitter/radio_options.h"

namespace helical {

struct OutputSettings;

/// The transmitter that a rig names.
struct TransmitterOptions {
  /// "simulated"; "output-process": the simulated one behind the output process; "mcc-usb-3100", "crazyradio": a USB
  /// device behind it; "loopback": the helicopter of `helical serve`; "none": a rig that only looks on.
  std::string kind = "simulated";
  /// Of a USB device its serial number, or nothing; of the output process the file that it writes its output down in.
  std::string device;
  std::string address = "127.0.0.1:5391";  ///< of the loopback: where `helical serve` listens
  double rate_hz = 100.0;                  ///< of the output process
  OutputGuardOptions guard;
  OutputChannels channels;  ///< of a USB device; none: nobody has calibrated them
  /// Fingerprint of the channels whose directions somebody has looked at; see directionsChecked().
  std::string directions_checked;
  bool bench = false;  ///< everything runs, and nothing but rest leaves
  int trainer_input = -1;  ///< of an analogue output: the digital input of the trainer switch; negative: none
  RadioOptions radio;
};

/// What `kind` may be.
std::array<std::string_view, 6> transmitterKinds();
bool isUsb(const TransmitterOptions& options);

/// A fingerprint as it stands in a rig file.
std::string fingerprintText(const OutputChannels& channels);
/// Whether the channels are those that somebody has looked at.
bool directionsChecked(const TransmitterOptions& options);

/// What the output process is to do. Throws Error(kInput) for texts that are too long for it.
OutputSettings outputSettings(const TransmitterOptions& options);

/// Throws Error(kInput) naming the offending key.
void validate(const TransmitterOptions& options);

}  // namespace helical
