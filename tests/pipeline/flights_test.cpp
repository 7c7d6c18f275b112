// Whole flights, image-free: few seeds here, hundreds in campaign_test.cpp.

#include <gtest/gtest.h>

#include "engine/geometry/rotation.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

using test::cover;
using test::Flown;
using test::flyHover;
using test::shippedRig;

TEST(Flights, HoverInStillAirKeepsWithinACentimetre) {
  RigConfig rig = shippedRig("paper", 7);
  rig.simulation.gust_factor = 0.0;
  const Flown flown = flyHover(rig);
  EXPECT_EQ(flown.outcome, "landed");
  EXPECT_LT(flown.score.hoverHorizontal().value(), 0.010);
  EXPECT_LT(flown.score.hoverHeight().value(), 0.010);
  EXPECT_LT(toDegrees(flown.score.hoverYaw().value()), 4.0);
  EXPECT_EQ(flown.score.failsafes(), 0u);
}

TEST(Flights, HoverInGustsKeepsWithinFourCentimetres) {
  const Flown flown = flyHover(shippedRig("paper", 7));
  EXPECT_EQ(flown.outcome, "landed");
  EXPECT_LT(flown.score.hoverHorizontal().value(), 0.040);
  EXPECT_LT(flown.score.hoverHeight().value(), 0.010);
  EXPECT_LT(toDegrees(flown.score.hoverYaw().value()), 4.0);
}

TEST(Flights, UnknownParametersAndTrimsAreFlown) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RigConfig rig = shippedRig("paper", seed);
    rig.simulation.vary = 0.3;
    EXPECT_EQ(flyHover(rig).outcome, "landed") << "seed " << seed;
  }
}

TEST(Flights, CameraTwoCoveredUntilLandingWithOneAndThreeCalibrated) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RigConfig rig = shippedRig("calibrated", seed);
    cover(rig, {1}, 13.0, 60.0);
    EXPECT_EQ(flyHover(rig).outcome, "landed") << "seed " << seed;
  }
}

TEST(Flights, OneCameraLeftStillLands) {
  RigConfig rig = shippedRig("paper", 3);
  cover(rig, {1}, 13.0, 60.0);
  EXPECT_EQ(flyHover(rig).outcome, "landed");
}

TEST(Flights, EveryCameraCoveredForHalfASecond) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RigConfig rig = shippedRig("paper", seed);
    cover(rig, {0, 1, 2}, 13.0, 13.5);
    const Flown flown = flyHover(rig);
    EXPECT_EQ(flown.outcome, "landed") << "seed " << seed;
    EXPECT_NE(flown.score.failsafes() & static_cast<std::uint32_t>(Failsafe::kNoPoseCoast), 0u);
  }
}

TEST(Flights, EveryCameraCoveredForGoodDescendsAndCuts) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    RigConfig rig = shippedRig("paper", seed);
    cover(rig, {0, 1, 2}, 13.0, 100.0);
    const Flown flown = flyHover(rig);
    EXPECT_EQ(flown.outcome, "failsafe-landed") << "seed " << seed << ": " << flown.verdict.reason;
    EXPECT_EQ(
        failsafeNames(flown.score.failsafes()),
        (std::vector<std::string>{"no-pose-coast", "no-pose-descent", "no-pose-cut", "no-pose-neutral"}));
    EXPECT_FALSE(flown.hard_touch_while_seen);
  }
}

TEST(Flights, OutliersAndNoiseAreSurvived) {
  RigConfig rig = shippedRig("paper", 5);
  rig.simulation.noise.sigma_px = 0.5;
  rig.simulation.noise.outliers = 0.05;
  rig.simulation.noise.dropout = 0.03;
  EXPECT_EQ(flyHover(rig).outcome, "landed");
}

TEST(Flights, FasterCamerasFlyAsWell) {
  RigConfig rig = shippedRig("paper", 5);
  rig.simulation.camera_rate_hz = 120.0;
  EXPECT_EQ(flyHover(rig).outcome, "landed");
}

TEST(Flights, ACameraWithoutAPoseFindsItsPlaceAndJoins) {
  const Flown flown = flyHover(shippedRig("paper", 2));
  EXPECT_EQ(flown.outcome, "landed");
  EXPECT_GT(flown.score.selectedShare(cameraId(0)), 0.9);
  EXPECT_GT(flown.score.selectedShare(cameraId(2)), 0.9);
}

}  // namespace
}  // namespace helical
