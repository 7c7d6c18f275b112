#pragma once

#include <sys/types.h>

#include <filesystem>

#include "engine/transmitter/shared_output.h"
#include "engine/transmitter/transmitter.h"

namespace helical {

/// A transmitter in a process of its own (program helical-output), which outlives a ground station that is
/// killed or hangs, and then brings the sticks to rest by itself. Here is the ground station's side: demands
/// go out through shared memory, reports come back, and a process that died is an alarm at once and started
/// again - locked, see OutputGuard: its rotors stay at rest until the ground station, too, has them at rest.
/// One thread.
class OutputProcess final : public Transmitter {
 public:
  /// Starts the program. Throws Error(kSystem) when it cannot be started.
  OutputProcess(const OutputSettings& settings, std::filesystem::path program);
  /// Brings the sticks to rest and ends the program.
  ~OutputProcess() override;
  OutputProcess(const OutputProcess&) = delete;
  OutputProcess& operator=(const OutputProcess&) = delete;

  void send(const StickDemand& demand, TimeNs now) override;
  TransmitterStatus status() const override { return status_; }

  /// The newest report; of a process that has not begun, the default.
  const OutputReport& report() const { return report_; }
  pid_t pid() const { return pid_; }
  int restarts() const { return restarts_; }

  /// Where the program is: beside this one, or as the build has it. Throws Error(kSystem) when it is missing.
  static std::filesystem::path findProgram();

 private:
  void start();
  bool hasDied();
  void restartInTime(TimeNs now);

  SharedOutputMapping shared_;
  std::filesystem::path program_;
  pid_t pid_ = -1;
  std::uint64_t sequence_ = 0;
  TimeNs died_at_ = 0;
  TimeNs started_at_ = 0;
  int restarts_ = 0;
  OutputReport report_;
  TransmitterStatus status_;
};

}  // namespace helical
