#include "engine/cameras/clock_mapping.h"

#include <algorithm>
#include <cmath>

namespace helical {
namespace {

constexpr TimeNs kArrivalWindow = kNanosecondsPerSecond / 2;
constexpr TimeNs kArrivalSigma = 300'000;  // of the least delayed frame of a window
/// A crystal's drift before anything was measured: with a short base line the samples' noise would say more.
constexpr double kDriftSigma = 100e-6;

}  // namespace

void ClockMapping::add(const ClockSample& sample) {
  if (count_ == 0) base_ = sample.host - sample.device;
  samples_[count_ % kKept] = sample;
  ++count_;
  fit();
}

void ClockMapping::addArrival(TimeNs device, TimeNs host, TimeNs usual_delay) {
  const ClockSample sample{device, host - usual_delay, kArrivalSigma};
  if (!known()) {
    add(sample);
    arrivals_since_ = device;
    best_arrival_ = sample;
    return;
  }
  if (device - arrivals_since_ >= kArrivalWindow) {
    add(best_arrival_);
    arrivals_since_ = device;
    best_arrival_ = sample;
  } else if (sample.host - sample.device < best_arrival_.host - best_arrival_.device) {
    best_arrival_ = sample;
  }
}

void ClockMapping::fit() {
  const std::size_t used = std::min(count_, kKept);
  reference_ = samples_[(count_ - 1) % kKept].device;
  double w = 0.0, wx = 0.0, wy = 0.0, wxx = 1.0 / (kDriftSigma * kDriftSigma), wxy = 0.0;
  for (std::size_t i = 0; i < used; ++i) {
    const ClockSample& s = samples_[i];
    const double sigma = std::max(1e-6, toSeconds(s.sigma));
    const double weight = 1.0 / (sigma * sigma);
    const double x = toSeconds(s.device - reference_), y = toSeconds(s.host - s.device - base_);
    w += weight;
    wx += weight * x;
    wy += weight * y;
    wxx += weight * x * x;
    wxy += weight * x * y;
  }
  const double determinant = w * wxx - wx * wx;
  drift_ = (w * wxy - wx * wy) / determinant;
  offset_s_ = (wy - drift_ * wx) / w;
  sigma_s_ = std::sqrt(wxx / determinant);
}

TimeNs ClockMapping::host(TimeNs device) const {
  const double beyond = offset_s_ + drift_ * toSeconds(device - reference_);
  return device + base_ + static_cast<TimeNs>(beyond * 1e9);
}

}  // namespace helical
