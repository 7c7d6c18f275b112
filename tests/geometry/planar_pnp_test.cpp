#include "engine/geometry/planar_pnp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/geometry/rotation.h"
#include "tests/geometry/random_geometry.h"

namespace helical {
namespace {

const std::vector<Eigen::Vector3d> kMarkers{
    {0.15, 0.12, -0.05}, {-0.13, 0.15, -0.05}, {-0.16, -0.11, -0.05}, {0.11, -0.16, -0.05}};

CameraModel camera() {
  return CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5, {-0.05, 0.01, 0.0004, -0.0003, 0.0});
}

/// A target some metres in front of the camera, tilted by 0.3 to 1.2 rad from the line of sight.
RigidTransform viewOfTarget(Random& random) {
  const double depth = random.uniform(1.0, 3.5);
  const Eigen::Vector3d place(random.uniform(-0.3, 0.3) * depth, random.uniform(-0.25, 0.25) * depth, depth);
  const double direction = random.uniform(-kPi, kPi);
  const Eigen::Vector3d tilt =
      random.uniform(0.3, 1.2) * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0);
  const Eigen::Quaterniond facing = expSO3({kPi, 0, 0});
  const Eigen::Quaterniond spin = expSO3({0, 0, random.uniform(-kPi, kPi)});
  return {(expSO3(tilt) * facing * spin).normalized(), place};
}

std::vector<Eigen::Vector2d> pixelsOf(const RigidTransform& camera_from_body, double noise, Random& random) {
  std::vector<Eigen::Vector2d> pixels;
  for (const auto& marker : kMarkers)
    pixels.push_back(*camera().project(camera_from_body * marker) +
                     noise * Eigen::Vector2d(random.normal(), random.normal()));
  return pixels;
}

double angleBetween(const RigidTransform& a, const RigidTransform& b) {
  return logSO3(a.rotation.conjugate() * b.rotation).norm();
}

TEST(PlanarPnp, RecoversThePoseWithoutNoise) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const RigidTransform truth = viewOfTarget(random);
    const PlanarPoses found = solvePlanarPnp(camera(), kMarkers, pixelsOf(truth, 0.0, random));
    ASSERT_EQ(found.count, 2);
    EXPECT_LT(found.poses[0].rms_px, 1e-6);
    EXPECT_LT((found.poses[0].camera_from_body.translation - truth.translation).norm(), 1e-6) << i;
    EXPECT_LT(angleBetween(found.poses[0].camera_from_body, truth), 1e-6) << i;
  }
}

TEST(PlanarPnp, GivesTheBetterPoseFirstAndOneOfTheTwoIsTrueUnderNoise) {
  Random random(2);
  constexpr int kTrials = 1000;
  constexpr double kNoise = 0.5;
  std::vector<double> depth_errors, angle_errors;
  int first_is_nearer = 0;
  for (int i = 0; i < kTrials; ++i) {
    const RigidTransform truth = viewOfTarget(random);
    const PlanarPoses found = solvePlanarPnp(camera(), kMarkers, pixelsOf(truth, kNoise, random));
    ASSERT_EQ(found.count, 2);
    EXPECT_LE(found.poses[0].rms_px, found.poses[1].rms_px);
    EXPECT_LT(found.poses[0].rms_px, 4.0 * kNoise) << "the fit is at least as good as the truth";
    const double first = angleBetween(found.poses[0].camera_from_body, truth);
    const double second = angleBetween(found.poses[1].camera_from_body, truth);
    first_is_nearer += first <= second ? 1 : 0;
    const RigidTransform& nearer = found.poses[first <= second ? 0 : 1].camera_from_body;
    depth_errors.push_back((nearer.translation - truth.translation).norm() / truth.translation.norm());
    angle_errors.push_back(std::min(first, second));
  }
  // 0.5 px over a target of about 300 f / z = 70 px at 2.3 m.
  std::sort(depth_errors.begin(), depth_errors.end());
  std::sort(angle_errors.begin(), angle_errors.end());
  EXPECT_LT(depth_errors[kTrials / 2], 0.01);
  EXPECT_LT(depth_errors[kTrials * 99 / 100], 0.05);
  EXPECT_LT(angle_errors[kTrials / 2], toRadians(3.0));
  EXPECT_LT(angle_errors[kTrials * 99 / 100], toRadians(25.0));
  EXPECT_GT(first_is_nearer, kTrials * 3 / 4);
}

/// From afar a tilted target and its mirror image about the line of sight differ by little.
TEST(PlanarPnp, FindsTheMirroredPoseOfADistantTarget) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    RigidTransform truth = viewOfTarget(random);
    truth.translation = Eigen::Vector3d(0.2, -0.1, 4.0);
    const PlanarPoses found = solvePlanarPnp(camera(), kMarkers, pixelsOf(truth, 0.0, random));
    ASSERT_EQ(found.count, 2);
    const Eigen::Vector3d sight = truth.translation.normalized();
    const Eigen::Vector3d normal = truth.rotation * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d other = found.poses[1].camera_from_body.rotation * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d mirrored = 2.0 * sight * sight.dot(normal) - normal;
    EXPECT_GT(other.dot(mirrored), std::cos(toRadians(20.0))) << i;
    EXPECT_LT(found.poses[1].rms_px, 3.0);
    EXPECT_GT(found.poses[1].camera_from_body.translation.z(), 0.0);
  }
}

TEST(PlanarPnp, HasNoPoseForPointsWithoutExtent) {
  const std::vector<Eigen::Vector3d> points(4, Eigen::Vector3d(0, 0, -0.05));
  const std::vector<Eigen::Vector2d> pixels(4, Eigen::Vector2d(320, 240));
  EXPECT_EQ(solvePlanarPnp(camera(), points, pixels).count, 0);
}

}  // namespace
}  // namespace helical
