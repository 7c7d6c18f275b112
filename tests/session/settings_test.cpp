#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "engine/base/error.h"
#include "engine/pipeline/first_guess.h"
#include "engine/session/session_settings.h"
#include "tests/session/session_fixture.h"

namespace helical {
namespace {

TEST(SessionSettings, WhatTheCommandLineChangedComesBackToTheLastBit) {
  SessionSettings settings = test::hoverSettings(77);
  RigConfig& rig = settings.rig;
  giveFirstGuesses(rig, 0.3, 0.4, 77, false);
  rig.calibrator = "ekf";
  rig.tracker = "paper";
  rig.learn_from_own_pose = true;
  rig.self_calibration = {1e-3, 0.01};
  rig.simulation.marker_error_m = 2e-3;
  rig.simulation.focal_error = 0.003;
  const MarkerLayout told = rig.markers_in_body;
  const CameraModel lens = rig.cameras[1].model;
  std::vector<Eigen::Vector3d> balls(told.all().begin(), told.all().end());
  balls[2].x() += 1.0 / 3000.0;
  rig.replaceMarkers(balls);
  rig.replaceFocalLengths(1, 1.0 + 1.0 / 300.0);
  rig.simulation.noise.outliers = 0.1;
  rig.simulation.occlusions.push_back({cameraId(1), 13.0, 25.1});
  rig.simulation.bumps.push_back({cameraId(2), 10.0, 0.1, 0.05});
  settings.plan.land_at_s = 12.3;
  settings.realtime = true;
  const SessionSettings back = fromAttachments(toAttachments(settings), "a.mcap");
  EXPECT_EQ(back.rig_text, settings.rig_text);
  EXPECT_EQ(back.plan_text, settings.plan_text);
  EXPECT_EQ(back.rig.calibrator, "ekf");
  EXPECT_EQ(back.rig.tracker, "paper");
  EXPECT_TRUE(back.rig.learn_from_own_pose);
  EXPECT_TRUE(back.realtime);
  EXPECT_EQ(back.plan.land_at_s, 12.3);
  EXPECT_EQ(back.rig.simulation.seed, 77u);
  EXPECT_FALSE(back.rig.simulation.images);
  EXPECT_EQ(back.rig.simulation.noise.outliers, 0.1);
  EXPECT_EQ(back.rig.self_calibration.marker_sigma_m, 1e-3);
  EXPECT_EQ(back.rig.self_calibration.focal_sigma, 0.01);
  EXPECT_EQ(back.rig.simulation.marker_error_m, 2e-3);
  EXPECT_EQ(back.rig.simulation.focal_error, 0.003);
  EXPECT_TRUE(std::ranges::equal(back.rig.markers_in_body.all(), balls));
  ASSERT_TRUE(back.rig.simulation.markers_before.has_value()) << "the field is as the rig file has it";
  EXPECT_TRUE(std::ranges::equal(back.rig.simulation.markers_before->all(), told.all()));
  EXPECT_EQ(back.rig.cameras[1].model.fx(), rig.cameras[1].model.fx());
  EXPECT_EQ(back.rig.simulation.models_before.at(1)->fx(), lens.fx());
  EXPECT_EQ(back.rig.cameras[0].model.fx(), rig.cameras[0].model.fx());
  ASSERT_EQ(back.rig.simulation.occlusions.size(), 1u);
  EXPECT_EQ(back.rig.simulation.occlusions[0].to_s, 25.1);
  ASSERT_EQ(back.rig.simulation.bumps.size(), 1u);
  EXPECT_EQ(back.rig.simulation.bumps[0].camera, cameraId(2));
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    ASSERT_TRUE(back.rig.cameras[i].camera_from_world.has_value());
    EXPECT_EQ(back.rig.cameras[i].camera_from_world->rotation.coeffs(),
              rig.cameras[i].camera_from_world->rotation.coeffs());
    EXPECT_EQ(back.rig.cameras[i].camera_from_world->translation,
              rig.cameras[i].camera_from_world->translation);
    EXPECT_EQ(back.rig.cameras[i].pose_is_guess, rig.cameras[i].pose_is_guess);
  }
  EXPECT_TRUE(back.rig.simulation.true_camera_from_world.back().has_value());
}

TEST(SessionSettings, WhatIsMissingOrMakesNoSenseIsNamed) {
  const auto attachments = toAttachments(test::hoverSettings(1));
  for (std::size_t i = 0; i < attachments.size(); ++i) {
    auto some = attachments;
    some.erase(some.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_THROW(fromAttachments(some, "a.mcap"), Error) << i;
    some = attachments;
    some[i].content = "{\"cameras\": 3}";
    EXPECT_THROW(fromAttachments(some, "a.mcap"), Error) << i;
  }
}

}  // namespace
}  // namespace helical
