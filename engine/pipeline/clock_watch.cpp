#include "engine/pipeline/clock_watch.h"

#include <cmath>

namespace helical {
namespace {

constexpr int kFramesToKnow = 20;
constexpr double kHalfAFrame = 0.5;
constexpr double kFollow = 0.005;     // share of the newest frame: clocks drift against each other
constexpr double kLongestGapS = 0.5;  // over which the rhythm is known
constexpr TimeNs kGetsUsedTo = 5 * kNanosecondsPerSecond;  // to frames that are late for so long

}  // namespace

void ClockWatch::learn(const Observation& observation, double latency) {
  if (known_ == 0 || observation.sequence <= last_sequence_) {
    known_ = 0;
    first_sequence_ = observation.sequence;
    first_exposure_ = observation.exposure;
    usual_latency_s_ = 0.0;
  }
  ++known_;
  usual_latency_s_ += (latency - usual_latency_s_) / known_;
  if (observation.sequence > first_sequence_)
    period_s_ = toSeconds(observation.exposure - first_exposure_) /
                static_cast<double>(observation.sequence - first_sequence_);
}

bool ClockWatch::stampsBrokeTheirRhythm(const Observation& observation) const {
  const double by_stamps = toSeconds(observation.exposure - last_exposure_);
  const double by_arrivals = toSeconds(observation.arrival - last_arrival_);
  // After a long silence nobody knows; but no frame comes earlier than ever, so that then it was the stamp.
  if (observation.sequence <= last_sequence_ || by_arrivals > kLongestGapS)
    return toSeconds(observation.arrival - observation.exposure) < usual_latency_s_;
  const double due = period_s_ * static_cast<double>(observation.sequence - last_sequence_);
  return std::abs(by_stamps - due) > std::abs(by_arrivals - due);
}

void ClockWatch::add(const Observation& observation) {
  const double latency = toSeconds(observation.arrival - observation.exposure);
  if (known_ < kFramesToKnow) {
    learn(observation, latency);
  } else {
    const double limit = kHalfAFrame * period_s_;
    const bool was_off = off_;
    off_ = std::abs(latency - usual_latency_s_) > limit;
    if (off_ && (!was_off || std::abs(latency - last_latency_s_) > limit)) {
      jumped_ = (was_off && jumped_) || stampsBrokeTheirRhythm(observation);
      late_since_ = observation.arrival;
    }
    if (!off_) usual_latency_s_ += kFollow * (latency - usual_latency_s_);
    if (off_ && !jumped_ && observation.arrival - late_since_ > kGetsUsedTo) {
      usual_latency_s_ = latency;
      off_ = false;
    }
  }
  last_sequence_ = observation.sequence;
  last_exposure_ = observation.exposure;
  last_arrival_ = observation.arrival;
  last_latency_s_ = latency;
}

}  // namespace helical
