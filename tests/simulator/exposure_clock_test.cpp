#include "engine/simulator/exposure_clock.h"

#include <gtest/gtest.h>

#include <set>

namespace helical {
namespace {

TEST(ExposureClock, RunsAtTheCamerasRateWithinItsError) {
  SimulationOptions options;
  options.rate_error = 1e-3;
  std::set<TimeNs> periods;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    ExposureClock clock(options, Random(seed));
    const TimeNs first = clock.exposure();
    for (int i = 0; i < 6000; ++i) clock.next();
    const double period = toSeconds(clock.exposure() - first) / 6000.0;
    EXPECT_LE(std::abs(period * 60.0 - 1.0), 1.0001e-3);
    periods.insert(clock.exposure() - first);
  }
  EXPECT_GT(periods.size(), 45u) << "every camera has an error of its own";
}

TEST(ExposureClock, StartsAnywhereInAPeriod) {
  double earliest = 1.0, latest = 0.0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double phase = toSeconds(ExposureClock({}, Random(seed)).exposure()) * 60.0;
    EXPECT_GE(phase, 0.0);
    EXPECT_LT(phase, 1.001);
    earliest = std::min(earliest, phase);
    latest = std::max(latest, phase);
  }
  EXPECT_LT(earliest, 0.05);
  EXPECT_GT(latest, 0.95);
}

TEST(ExposureClock, FramesArriveAfterTheReadOut) {
  ExposureClock clock({}, Random(1));
  for (int i = 0; i < 1000; ++i, clock.next()) {
    EXPECT_EQ(clock.sequence(), static_cast<std::uint64_t>(i));
    const double readout = toSeconds(clock.arrival() - clock.exposure());
    EXPECT_GE(readout, 0.015);
    EXPECT_LE(readout, 0.0161);
  }
}

TEST(ExposureClock, LosesFramesThatNobodyReads) {
  ExposureClock clock({}, Random(2)), in_time({}, Random(2));
  const TimeNs now = 10 * kNanosecondsPerSecond;
  clock.skipLost(now);
  EXPECT_NEAR(static_cast<double>(clock.sequence()), 600.0 - 3.0, 2.0);
  EXPECT_LE(toSeconds(now - clock.arrival()), 3.0 / 60.0 + 0.001);
  in_time.skipLost(in_time.arrival());
  EXPECT_EQ(in_time.sequence(), 0u) << "a frame that has just arrived is not lost";
}

}  // namespace
}  // namespace helical
