#include "ui/orbit_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace helical {
namespace {

constexpr double kReach = 2.5;

TEST(OrbitView, FollowKeepsTheHelicopterInTheMiddle) {
  OrbitView view(kReach);
  const Eigen::Vector3d helicopter(0.4, -0.2, 0.9);
  const Eigen::Vector3d eye_before = view.eye();
  view.track(helicopter);
  EXPECT_TRUE(view.focus().isApprox(helicopter));
  EXPECT_TRUE((view.eye() - eye_before).isApprox(helicopter)) << "the eye goes with it";
}

TEST(OrbitView, OtherViewsStayWhereTheyAre) {
  for (const auto viewpoint : {SceneViewpoint::kTop, SceneViewpoint::kIso}) {
    OrbitView view(kReach);
    view.look(viewpoint);
    const Eigen::Vector3d eye = view.eye();
    view.track({1.0, 1.0, 1.0});
    EXPECT_TRUE(view.eye().isApprox(eye));
  }
}

TEST(OrbitView, TopLooksDownWithTheNoseToTheRight) {
  OrbitView view(kReach);
  view.look(SceneViewpoint::kTop);
  const Eigen::Vector3d forward = (view.focus() - view.eye()).normalized();
  EXPECT_NEAR(forward.z(), -1.0, 1e-9);
  EXPECT_TRUE(forward.cross(view.up()).isApprox(Eigen::Vector3d::UnitX(), 1e-9));
}

TEST(OrbitView, UpStaysPerpendicularAndTheEyeAboveTheFloorWhateverIsTurned) {
  OrbitView view(kReach);
  for (int i = 0; i < 200; ++i) {
    view.turn(0.37 * i, i % 2 ? 0.9 : -0.7);
    const Eigen::Vector3d forward = (view.focus() - view.eye()).normalized();
    EXPECT_NEAR(forward.dot(view.up()), 0.0, 1e-9);
    EXPECT_GE(view.up().z(), -1e-9);
  }
}

TEST(OrbitView, PanningHoldsWhileFollowing) {
  OrbitView view(kReach);
  view.track(Eigen::Vector3d::Zero());
  view.pan(0.2, 0.1);
  const Eigen::Vector3d offset = view.focus();
  EXPECT_GT(offset.norm(), 0.0);
  view.track({1.0, 0.0, 0.0});
  EXPECT_TRUE(view.focus().isApprox(offset + Eigen::Vector3d::UnitX()));
}

TEST(OrbitView, ZoomHasItsLimits) {
  OrbitView view(kReach);
  for (int i = 0; i < 500; ++i) view.zoom(0.8);
  EXPECT_GT((view.eye() - view.focus()).norm(), 0.1);
  for (int i = 0; i < 500; ++i) view.zoom(1.3);
  EXPECT_LT((view.eye() - view.focus()).norm(), 100.0);
}

}  // namespace
}  // namespace helical
