#include "engine/base/clock.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

TEST(MonotonicClock, NeverGoesBackAndSleepsUntilTheTimeAsked) {
  MonotonicClock clock;
  const TimeNs before = clock.now();
  EXPECT_GE(before, 0);
  clock.sleepUntil(before + kNanosecondsPerMillisecond);
  EXPECT_GE(clock.now(), before + kNanosecondsPerMillisecond);
  clock.sleepUntil(before);
}

TEST(ManualClock, ShowsWhatItsOwnerSetAndNeverBlocks) {
  ManualClock clock;
  EXPECT_EQ(clock.now(), 0);
  clock.sleepUntil(fromSeconds(1e6));
  EXPECT_EQ(clock.now(), 0);
  clock.set(fromSeconds(2.5));
  EXPECT_EQ(clock.now(), 2'500'000'000);
}

TEST(Time, SecondsRoundToNanosecondsAndBack) {
  EXPECT_EQ(fromSeconds(-0.1), -100'000'000);
  EXPECT_EQ(fromSeconds(0.1), 100'000'000);
  EXPECT_DOUBLE_EQ(toSeconds(1'500'000'000), 1.5);
}

TEST(ThreadCpuTime, CountsWorkOfThisThread) {
  const TimeNs before = threadCpuTime();
  volatile double sum = 0.0;
  for (int i = 0; i < 1'000'000; ++i) sum = sum + i;
  EXPECT_GT(threadCpuTime(), before);
}

}  // namespace
}  // namespace helical
