#include "ui/startup_time.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

TEST(StartupTime, CountsFromTheProcessStartAndOnward) {
  const auto first = sinceProcessStart();
  ASSERT_TRUE(first.has_value());
  EXPECT_GE(*first, -20 * kNanosecondsPerMillisecond) << "the kernel counts in steps of 10 ms";
  const auto second = sinceProcessStart();
  ASSERT_TRUE(second.has_value());
  EXPECT_GE(*second, *first);
}

}  // namespace
}  // namespace helical
