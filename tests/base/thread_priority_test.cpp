#include "engine/base/thread_priority.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <thread>

namespace helical {
namespace {

int policyOfThisThread() {
  return sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
}

TEST(ThreadPriority, ChangesTheCallingThreadAloneAndNotItsChildren) {
  for (const Urgency urgency : {Urgency::kControl, Urgency::kCapture})
    std::thread([urgency] {
      const bool allowed = raisePriority(urgency);
      EXPECT_EQ(policyOfThisThread(), allowed ? SCHED_RR : SCHED_OTHER);
      std::thread([] { EXPECT_EQ(policyOfThisThread(), SCHED_OTHER); }).join();
    }).join();
  EXPECT_EQ(policyOfThisThread(), SCHED_OTHER);
}

}  // namespace
}  // namespace helical
