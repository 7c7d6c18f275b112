#include "engine/config/rig_file.h"

#include <gtest/gtest.h>

#include "engine/config/resource_files.h"
#include "engine/geometry/rotation.h"
#include "tests/config/rig_text.h"

namespace helical {
namespace {

TEST(RigFile, ReadsWhatTheFileSays) {
  const RigConfig rig = parseRig(goodRig(), "good.toml");
  ASSERT_EQ(rig.cameras.size(), 1u);
  const CameraConfig& camera = rig.cameras[0];
  EXPECT_EQ(rig.path, "good.toml");
  EXPECT_EQ(camera.label, "left");
  EXPECT_EQ(camera.name, "Camera left");
  EXPECT_EQ(camera.source, "");
  EXPECT_EQ(camera.model.width(), 640);
  EXPECT_EQ(camera.model.height(), 480);
  EXPECT_EQ(camera.model.fx(), 567.6);
  EXPECT_EQ(camera.model.fy(), 560.1);
  EXPECT_EQ(camera.model.cx(), 319.5);
  EXPECT_EQ(camera.model.cy(), 239.0);
  EXPECT_EQ(camera.model.distortion(), (std::array<double, 8>{-0.05, 0.01, 0.001, -0.002, 0.003}));
  ASSERT_TRUE(camera.camera_from_world);
  EXPECT_FALSE(camera.pose_is_guess);
  EXPECT_TRUE(camera.camera_from_world->rotation.isApprox(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)));
  EXPECT_EQ(camera.camera_from_world->translation, Eigen::Vector3d(0.1, -0.2, 3.0));
  EXPECT_EQ(rig.marker_options.hue_low, 50);
  EXPECT_EQ(rig.simulation.gust_factor, 0.5);
}

TEST(RigFile, TakesTheRationalModelAndACovariance) {
  std::string rig = replaced(goodRig(), "0.003]", "0.003, 0.1, 0.2, 0.3]");
  std::string rows = "[camera.pose]\ncovariance = [";
  for (int i = 0; i < 36; ++i) rows += i % 7 == 0 ? "1e-4, " : "1e-5, ";
  rig = replaced(rig, "[camera.pose]", rows + "]");
  const CameraConfig camera = parseRig(rig, "good.toml").cameras[0];
  EXPECT_EQ(camera.model.distortion()[7], 0.3);
  EXPECT_TRUE(camera.model.rational());
  ASSERT_TRUE(camera.pose_covariance);
  EXPECT_EQ((*camera.pose_covariance)(3, 3), 1e-4);
  EXPECT_EQ((*camera.pose_covariance)(3, 5), 1e-5);
  EXPECT_ANY_THROW(parseRig(replaced(rig, "covariance = [1e-4", "covariance = [-1e-4"), "bad.toml"));
}

TEST(RigFile, TakesAreasThatAreToBeIgnored) {
  EXPECT_TRUE(parseRig(goodRig(), "r").cameras[0].ignored_areas.empty());
  const RigConfig rig = parseRig(
      replaced(goodRig(), "size =",
               "ignored_areas_px = [[[0, 0], [99.5, 0], [0, 50]], [[9, 9], [8, 9], [8, 8], [9, 8]]]\nsize ="),
      "r");
  const IgnoredAreas& areas = rig.cameras[0].ignored_areas;
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_EQ(areas[0], (Polygon{{0.0, 0.0}, {99.5, 0.0}, {0.0, 50.0}}));
  EXPECT_EQ(areas[1].size(), 4U);
}

TEST(RigFile, WhatTheFileLeavesOutStaysAtItsDefault) {
  const RigConfig rig = parseRig(goodRig(), "good.toml");
  EXPECT_EQ(rig.marker_options.hue_high, MarkerOptions().hue_high);
  EXPECT_EQ(rig.control.position_p, ControllerOptions().position_p);
  EXPECT_EQ(rig.helicopter.mass, HelicopterParameters::xrb().mass);
  EXPECT_EQ(rig.markers_in_body.count(), MarkerLayout::paper().count());
}

TEST(RigFile, AnglesBecomeRadiansAndOtherUnitsStay) {
  const RigConfig rig = parseRig(goodRig() + R"(
[helicopter]
model = "coax"
markers_m = [[0.1, 0.1, 0.0], [-0.1, 0.1, 0.0], [0.0, -0.1, 0.0]]
marker_radius_m = 0.02
[helicopter.parameters]
mass_kg = 0.3
swash_plate_range_deg = 10
[helicopter.parameters.lower]
phase_offset_deg = -45.0
[flight]
phase_deg = 12.0
position_error_limit_m = 0.4
[safety]
tilt_limit_deg = 45
descent_speed_m_s = 0.4
[tracking]
gate_chi2 = 12.0
[calibration]
method = "particle-filter"
guess_rotation_deg = 30.0
particles = 4000
kept_frames = 200
marker_sigma_m = 0.001
focal_sigma = 0.005
[simulation.noise]
outliers = 0.05
[transmitter]
kind = "simulated"
)",
                                 "good.toml");
  EXPECT_EQ(rig.markers_in_body.count(), 3);
  EXPECT_EQ(rig.markers_in_body.radius(), 0.02);
  EXPECT_EQ(rig.helicopter.mass, 0.3);
  EXPECT_EQ(rig.helicopter.inertia_x, HelicopterParameters::coax().inertia_x);
  EXPECT_DOUBLE_EQ(rig.helicopter.swash_plate_range, toRadians(10.0));
  EXPECT_DOUBLE_EQ(rig.helicopter.lower.phase_offset, toRadians(-45.0));
  EXPECT_EQ(rig.helicopter.upper.phase_offset, HelicopterParameters::coax().upper.phase_offset);
  EXPECT_DOUBLE_EQ(rig.control.phase, toRadians(12.0));
  EXPECT_EQ(rig.control.position_error_limit, 0.4);
  EXPECT_DOUBLE_EQ(rig.safety.tilt_limit, toRadians(45.0));
  EXPECT_EQ(rig.safety.descent_speed, 0.4);
  EXPECT_EQ(rig.tracking.gate_chi2, 12.0);
  EXPECT_EQ(rig.calibrator, "particle-filter");
  EXPECT_DOUBLE_EQ(rig.calibration.guess.rotation_rad, toRadians(30.0));
  EXPECT_EQ(rig.calibration.particle_filter.particles, 4000);
  EXPECT_EQ(rig.calibration.growing_gauss_newton.kept_frames, 200);
  EXPECT_EQ(rig.self_calibration.marker_sigma_m, 0.001);
  EXPECT_EQ(rig.self_calibration.focal_sigma, 0.005);
  EXPECT_EQ(rig.simulation.noise.outliers, 0.05);
}

TEST(RigFile, TheSimulatedFieldMayBeOtherThanTheRigSays) {
  const std::string wrong = "[simulation]\nmarker_error_m = 0.002\nfocal_error = 0.003";
  const RigConfig rig = parseRig(replaced(goodRig(), "[simulation]", wrong), "r");
  EXPECT_EQ(rig.simulation.marker_error_m, 0.002);
  EXPECT_EQ(rig.simulation.focal_error, 0.003);
}

TEST(RigFile, AnAlmostNormalQuaternionIsNormalised) {
  const RigConfig rig =
      parseRig(replaced(goodRig(), "[0.5, 0.5, -0.5, 0.5]", "[0.5003, 0.5003, -0.5, 0.5]"), "r");
  EXPECT_NEAR(rig.cameras[0].camera_from_world->rotation.norm(), 1.0, 1e-15);
}

TEST(RigFile, ACameraWithoutPoseIsUncalibratedAndAGuessIsMarkedAsSuch) {
  const std::string rig = goodRig();
  const std::string without = rig.substr(0, rig.find("[camera.pose]"));
  EXPECT_FALSE(parseRig(without, "r").cameras[0].camera_from_world);
  EXPECT_TRUE(parseRig(replaced(rig, "[camera.pose]", "[camera.pose]\ninitial = true"), "r")
                  .cameras[0]
                  .pose_is_guess);
}

TEST(RigFile, CamerasAreFoundByTheirLabel) {
  const RigConfig rig = loadRig(resourceFolder() / "rigs" / "paper.toml");
  EXPECT_EQ(rig.camera("2").index(), 1);
  const Error error = errorOf([&] { rig.camera("4"); });
  EXPECT_EQ(error.kind(), ErrorKind::kInput);
  EXPECT_EQ(error.cure(), "this rig's cameras are: 1, 2, 3");
}

/// Both shipped rigs are the paper's figure 4; cameras see the volume in which the helicopter flies.
TEST(RigFile, ShippedRigsHaveThreeCamerasThatLookAtTheField) {
  const RigConfig paper = loadRig(resourceFolder() / "rigs" / "paper.toml");
  const RigConfig calibrated = loadRig(resourceFolder() / "rigs" / "calibrated.toml");
  ASSERT_EQ(paper.cameras.size(), 3u);
  ASSERT_EQ(calibrated.cameras.size(), 3u);
  EXPECT_FALSE(paper.cameras[2].camera_from_world);
  for (std::size_t i = 0; i < 3; ++i) {
    const RigidTransform& truth = *calibrated.cameras[i].camera_from_world;
    const auto& own = paper.cameras[i].camera_from_world;
    const RigidTransform& same = own ? *own : *paper.simulation.true_camera_from_world[i];
    EXPECT_TRUE(same.rotation.isApprox(truth.rotation, 1e-12));
    EXPECT_TRUE(same.translation.isApprox(truth.translation, 1e-12));
    EXPECT_GT(truth.inverseTranslation().z(), 1.5) << "cameras look down";
    for (const Eigen::Vector3d& corner : {Eigen::Vector3d(-0.5, -0.5, 0.0), Eigen::Vector3d(0.5, -0.5, 0.9),
                                         Eigen::Vector3d(-0.5, 0.5, 0.9), Eigen::Vector3d(0.5, 0.5, 0.0)}) {
      const auto pixel = calibrated.cameras[i].model.project(truth * corner);
      ASSERT_TRUE(pixel);
      EXPECT_TRUE(calibrated.cameras[i].model.contains(*pixel))
          << "camera " << i + 1 << ": " << pixel->transpose();
    }
  }
}

}  // namespace
}  // namespace helical
