#pragma once

#include <array>
#include <cstdint>

#include "engine/base/time.h"
#include "engine/helicopter/stick_demand.h"
#include "engine/transmitter/output_channel.h"
#include "engine/transmitter/output_guard.h"
#include "engine/transmitter/radio_options.h"
#include "engine/transmitter/seqlock.h"
#include "engine/transmitter/transmitter_status.h"

namespace helical {

/// What the output process is to do; written before it starts.
struct OutputSettings {
  std::array<char, 32> device{};    ///< "loopback", "mcc-usb-3100", "crazyradio"
  std::array<char, 512> address{};  ///< its serial number, or nothing; of the loopback the file that it logs to
  OutputChannels channels;          ///< of a USB device
  bool directions_checked = false;  ///< somebody has seen which way each of the channels goes
  bool bench = false;               ///< nothing but rest goes to the device
  int trainer_input = -1;           ///< digital input of the trainer switch; negative: none
  RadioOptions radio;
  double rate_hz = 100.0;
  OutputGuardOptions guard;
};

/// From the ground station. Times are CLOCK_MONOTONIC.
struct DemandMessage {
  std::uint64_t sequence = 0;
  TimeNs time = 0;
  StickDemand demand;
  bool quit = false;  ///< nothing comes any more: rest, then end
};

/// From the output process.
struct OutputReport {
  std::uint64_t sequence = 0;
  TimeNs time = 0;
  StickDemand output;  ///< what went to the device
  TransmitterStatus status;
  bool locked = true;  ///< see OutputGuard
};

/// The memory that ground station and output process share.
struct SharedOutput {
  static constexpr std::uint32_t kVersion = 2;

  std::uint32_t version = kVersion;
  OutputSettings settings;
  alignas(64) Seqlock<DemandMessage> demand;
  alignas(64) Seqlock<OutputReport> report;
};

/// CLOCK_MONOTONIC, which all processes agree about.
TimeNs systemTime();

/// The shared memory behind a file descriptor, mapped for as long as this lives.
class SharedOutputMapping {
 public:
  /// Makes new memory. Throws Error(kSystem).
  SharedOutputMapping();
  /// Maps what another process made. Throws Error(kInput) for anything else.
  explicit SharedOutputMapping(int descriptor);
  ~SharedOutputMapping();
  SharedOutputMapping(const SharedOutputMapping&) = delete;
  SharedOutputMapping& operator=(const SharedOutputMapping&) = delete;

  SharedOutput& operator*() const { return *shared_; }
  SharedOutput* operator->() const { return shared_; }
  int descriptor() const { return descriptor_; }

 private:
  void map();

  int descriptor_;
  SharedOutput* shared_ = nullptr;
};

}  // namespace helical
