#include "engine/experiments/parallel_runs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace helical {
namespace {

TEST(ForEachRun, DoesEachOnceAndTellsHowManyAreDone) {
  std::vector<std::atomic<int>> done(500);
  std::vector<int> told;
  forEachRun(
      500, [&](int run) { ++done[static_cast<std::size_t>(run)]; },
      [&](int count) { told.push_back(count); });
  for (const auto& count : done) EXPECT_EQ(count, 1);
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 500);
}

TEST(ForEachRun, ThrowsWhatARunThrew) {
  std::atomic<int> done = 0;
  EXPECT_THROW(forEachRun(
                   100000,
                   [&](int run) {
                     ++done;
                     if (run == 3) throw std::runtime_error("no");
                   },
                   [](int) {}),
               std::runtime_error);
  EXPECT_LT(done, 100000);
}

TEST(ForEachRun, DoesNothingForNoRuns) {
  forEachRun(
      0, [](int) { FAIL(); }, [](int) { FAIL(); });
}

}  // namespace
}  // namespace helical
