#include "engine/simulator/carried_path.h"

#include <gtest/gtest.h>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

RigidTransform putDown() {
  RigidTransform pose;
  pose.translation = {0.012, -0.008, 0.06};
  pose.rotation = expSO3({0.0, 0.0, 0.15});
  return pose;
}

TEST(CarriedPath, BeginsAsTheWorldsOriginAndEndsWhereItIsPutDown) {
  const CarriedPath path(20.0, putDown(), Random(1));
  for (const double t : {0.0, 1.0, 2.4}) {
    EXPECT_EQ(path.at(t).world_from_body.translation, Eigen::Vector3d(0.0, 0.0, 0.06));
    EXPECT_NEAR(path.at(t).world_from_body.rotation.angularDistance(Eigen::Quaterniond::Identity()), 0.0, 1e-12);
  }
  for (const double t : {19.6, 20.0}) {
    EXPECT_LT((path.at(t).world_from_body.translation - putDown().translation).norm(), 1e-9);
    EXPECT_LT(path.at(t).world_from_body.rotation.angularDistance(putDown().rotation), 1e-9);
    EXPECT_LT(path.at(t).velocity_in_world.norm(), 1e-6);
  }
}

TEST(CarriedPath, GoesThroughTheSpaceAboveThePadAsHandsDo) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const CarriedPath path(20.0, putDown(), Random(seed));
    Eigen::Vector3d low = path.at(0.0).world_from_body.translation, high = low;
    double tilt = 0.0;
    for (double t = 0.0; t < 20.0; t += 0.01) {
      const HelicopterState now = path.at(t), next = path.at(t + 0.01);
      low = low.cwiseMin(now.world_from_body.translation);
      high = high.cwiseMax(now.world_from_body.translation);
      tilt = std::max(tilt, tiltOf(now.world_from_body.rotation));
      EXPECT_LT(now.velocity_in_world.norm(), 2.5);
      // Velocities are those of the motion.
      EXPECT_LT((next.world_from_body.translation - now.world_from_body.translation - 0.01 * now.velocity_in_world)
                    .norm(),
                2e-3);
    }
    EXPECT_GT((high - low).minCoeff(), 0.25) << "seed " << seed;
    EXPECT_GT(low.z(), 0.05) << "seed " << seed;
    EXPECT_LT(tilt, toRadians(45.0)) << "seed " << seed;
    EXPECT_GT(tilt, toRadians(8.0)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace helical
