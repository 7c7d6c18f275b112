#include "engine/calibration/frame_information.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kTurnSigma = 0.05;  // rad, of the helicopter's pose as it is told
constexpr int kManyFrames = 20000;

/// A frame whose pixels are exact and whose pose is turned at random.
StoredFrame turnedFrame(const CameraModel& camera, const MarkerLayout& markers,
                        const RigidTransform& camera_from_world, Random& random) {
  const auto normal3 = [&] { return Eigen::Vector3d(random.normal(), random.normal(), random.normal()); };
  StoredFrame frame;
  RigidTransform truth;
  truth.translation = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), random.uniform(0.2, 0.6)};
  truth.rotation = expSO3({0.1 * random.normal(), 0.1 * random.normal(), random.uniform(-1.0, 1.0)});
  frame.world_from_body = truth;
  frame.world_from_body.rotation = truth.rotation * expSO3(-kTurnSigma * normal3());
  frame.pose_covariance.bottomRightCorner<3, 3>() = kTurnSigma * kTurnSigma * Eigen::Matrix3d::Identity();
  for (int m = 0; m < markers.count(); ++m)
    frame.pixels[static_cast<std::size_t>(frame.count++)] = {
        markerId(m), *camera.project(camera_from_world * (truth * markers.inBody(markerId(m)))),
        0.25 * Eigen::Matrix2d::Identity()};
  return frame;
}

TEST(FrameInformation, PosesThatAreTurnedAtRandomDoNotPushTheCameraAway) {
  const CameraModel camera(640, 480, 567.6, 567.6, 319.5, 239.5);
  const MarkerLayout markers = MarkerLayout::paper();
  RigidTransform camera_from_world;
  camera_from_world.rotation = expSO3({toRadians(-130.0), 0.0, 0.0});
  camera_from_world.translation = {0.0, 0.0, 2.8};
  Random random(1);
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  for (int i = 0; i < kManyFrames; ++i) {
    const StoredFrame frame = turnedFrame(camera, markers, camera_from_world, random);
    const FrameInformation seen =
        frameInformation(camera, markers, frame, camera_from_world, {1000.0, Vector6d::Zero()});
    hessian += seen.hessian;
    gradient += seen.gradient;
  }
  // Of the step that the frames ask for: 6 on average where it is chance.
  EXPECT_LT(gradient.dot(hessian.ldlt().solve(gradient)), 22.5);
}

}  // namespace
}  // namespace helical
