#include "engine/tracking/acquisition.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/geometry/rotation.h"
#include "tests/tracking/field.h"

namespace helical {
namespace {

constexpr TimeNs kNow = kNanosecondsPerSecond;

PosePrior padPrior() {
  PosePrior prior;
  prior.world_from_body.translation.z() = kStandingHeight;
  return prior;
}

/// The centroids in another order: they come without names.
void shuffle(Observation& observation, Random& random) {
  for (int i = observation.count - 1; i > 0; --i)
    std::swap(observation.centroids[static_cast<std::size_t>(i)],
              observation.centroids[static_cast<std::size_t>(random.uniform(0.0, i + 1.0))]);
}

std::optional<PoseFit> attempt(const Field& field, const RigidTransform& truth, int cameras, int clutter,
                               const PosePrior& prior, Random& random) {
  Acquisition acquisition(field.markers, field.models);
  for (int c = 0; c < cameras; ++c) {
    Observation observation = field.observe(c, kNow, truth, kCentroidSigma, random);
    for (int i = 0; i < clutter; ++i)
      addCentroid(observation, {random.uniform(0, 640), random.uniform(0, 480)}, 50.0);
    shuffle(observation, random);
    acquisition.add(observation);
  }
  return acquisition.attempt(kNow, field.estimates, field.usableCameras(), prior);
}

bool near(const PoseFit& fit, const RigidTransform& truth, double metres, double radians) {
  return distanceBetween(fit.world_from_body, truth) < metres &&
         angleBetween(fit.world_from_body, truth) < radians;
}

TEST(Acquisition, FindsTheHelicopterOnThePad) {
  const Field field;
  Random random(1);
  for (const int cameras : {3, 2}) {
    int found = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const RigidTransform truth = onPad(random, toRadians(43.0));
      const auto fit = attempt(field, truth, cameras, 0, padPrior(), random);
      if (!fit) continue;
      ++found;
      EXPECT_TRUE(near(*fit, truth, 0.01, 0.03)) << "a wrong pose is worse than none";
    }
    EXPECT_GE(found, 198) << cameras << " cameras";
  }
}

TEST(Acquisition, FindsItWithOneCamera) {
  const Field field;
  Random random(2);
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const RigidTransform truth = onPad(random, toRadians(40.0));
    const auto fit = attempt(field, truth, 1, 0, padPrior(), random);
    if (!fit) continue;
    ++found;
    EXPECT_TRUE(near(*fit, truth, 0.05, 0.12));
  }
  EXPECT_GE(found, 180);
}

TEST(Acquisition, IgnoresFalseCentroids) {
  const Field field;
  Random random(3);
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const RigidTransform truth = onPad(random, toRadians(40.0));
    const auto fit = attempt(field, truth, 3, 1, padPrior(), random);
    if (!fit) continue;
    ++found;
    EXPECT_TRUE(near(*fit, truth, 0.01, 0.03));
  }
  EXPECT_GE(found, 180);
}

TEST(Acquisition, RefusesAYawBeyondTheRange) {
  const Field field;
  Random random(4);
  for (int trial = 0; trial < 100; ++trial) {
    RigidTransform truth = onPad(random, 0.0);
    truth.rotation =
        expSO3({0, 0, (trial % 2 == 0 ? 1.0 : -1.0) * random.uniform(toRadians(52), toRadians(128))});
    const auto fit = attempt(field, truth, 1 + trial % 3, 0, padPrior(), random);
    EXPECT_FALSE(fit.has_value()) << trial;
  }
}

/// Four balls in a perfect square look the same from four headings.
TEST(Acquisition, RefusesWhatLooksTheSameFromSeveralHeadings) {
  Field field;
  const std::array<Eigen::Vector3d, 4> square{
      {{0.13, 0.13, -0.05}, {-0.13, 0.13, -0.05}, {-0.13, -0.13, -0.05}, {0.13, -0.13, -0.05}}};
  field.markers = MarkerLayout(square, 0.018);
  Random random(5);
  PosePrior anywhere = padPrior();
  anywhere.yaw_range = kPi;
  anywhere.yaw_sigma = 2.0;
  for (int trial = 0; trial < 100; ++trial) {
    const RigidTransform truth = onPad(random, kPi);
    EXPECT_FALSE(attempt(field, truth, 3, 0, anywhere, random).has_value());
  }
  // Within +-45 degrees of the pad's heading there is one only.
  int found = 0;
  for (int trial = 0; trial < 100; ++trial)
    found += attempt(field, onPad(random, toRadians(30.0)), 1 + trial % 3, 0, padPrior(), random) ? 1 : 0;
  EXPECT_GE(found, 95);
}

TEST(Acquisition, TellsTheHeadingOfTheAsymmetricLayoutFromAnyStart) {
  const Field field;
  Random random(6);
  PosePrior anywhere = padPrior();
  anywhere.yaw_range = kPi;
  anywhere.yaw_sigma = 2.0;
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const RigidTransform truth = onPad(random, kPi);
    const auto fit = attempt(field, truth, 3, 0, anywhere, random);
    if (!fit) continue;
    ++found;
    EXPECT_TRUE(near(*fit, truth, 0.01, 0.03));
  }
  EXPECT_GE(found, 95);
}

TEST(Acquisition, FindsItAgainInTheAirAfterAGap) {
  const Field field;
  Random random(7);
  int found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    RigidTransform truth;
    truth.translation = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(0.3, 0.8)};
    truth.rotation = expSO3({0, 0, random.uniform(-kPi, kPi)}) *
                     expSO3({random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0});
    PosePrior prior;
    prior.world_from_body.translation =
        truth.translation + Eigen::Vector3d(random.normal(), random.normal(), random.normal()) * 0.1;
    prior.world_from_body.rotation = expSO3({0, 0, yawOf(truth.rotation) + random.uniform(-0.5, 0.5)});
    prior.position_radius = 0.6;
    prior.yaw_range = 1.3;
    prior.yaw_sigma = 0.35;
    prior.tilt_limit = 0.8;
    const auto fit = attempt(field, truth, 2 + trial % 2, 0, prior, random);
    if (!fit) continue;
    ++found;
    EXPECT_TRUE(near(*fit, truth, 0.02, 0.06));
  }
  EXPECT_GE(found, 190);
}

TEST(Acquisition, FindsNothingWhereNothingIs) {
  const Field field;
  Random random(8);
  Acquisition acquisition(field.markers, field.models);
  EXPECT_FALSE(acquisition.attempt(kNow, field.estimates, field.usableCameras(), padPrior()).has_value());
  for (int trial = 0; trial < 200; ++trial) {
    for (int c = 0; c < 3; ++c) {
      Observation clutter;
      clutter.camera = cameraId(c);
      clutter.exposure = kNow;
      for (int i = 0; i < 6; ++i)
        addCentroid(clutter, {random.uniform(200, 440), random.uniform(150, 350)}, 50.0);
      acquisition.add(clutter);
    }
    EXPECT_FALSE(acquisition.attempt(kNow, field.estimates, field.usableCameras(), padPrior()).has_value());
  }
}

TEST(Acquisition, TakesPresentViewsOfUsableCamerasOnly) {
  Field field;
  Random random(9);
  const RigidTransform truth = onPad(random, 0.3);
  Acquisition acquisition(field.markers, field.models);
  for (int c = 0; c < 3; ++c)
    acquisition.add(field.observe(c, c == 0 ? kNow : kNow - fromSeconds(0.03), truth, 0.0, random));
  auto fit = acquisition.attempt(kNow, field.estimates, field.usableCameras(), padPrior());
  ASSERT_TRUE(fit.has_value());
  EXPECT_EQ(fit->named, 4) << "two views are too old";
  field.usable[0] = false;
  EXPECT_FALSE(acquisition.attempt(kNow, field.estimates, field.usableCameras(), padPrior()).has_value());
}

}  // namespace
}  // namespace helical
