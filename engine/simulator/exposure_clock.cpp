#include "engine/simulator/exposure_clock.h"

namespace helical {
namespace {

constexpr double kReadoutJitter = 0.001;  // s
constexpr int kBufferedFrames = 3;

}  // namespace

ExposureClock::ExposureClock(const SimulationOptions& options, Random random)
    : random_(random), readout_s_(options.readout_delay_s) {
  period_s_ = (1.0 + options.rate_error * random_.uniform(-1.0, 1.0)) / options.camera_rate_hz;
  phase_s_ = random_.uniform(0.0, period_s_);
  schedule();
}

void ExposureClock::schedule() {
  exposure_ = fromSeconds(phase_s_ + period_s_ * static_cast<double>(sequence_));
  arrival_ = exposure_ + fromSeconds(readout_s_ + kReadoutJitter * random_.uniform());
}

void ExposureClock::next() {
  ++sequence_;
  schedule();
}

void ExposureClock::skipLost(TimeNs now) {
  const TimeNs oldest = now - fromSeconds(kBufferedFrames * period_s_);
  while (arrival_ < oldest) next();
}

}  // namespace helical
