#pragma once

#include <array>
#include <cstdint>

#include "engine/base/time.h"

namespace helical {

/// Percentiles of durations without allocation: logarithmic bins of 2 % width from 10 ns to some seconds.
/// One thread; copy it to hand it over.
class LatencyHistogram {
 public:
  void add(TimeNs duration);
  std::uint64_t count() const { return count_; }
  /// Duration below which `fraction` of the samples lie, within one bin's width; 0 without samples.
  TimeNs percentile(double fraction) const;
  TimeNs maximum() const { return maximum_; }

 private:
  static constexpr int kBins = 1024;
  std::array<std::uint32_t, kBins> bins_{};
  std::uint64_t count_ = 0;
  TimeNs maximum_ = 0;
};

}  // namespace helical
