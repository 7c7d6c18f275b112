#include "engine/tracking/jump_guard.h"

#include <gtest/gtest.h>

namespace helical {
namespace {

using Eigen::Vector3d;
constexpr double kFrame = 1.0 / 60.0;

TEST(JumpGuard, BelievesWhatFlies) {
  JumpGuard guard;
  Vector3d place = Vector3d::Zero();
  for (int i = 0; i < 1000; ++i) {
    const Vector3d next = place + Vector3d(2.5 * kFrame, 0.02 * (i % 2), 0.0);
    ASSERT_TRUE(guard.believes(place, next, kFrame));
    place = next;
  }
}

TEST(JumpGuard, DoesNotBelieveFourJumpsInARowAndAnyPlaceAfterFive) {
  JumpGuard guard;
  const Vector3d here(0.0, 0.0, 0.6), there(0.4, 0.0, 0.6);
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(guard.believes(here, there, kFrame));
  EXPECT_TRUE(guard.believes(here, here, kFrame)) << "and the count begins anew";
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(guard.believes(here, there, kFrame)) << i;
  EXPECT_TRUE(guard.believes(here, there, kFrame)) << "it is lost: what is found now counts";
  EXPECT_FALSE(guard.believes(there, here, kFrame));
}

TEST(JumpGuard, WhatWasUnseenForLongMayBeFarther) {
  JumpGuard guard;
  EXPECT_FALSE(guard.believes(Vector3d::Zero(), Vector3d(1.0, 0.0, 0.0), 0.1));
  EXPECT_TRUE(guard.believes(Vector3d::Zero(), Vector3d(1.0, 0.0, 0.0), 0.5));
  EXPECT_FALSE(guard.believes(Vector3d::Zero(), Vector3d(1.0, 0.0, 0.0), -0.5)) << "time does not run backwards";
}

}  // namespace
}  // namespace helical
