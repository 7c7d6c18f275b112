// The study of knocks tells a camera that was moved from cameras that nobody touched.

#include "engine/experiments/knock_study.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/config/resource_files.h"
#include "engine/config/rig_file.h"
#include "engine/experiments/endurance_study.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

RigConfig rigNamed(const char* name) {
  return loadRig(resourceFolder() / "rigs" / name);
}

TEST(KnockStudy, ALargeKnockIsFoundAndHeals) {
  const KnockCondition knock{"large", toRadians(5.0), 0.05, 0.25};
  const KnockResult result = studyKnocks(rigNamed("calibrated.toml"), knock, 3, 1, [](int) {});
  ASSERT_EQ(result.runs.size(), 3U);
  for (const KnockRun& run : result.runs) {
    EXPECT_LE(run.found_s, 0.25);
    EXPECT_GT(run.back_s, 0.0);
    EXPECT_LT(run.back_s, 3.0);
    EXPECT_GE(run.again_s, run.found_s);
    EXPECT_EQ(run.others_found, 0);
  }
  EXPECT_EQ(result.foundInTime().value, 1.0);
}

TEST(KnockStudy, NoKnockIsNotFound) {
  const KnockCondition none{"none", 0.0, 0.0, 1.0};
  const KnockResult result = studyKnocks(rigNamed("calibrated.toml"), none, 3, 1, [](int) {});
  for (const KnockRun& run : result.runs) {
    EXPECT_TRUE(std::isinf(run.found_s));
    EXPECT_EQ(run.back_s, 0.0);
  }
  EXPECT_EQ(result.foundInTime().value, 0.0);
}

TEST(MemoryStudy, HearsOfTheFlightAndItsMemory) {
  int calls = 0;
  const MemoryResult result = studyMemory(rigNamed("paper.toml"), 65.0, 1, [&](double) { ++calls; });
  EXPECT_GE(result.flown_s, 65.0);
  EXPECT_GE(calls, 4);
  EXPECT_GT(result.after_a_minute, 1e5);
  EXPECT_LE(result.at_the_end, result.after_a_minute + 4096.0);
}

}  // namespace
}  // namespace helical
