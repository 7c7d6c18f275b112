#include "ui/orbit_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace helical {
namespace {

TEST(OrbitView, FollowKeepsTheHelicopterInTheMiddle) {
  OrbitView view;
  const Eigen::Vector3d helicopter(0.4, -0.2, 0.9);
  const Eigen::Vector3d eye_before = view.eye();
  view.track(helicopter);
  EXPECT_TRUE(view.focus().isApprox(helicopter));
  EXPECT_TRUE((view.eye() - eye_before).isApprox(helicopter)) << "the eye goes with it";
}

TEST(OrbitView, OtherViewsStayWhereTheyAre) {
  for (const auto viewpoint : {SceneViewpoint::kTop, SceneViewpoint::kIso}) {
    OrbitView view;
    view.look(viewpoint);
    const Eigen::Vector3d eye = view.eye();
    view.track({1.0, 1.0, 1.0});
    EXPECT_TRUE(view.eye().isApprox(eye));
  }
}

TEST(OrbitView, TopLooksDownWithTheNoseToTheRight) {
  OrbitView view;
  view.look(SceneViewpoint::kTop);
  const Eigen::Vector3d forward = (view.focus() - view.eye()).normalized();
  EXPECT_NEAR(forward.z(), -1.0, 1e-9);
  EXPECT_TRUE(forward.cross(view.up()).isApprox(Eigen::Vector3d::UnitX(), 1e-9));
}

TEST(OrbitView, UpStaysPerpendicularAndTheEyeAboveTheFloorWhateverIsTurned) {
  OrbitView view;
  for (int i = 0; i < 200; ++i) {
    view.turn(0.37 * i, i % 2 ? 0.9 : -0.7);
    const Eigen::Vector3d forward = (view.focus() - view.eye()).normalized();
    EXPECT_NEAR(forward.dot(view.up()), 0.0, 1e-9);
    EXPECT_GE(view.up().z(), -1e-9);
  }
}

TEST(OrbitView, PanningHoldsWhileFollowing) {
  OrbitView view;
  view.track(Eigen::Vector3d::Zero());
  view.pan(0.2, 0.1);
  const Eigen::Vector3d offset = view.focus();
  EXPECT_GT(offset.norm(), 0.0);
  view.track({1.0, 0.0, 0.0});
  EXPECT_TRUE(view.focus().isApprox(offset + Eigen::Vector3d::UnitX()));
}

/// Cameras on a ring, as high as a man.
std::vector<Eigen::Vector3d> ring(double radius) {
  std::vector<Eigen::Vector3d> points{{0.0, 0.0, 0.0}};
  for (int i = 0; i < 16; ++i)
    points.emplace_back(radius * std::cos(0.39 * i), radius * std::sin(0.39 * i), i % 2 ? 2.4 : 1.1);
  return points;
}

/// The largest distance of a point from the middle of the picture; 1 is its border.
double farthestFromMiddle(const OrbitView& view, const std::vector<Eigen::Vector3d>& points, double aspect) {
  const Eigen::Vector3d forward = (view.focus() - view.eye()).normalized(), right = forward.cross(view.up());
  double farthest = 0.0;
  for (const Eigen::Vector3d& point : points) {
    const Eigen::Vector3d from_eye = point - view.eye();
    const double depth = forward.dot(from_eye) * std::tan(0.5 * OrbitView::kFieldOfView);
    EXPECT_GT(depth, 0.0);
    farthest = std::max({farthest, std::abs(view.up().dot(from_eye)) / depth,
                         std::abs(right.dot(from_eye)) / depth / aspect});
  }
  return farthest;
}

TEST(OrbitView, TopAndIsoShowAllOfTheFieldAndNotMuchMore) {
  for (const auto viewpoint : {SceneViewpoint::kTop, SceneViewpoint::kIso})
    for (const double radius : {1.0, 3.5, 8.0})
      for (const double aspect : {0.6, 1.7}) {
        OrbitView view;
        view.look(viewpoint);
        view.setField(ring(radius), aspect);
        EXPECT_LT(farthestFromMiddle(view, ring(radius), aspect), 0.95) << radius << " " << aspect;
        EXPECT_GT(farthestFromMiddle(view, ring(radius), aspect), 0.75) << radius << " " << aspect;
      }
}

TEST(OrbitView, WhatSomebodyTurnedByHandStaysUntilAViewIsChosen) {
  OrbitView view;
  view.look(SceneViewpoint::kIso);
  view.turn(0.3, 0.1);
  const Eigen::Vector3d eye = view.eye();
  view.setField(ring(8.0), 1.7);
  EXPECT_EQ(view.eye(), eye);
  view.look(SceneViewpoint::kIso);
  EXPECT_LT(farthestFromMiddle(view, ring(8.0), 1.7), 0.95);
}

TEST(OrbitView, ZoomHasItsLimits) {
  OrbitView view;
  for (int i = 0; i < 500; ++i) view.zoom(0.8);
  EXPECT_GT((view.eye() - view.focus()).norm(), 0.1);
  for (int i = 0; i < 500; ++i) view.zoom(1.3);
  EXPECT_LT((view.eye() - view.focus()).norm(), 100.0);
}

}  // namespace
}  // namespace helical
