#include "ui/waypoint_drag.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace helical {
namespace {

using Eigen::Vector3d;

/// An eye at (0, -4, 2) that looks at (0, 0, 0.5), 90 degrees wide.
SceneProjection projection() {
  const Vector3d eye(0.0, -4.0, 2.0), focus(0.0, 0.0, 0.5);
  const Vector3d z = (eye - focus).normalized(), x = Vector3d::UnitZ().cross(z).normalized(), y = z.cross(x);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = x.transpose();
  view.block<1, 3>(1, 0) = y.transpose();
  view.block<1, 3>(2, 0) = z.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye;
  const double near = 0.1, far = 80.0, aspect = 800.0 / 600.0;
  Eigen::Matrix4d perspective = Eigen::Matrix4d::Zero();
  perspective(0, 0) = 1.0 / aspect;
  perspective(1, 1) = 1.0;
  perspective(2, 2) = -(far + near) / (far - near);
  perspective(2, 3) = -2.0 * far * near / (far - near);
  perspective(3, 2) = -1.0;
  return {perspective * view, QSizeF(800.0, 600.0)};
}

TEST(SceneProjection, WhatIsLookedAtIsInTheMiddle) {
  const auto middle = projection().toWidget({0.0, 0.0, 0.5});
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x(), 400.0, 1e-9);
  EXPECT_NEAR(middle->y(), 300.0, 1e-9);
  EXPECT_FALSE(projection().toWidget({0.0, -9.0, 4.0})) << "behind the eye";
}

TEST(SceneProjection, TheRayThroughAPointMeetsIt) {
  const SceneProjection view = projection();
  for (const Vector3d& point : {Vector3d(0.3, 0.2, 0.9), Vector3d(-1.0, 2.0, 0.0)}) {
    const SceneProjection::Ray ray = view.through(*view.toWidget(point));
    EXPECT_LT(ray.direction.cross(point - ray.origin).norm(), 1e-6);
    EXPECT_GT(ray.direction.dot(point - ray.origin), 0.0);
  }
}

TEST(WaypointDrag, TakesTheNearestWithinReach) {
  const SceneProjection view = projection();
  const std::vector<Vector3d> plan{{0.0, 0.0, 0.6}, {0.05, 0.0, 0.6}, {1.0, 0.0, 0.6}};
  const QPointF second = *view.toWidget(plan[1]);
  EXPECT_EQ(WaypointDrag::at(second + QPointF(1.0, 1.0), plan, view), 1);
  EXPECT_EQ(WaypointDrag::at(second + QPointF(0.0, 60.0), plan, view), -1);
  EXPECT_EQ(WaypointDrag::at(second, {}, view), -1);
}

TEST(WaypointDrag, OverTheGroundTheHeightStays) {
  const SceneProjection view = projection();
  const Vector3d from(0.2, 0.1, 0.6), to(-0.4, 0.7, 0.6);
  const auto moved = WaypointDrag::moved(from, *view.toWidget(to), view, false);
  ASSERT_TRUE(moved);
  EXPECT_LT((*moved - to).norm(), 1e-6);
}

TEST(WaypointDrag, UpAndDownThePlaceStays) {
  const SceneProjection view = projection();
  const Vector3d from(0.0, 0.1, 0.6), to(0.0, 0.1, 1.1);
  const auto moved = WaypointDrag::moved(from, *view.toWidget(to), view, true);
  ASSERT_TRUE(moved);
  EXPECT_LT((*moved - to).norm(), 1e-6);
}

TEST(WaypointDrag, PastTheHorizonNothingMoves) {
  const SceneProjection view = projection();
  EXPECT_FALSE(WaypointDrag::moved({0.0, 0.0, 0.6}, {400.0, -4000.0}, view, false));
}

}  // namespace
}  // namespace helical
