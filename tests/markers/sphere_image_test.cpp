#include "engine/markers/sphere_image.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace helical {
namespace {

/// Centre and radius (of the disc of its area) of the outline of a ball: rays that touch it.
Centroid outlineOf(const CameraModel& camera, const Eigen::Vector3d& ball, double radius) {
  constexpr int kRays = 2000;
  const Eigen::Vector3d axis = ball.normalized(), side = axis.unitOrthogonal();
  const double half_angle = std::asin(radius / ball.norm());
  Centroid centroid;
  Eigen::Vector2d last, moment = Eigen::Vector2d::Zero();
  double area = 0.0;
  for (int i = 0; i <= kRays; ++i) {
    const Eigen::Vector3d around = Eigen::AngleAxisd(2.0 * M_PI * i / kRays, axis) * side;
    const Eigen::Vector2d here =
        *camera.project(std::cos(half_angle) * axis + std::sin(half_angle) * around);
    if (i > 0) {
      const double twice = last.x() * here.y() - last.y() * here.x();
      area += 0.5 * twice;
      moment += twice / 6.0 * (last + here);
    }
    last = here;
  }
  centroid.pixel = moment / area;
  centroid.radius_px = std::sqrt(std::abs(area) / M_PI);
  return centroid;
}

TEST(SphereImage, CentroidsMoveToWhereTheCentresAreSeen) {
  const std::array<double, 8> lens{-0.05, 0.01, 0.0, 0.0, 0.0};
  double largest = 0.0;
  for (const CameraModel& camera : {CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5),
                                    CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5, lens)})
    for (const double depth : {0.8, 1.2, 2.0})
      for (const Eigen::Vector2d& bearing : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.5, 0.3),
                                            Eigen::Vector2d(-0.45, -0.35)}) {
        const Eigen::Vector3d ball = depth * Eigen::Vector3d(bearing.x(), bearing.y(), 1.0);
        Observation seen;
        seen.count = 1;
        seen.centroids[0] = outlineOf(camera, ball, 0.018);
        const Eigen::Vector2d truth = *camera.project(ball);
        const double before = (seen.centroids[0].pixel - truth).norm();
        largest = std::max(largest, before);
        moveToBallCentres(camera, seen);
        EXPECT_LT((seen.centroids[0].pixel - truth).norm(), 0.15 * before + 1e-4);
      }
  EXPECT_GT(largest, 0.1);
}

}  // namespace
}  // namespace helical
