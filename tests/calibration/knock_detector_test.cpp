#include "engine/calibration/knock_detector.h"

#include <gtest/gtest.h>

#include "engine/base/random.h"

namespace helical {
namespace {

constexpr int kFrames = 200000;  // an hour at 60 Hz, nearly

KnockEvidence frame(int in_view, int agreeing, int witnesses = 2) {
  return {0, in_view, agreeing, witnesses};
}

TEST(KnockDetector, FindsAKnockInATenthOfASecond) {
  KnockDetector detector;
  for (int f = 0; f < 100; ++f) EXPECT_FALSE(detector.add(frame(4, 4)));
  for (int f = 1; f <= 5; ++f) EXPECT_FALSE(detector.add(frame(4, 0)));
  EXPECT_TRUE(detector.add(frame(4, 0)));
  EXPECT_FALSE(detector.add(frame(4, 0)));  // says it once
}

TEST(KnockDetector, OfTwoCamerasItTakesTwiceAsLong) {
  KnockDetector detector;
  for (int f = 1; f <= 11; ++f) EXPECT_FALSE(detector.add(frame(4, 0, 1)));
  EXPECT_TRUE(detector.add(frame(4, 0, 1)));
}

TEST(KnockDetector, FindsItThroughLuckyHits) {
  KnockDetector detector;
  Random random(4);
  bool found = false;
  for (int f = 0; f < 30 && !found; ++f) found = detector.add(frame(4, random.uniform() < 0.1 ? 2 : 1));
  EXPECT_TRUE(found);
}

TEST(KnockDetector, BearsOutliersWithoutAnAlarm) {
  KnockDetector detector;
  Random random(5);
  int alarms = 0;
  for (int f = 0; f < kFrames; ++f) {
    int agreeing = 0;
    for (int ball = 0; ball < 4; ++ball) agreeing += random.uniform() >= 0.1;
    alarms += detector.add(frame(4, agreeing));
  }
  EXPECT_EQ(alarms, 0);
}

TEST(KnockDetector, CoveredCamerasAndDoubtfulPosesAreNoKnocks) {
  KnockDetector detector;
  for (int f = 0; f < 1000; ++f) {
    EXPECT_FALSE(detector.add(frame(2, 0)));
    EXPECT_FALSE(detector.add(frame(4, 0, 0)));
  }
}

TEST(KnockDetector, WhatWasCountedBeforeAGapIsForgotten) {
  KnockDetector detector;
  const auto at = [](double seconds) { return KnockEvidence{fromSeconds(seconds), 4, 0, 2}; };
  for (int f = 0; f < 5; ++f) EXPECT_FALSE(detector.add(at(1.0 + f / 60.0)));
  for (int f = 0; f < 5; ++f) EXPECT_FALSE(detector.add(at(60.0 + f / 60.0)));
  EXPECT_TRUE(detector.add(at(60.1)));
}

TEST(KnockDetector, AMomentOfDisagreementIsForgotten) {
  KnockDetector detector;
  for (int round = 0; round < 100; ++round) {
    for (int f = 0; f < 5; ++f) EXPECT_FALSE(detector.add(frame(4, 0)));
    for (int f = 0; f < 3; ++f) EXPECT_FALSE(detector.add(frame(4, 4)));
  }
}

}  // namespace
}  // namespace helical
