#include "engine/base/latency_histogram.h"

#include <algorithm>
#include <cmath>

namespace helical {
namespace {

constexpr double kFirstEdgeNs = 10.0;
const double kLogRatio = std::log(1.02);

}  // namespace

void LatencyHistogram::add(TimeNs duration) {
  const double scaled =
      std::log(std::max(static_cast<double>(duration), kFirstEdgeNs) / kFirstEdgeNs) / kLogRatio;
  ++bins_[static_cast<std::size_t>(std::clamp(static_cast<int>(scaled), 0, kBins - 1))];
  ++count_;
  maximum_ = std::max(maximum_, duration);
}

TimeNs LatencyHistogram::percentile(double fraction) const {
  if (count_ == 0) return 0;
  const auto wanted = static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (int bin = 0; bin < kBins; ++bin) {
    seen += bins_[static_cast<std::size_t>(bin)];
    if (seen >= wanted)
      return std::min(maximum_, static_cast<TimeNs>(kFirstEdgeNs * std::exp((bin + 1) * kLogRatio)));
  }
  return maximum_;
}

}  // namespace helical
