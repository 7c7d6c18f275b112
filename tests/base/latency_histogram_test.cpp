#include "engine/base/latency_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/random.h"

namespace helical {
namespace {

constexpr double kBinWidth = 0.02;

TEST(LatencyHistogram, IsZeroWithoutSamples) {
  const LatencyHistogram histogram;
  EXPECT_EQ(histogram.count(), 0u);
  EXPECT_EQ(histogram.percentile(0.5), 0);
  EXPECT_EQ(histogram.maximum(), 0);
}

TEST(LatencyHistogram, PercentilesAreThoseOfTheSortedSamplesWithinOneBin) {
  Random random(3);
  LatencyHistogram histogram;
  std::vector<TimeNs> samples;
  for (int i = 0; i < 5000; ++i) {
    samples.push_back(static_cast<TimeNs>(std::exp(random.uniform(std::log(50.0), std::log(2e9)))));
    histogram.add(samples.back());
  }
  std::sort(samples.begin(), samples.end());
  EXPECT_EQ(histogram.count(), samples.size());
  EXPECT_EQ(histogram.maximum(), samples.back());
  for (const double fraction : {0.001, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(samples.size()))) - 1;
    const auto exact = static_cast<double>(samples[rank]);
    const auto found = static_cast<double>(histogram.percentile(fraction));
    EXPECT_GE(found, exact * (1.0 - 1e-9) - 1.0) << fraction;
    EXPECT_LE(found, exact * (1.0 + kBinWidth) + 1.0) << fraction;
  }
}

TEST(LatencyHistogram, KeepsDurationsBeyondItsRange) {
  LatencyHistogram histogram;
  histogram.add(0);
  histogram.add(-5);
  histogram.add(60 * kNanosecondsPerSecond);
  EXPECT_EQ(histogram.count(), 3u);
  EXPECT_EQ(histogram.maximum(), 60 * kNanosecondsPerSecond);
  EXPECT_LE(histogram.percentile(0.5), 11);
  EXPECT_LE(histogram.percentile(1.0), 60 * kNanosecondsPerSecond);
}

}  // namespace
}  // namespace helical
