#include "engine/tracking/pose_fit.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/geometry/rotation.h"
#include "tests/tracking/field.h"

namespace helical {
namespace {

RigidTransform randomPose(Random& random) {
  RigidTransform pose;
  pose.translation = {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(0.1, 0.8)};
  pose.rotation = expSO3({0, 0, random.uniform(-kPi, kPi)}) *
                  expSO3({random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0});
  return pose;
}

RigidTransform disturbed(const RigidTransform& pose, double metres, double radians, Random& random) {
  const Eigen::Vector3d shift(random.normal(), random.normal(), random.normal());
  const Eigen::Vector3d turn(random.normal(), random.normal(), random.normal());
  return {(pose.rotation * expSO3(radians * turn.normalized())).normalized(),
          pose.translation + metres * shift.normalized()};
}

/// Views of one pose with the right names, by as many cameras as there are.
struct Views {
  std::vector<Observation> observations;
  std::vector<NamedView> views;

  Views(const Field& field, const RigidTransform& pose, int cameras, double sigma, Random& random) {
    observations.reserve(static_cast<std::size_t>(cameras));
    for (int c = 0; c < cameras; ++c) {
      const auto index = static_cast<std::size_t>(c);
      observations.push_back(field.observe(c, 0, pose, sigma, random));
      NamedView view{
          &field.models[index], field.estimates[index].camera_from_world, &observations.back(), {}};
      view.names.fill(-1);
      for (std::size_t m = 0; m < 4; ++m) view.names[m] = static_cast<int>(m);
      views.push_back(view);
    }
  }
};

TEST(FitPose, RecoversThePoseWithoutNoise) {
  const Field field;
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const RigidTransform truth = randomPose(random);
    const int cameras = 1 + trial % 3;
    const Views seen(field, truth, cameras, 0.0, random);
    for (const double scale : {0.0, 20.0}) {
      const PoseFit fit =
          fitPose(seen.views, field.markers, disturbed(truth, 0.05, 0.1, random), scale, 30, 3.0);
      ASSERT_TRUE(fit.ok);
      EXPECT_EQ(fit.named, 4 * cameras);
      EXPECT_EQ(fit.inliers, fit.named);
      EXPECT_LT(fit.rms_px, 1e-4);
      EXPECT_LT(distanceBetween(fit.world_from_body, truth), 1e-6);
      EXPECT_LT(angleBetween(fit.world_from_body, truth), 1e-5);
    }
  }
}

TEST(FitPose, RobustWeightsShrugOffGrossOutliers) {
  const Field field;
  Random random(2);
  int plain_is_off = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const RigidTransform truth = randomPose(random);
    Views seen(field, truth, 3, kCentroidSigma, random);
    const auto camera = static_cast<std::size_t>(random.uniform(0.0, 3.0));
    const auto marker = static_cast<std::size_t>(random.uniform(0.0, 4.0));
    seen.observations[camera].centroids[marker].pixel += Eigen::Vector2d(60, -45);
    const RigidTransform start = disturbed(truth, 0.01, 0.05, random);
    const PoseFit robust = fitPose(seen.views, field.markers, start, 3.0, 20, 3.0);
    const PoseFit plain = fitPose(seen.views, field.markers, start, 0.0, 20, 3.0);
    ASSERT_TRUE(robust.ok);
    EXPECT_EQ(robust.inliers, 11);
    EXPECT_LT(distanceBetween(robust.world_from_body, truth), 0.003);
    EXPECT_LT(angleBetween(robust.world_from_body, truth), 0.02);
    plain_is_off += distanceBetween(plain.world_from_body, truth) > 0.005 ? 1 : 0;
  }
  EXPECT_GT(plain_is_off, 150) << "without them the outlier pulls";
}

TEST(FitPose, InformationIsTheNumericJacobiansSquare) {
  const Field field;
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const RigidTransform truth = randomPose(random);
    const Views seen(field, truth, 3, 0.0, random);
    const PoseFit fit = fitPose(seen.views, field.markers, truth, 0.0, 10, 3.0);
    Matrix6d expected = Matrix6d::Zero();
    for (std::size_t c = 0; c < 3; ++c)
      for (const auto& marker : field.markers.all()) {
        const auto pixel = [&](const Vector6d& d) -> Eigen::Vector2d {
          const RigidTransform pose{truth.rotation * expSO3(d.tail<3>()), truth.translation + d.head<3>()};
          return *field.models[c].project(field.estimates[c].camera_from_world * (pose * marker));
        };
        Eigen::Matrix<double, 2, 6> jacobian;
        for (int i = 0; i < 6; ++i)
          jacobian.col(i) = (pixel(1e-6 * Vector6d::Unit(i)) - pixel(-1e-6 * Vector6d::Unit(i))) / 2e-6;
        expected += jacobian.transpose() * jacobian;
      }
    EXPECT_LT((fit.information - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(FitPose, ErrorsAreAsLargeAsTheInformationSays) {
  const Field field;
  Random random(4);
  double nees = 0.0;
  constexpr int kTrials = 500;
  for (int trial = 0; trial < kTrials; ++trial) {
    const RigidTransform truth = randomPose(random);
    const Views seen(field, truth, 2, kCentroidSigma, random);
    const PoseFit fit = fitPose(seen.views, field.markers, truth, 0.0, 10, 3.0);
    Vector6d error;
    error << fit.world_from_body.translation - truth.translation,
        logSO3(truth.rotation.conjugate() * fit.world_from_body.rotation);
    nees += error.dot(fit.information * error) / (kCentroidSigma * kCentroidSigma);
  }
  EXPECT_NEAR(nees / kTrials, 6.0, 0.6);
}

TEST(FitPose, NeedsThreeNames) {
  const Field field;
  Random random(5);
  const RigidTransform truth = randomPose(random);
  Views seen(field, truth, 1, 0.0, random);
  seen.views[0].names[0] = seen.views[0].names[1] = -1;
  EXPECT_FALSE(fitPose(seen.views, field.markers, truth, 0.0, 10, 3.0).ok);
  EXPECT_FALSE(fitPose({}, field.markers, truth, 0.0, 10, 3.0).ok);
}

TEST(FitPose, ThreeMarkersInEachOfTwoCamerasAreEnough) {
  const Field field;
  Random random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const RigidTransform truth = randomPose(random);
    Views seen(field, truth, 2, 0.0, random);
    seen.views[0].names[0] = seen.views[1].names[2] = -1;
    const PoseFit fit = fitPose(seen.views, field.markers, disturbed(truth, 0.02, 0.1, random), 0.0, 20, 3.0);
    ASSERT_TRUE(fit.ok);
    EXPECT_EQ(fit.named, 6);
    EXPECT_LT(distanceBetween(fit.world_from_body, truth), 1e-6);
  }
}

}  // namespace
}  // namespace helical
