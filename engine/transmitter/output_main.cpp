#include "engine/transmitter/output_main.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "engine/transmitter/output_device.h"
#include "engine/transmitter/output_guard.h"
#include "engine/transmitter/shared_output.h"

namespace helical {
namespace {

constexpr TimeNs kRestBeforeEnd = 200 * kNanosecondsPerMillisecond;

volatile sig_atomic_t terminated = 0;

/// What ends other programs must not leave sticks where they are: a request to end lets the demands grow old.
void ignoreSignals() {
  for (const int number : {SIGINT, SIGHUP, SIGPIPE, SIGQUIT, SIGUSR1, SIGUSR2}) signal(number, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = [](int) { terminated = 1; };
  sigaction(SIGTERM, &action, nullptr);
}

void sleepUntil(TimeNs time) {
  const timespec until{time / kNanosecondsPerSecond, time % kNanosecondsPerSecond};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

class Output {
 public:
  explicit Output(int descriptor)
      : shared_(descriptor),
        settings_(shared_->settings),
        device_(openOutputDevice(settings_)),
        guard_(settings_.guard),
        ground_station_(getppid()) {}

  /// False once it is done.
  bool step() {
    DemandMessage message;
    if (terminated == 0 && shared_->demand.read(message)) newest_ = message;
    const TimeNs now = systemTime();
    // A ground station that leaves does so with its rotors at rest; if not, they are ramped down as ever.
    const StickDemand output = guard_.step(newest_.demand, newest_.quit ? 0 : newest_.time, now);
    beat_ = !beat_;
    device_->beat(beat_);
    device_->send(settings_.bench ? StickDemand{} : output, now);
    watchDevice(now);
    report(output, now);
    if (output != StickDemand{}) rests_since_ = -1;
    if (output == StickDemand{} && rests_since_ < 0) rests_since_ = now;
    const bool alone = newest_.quit || terminated != 0 || getppid() != ground_station_;
    return !alone || rests_since_ < 0 || now - rests_since_ < kRestBeforeEnd;
  }

  TimeNs period() const { return fromSeconds(1.0 / std::clamp(settings_.rate_hz, 10.0, 1000.0)); }

 private:
  /// A device that was away, or that has not taken a demand for as long as the rotors stay as they were without one:
  /// whatever comes back, comes back at rest. One that answers sooner still has what holds the helicopter, and lands it.
  void watchDevice(TimeNs now) {
    const TransmitterStatus status = device_->status();
    if (!status.fault) well_at_ = now;
    const double answers_by = settings_.guard.silent_s + settings_.guard.hold_s;
    if (!status.present || toSeconds(now - well_at_) > answers_by) guard_.lock();
    if (status.trouble == told_) return;
    told_ = status.trouble;
    if (told_ == TransmitterTrouble::kNone)
      std::fputs("helical-output: the transmitter's device is well\n", stderr);
    else
      std::fprintf(stderr, "helical-output: %s; %s\n", toString(told_), cureOf(told_));
  }

  void report(const StickDemand& output, TimeNs now) {
    OutputReport report;
    report.sequence = ++reports_;
    report.time = now;
    report.output = settings_.bench ? StickDemand{} : output;
    report.status = device_->status();
    report.status.bench = settings_.bench;
    const bool usb = std::string_view(settings_.device.data()) != "loopback";
    report.status.channels_calibrated = !usb || (settings_.channels.count > 0 && settings_.directions_checked);
    report.locked = guard_.locked();
    shared_->report.write(report);
  }

  SharedOutputMapping shared_;
  OutputSettings settings_;
  std::unique_ptr<Transmitter> device_;
  OutputGuard guard_;
  pid_t ground_station_;
  DemandMessage newest_;
  bool beat_ = false;
  std::uint64_t reports_ = 0;
  TimeNs well_at_ = 0;
  TransmitterTrouble told_ = TransmitterTrouble::kNone;
  TimeNs rests_since_ = -1;
};

}  // namespace

void runOutput(int descriptor) {
  ignoreSignals();
  Output output(descriptor);
  TimeNs next = systemTime();
  while (output.step()) {
    next = std::max(next + output.period(), systemTime());
    sleepUntil(next);
  }
}

}  // namespace helical
