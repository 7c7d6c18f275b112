#include "engine/geometry/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/geometry/random_geometry.h"

namespace helical {
namespace {

CameraModel plain() {
  return CameraModel(640, 480, 567.6, 560.0, 319.5, 239.5);
}
CameraModel distorted() {
  return CameraModel(640, 480, 567.6, 560.0, 322.0, 236.0, {-0.25, 0.08, 0.001, -0.002, 0.01});
}

/// As a wide-angle webcam distorts.
CameraModel rational() {
  return CameraModel(640, 480, 567.6, 560.0, 322.0, 236.0, {0.9, 0.2, 0.001, -0.002, 0.02, 1.25, 0.45, 0.08});
}

/// A point that a 640x480 camera sees, some centimetres to metres away.
Eigen::Vector3d visiblePoint(Random& random) {
  const double depth = random.uniform(0.1, 6.0);
  return {random.uniform(-0.5, 0.5) * depth, random.uniform(-0.4, 0.4) * depth, depth};
}

TEST(CameraModel, ProjectsByThePinholeWithoutDistortion) {
  const auto pixel = plain().project({0.2, -0.1, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_DOUBLE_EQ(pixel->x(), 567.6 * 0.1 + 319.5);
  EXPECT_DOUBLE_EQ(pixel->y(), 560.0 * -0.05 + 239.5);
}

/// The formula as OpenCV's documentation of calib3d prints it.
TEST(CameraModel, DistortsAsBrownAndConradyAndByTheRationalModel) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const CameraModel camera = i % 2 == 0 ? distorted() : rational();
    const auto& [k1, k2, p1, p2, k3, k4, k5, k6] = camera.distortion();
    const Eigen::Vector3d point = visiblePoint(random);
    const double x = point.x() / point.z(), y = point.y() / point.z(), r2 = x * x + y * y;
    const double radial = (1 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2) /
                          (1 + k4 * r2 + k5 * r2 * r2 + k6 * r2 * r2 * r2);
    const double u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
    const double v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
    const auto pixel = camera.project(point);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), 567.6 * u + 322.0, 1e-9);
    EXPECT_NEAR(pixel->y(), 560.0 * v + 236.0, 1e-9);
  }
}

TEST(CameraModel, JacobianIsTheDerivative) {
  Random random(2);
  for (const CameraModel& camera : {plain(), distorted(), rational()})
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d point = visiblePoint(random);
      Eigen::Matrix<double, 2, 3> jacobian;
      ASSERT_TRUE(camera.project(point, &jacobian));
      const auto f = [&](const Eigen::VectorXd& p) -> Eigen::VectorXd { return *camera.project(p); };
      const Eigen::MatrixXd numeric = numericJacobian(f, point, 1e-6 * point.z());
      EXPECT_LT((jacobian - numeric).norm(), 1e-6 * numeric.norm()) << point.transpose();
    }
}

TEST(CameraModel, BearingUndoesProjection) {
  Random random(3);
  for (const CameraModel& camera : {plain(), distorted(), rational()})
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Vector3d point = visiblePoint(random);
      const auto pixel = camera.project(point);
      ASSERT_TRUE(pixel);
      EXPECT_LT((camera.bearing(*pixel) - point.head<2>() / point.z()).norm(), 1e-12) << point.transpose();
    }
}

TEST(CameraModel, DoesNotSeeWhatIsBehindTooNearOrFoldedBack) {
  EXPECT_FALSE(plain().project({0.0, 0.0, -1.0}));
  EXPECT_FALSE(plain().project({0.0, 0.0, 0.0}));
  EXPECT_FALSE(plain().project({0.0, 0.0, 0.049}));
  EXPECT_FALSE(plain().project({0.0, 0.0, std::nan("")}));
  EXPECT_TRUE(plain().project({3.0, 0.0, 1.0})) << "outside the image, but in front of the camera";
  const CameraModel barrel(640, 480, 567.6, 567.6, 319.5, 239.5, {-0.3, 0.0, 0.0, 0.0, 0.0});
  EXPECT_TRUE(barrel.project({0.9, 0.0, 1.0}));
  EXPECT_FALSE(barrel.project({1.2, 0.0, 1.0})) << "1 - 3 * 0.3 * 1.44 < 0: the polynomial turns back";
}

TEST(CameraModel, ContainsPixelsUpToTheOuterEdges) {
  const CameraModel camera = plain();
  for (const Eigen::Vector2d& inside : {Eigen::Vector2d(-0.5, -0.5), Eigen::Vector2d(639.5, 479.5)})
    EXPECT_TRUE(camera.contains(inside));
  for (const Eigen::Vector2d& outside : {Eigen::Vector2d(-0.6, 0.0), Eigen::Vector2d(0.0, -0.6),
                                         Eigen::Vector2d(639.6, 0.0), Eigen::Vector2d(0.0, 479.6)})
    EXPECT_FALSE(camera.contains(outside));
  EXPECT_TRUE(camera.contains({9.5, 9.5}, 10.0));
  EXPECT_FALSE(camera.contains({9.4, 100.0}, 10.0));
  EXPECT_FALSE(camera.contains({std::nan(""), 100.0}));
}

}  // namespace
}  // namespace helical
