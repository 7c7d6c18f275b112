// The field that calibration is studied in tells the helicopter's pose as truly as it says.

#include "engine/experiments/calibration_field.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

struct PosesOfAField {
  double share = 0.0;  ///< of the frames that have one
  double nees = 0.0;   ///< 6 where the covariance is true
};

PosesOfAField posesAt(double outliers) {
  CalibrationFieldOptions options;
  options.markers = MarkerLayout::paper();
  options.outliers = outliers;
  PosesOfAField poses;
  double frames = 0.0, known = 0.0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const CalibrationField::Frame& frame : simulateCalibrationField(seed, options).frames) {
      frames += 1.0;
      if (!frame.has_pose) continue;
      known += 1.0;
      const Eigen::Quaterniond turned =
          frame.true_world_from_body.rotation.conjugate() * frame.world_from_body.rotation;
      Vector6d error;
      error << frame.world_from_body.translation - frame.true_world_from_body.translation, logSO3(turned);
      poses.nees += error.dot(frame.pose_covariance.ldlt().solve(error));
    }
  poses.share = known / frames;
  poses.nees /= known;
  return poses;
}

TEST(CalibrationField, HasTruePosesWithFewOutliers) {
  const PosesOfAField poses = posesAt(0.01);
  EXPECT_GT(poses.share, 0.999);
  EXPECT_NEAR(poses.nees, 6.0, 0.3);
}

/// Three in ten thrown aside, five balls of eight are left in three frames of four.
TEST(CalibrationField, HasTruePosesWhenThreeBallsInTenAreThrownAside) {
  const PosesOfAField poses = posesAt(0.3);
  EXPECT_GT(poses.share, 0.7);
  EXPECT_NEAR(poses.nees, 6.0, 2.0);
}

/// Seven balls in ten hold seven tenths of what all of them would, and of the pose less.
TEST(CalibrationField, TheBoundOfTrueBallsIsTheHigherOne) {
  CalibrationFieldOptions options;
  options.markers = MarkerLayout::paper();
  options.outliers = 0.3;
  const CalibrationField::Frame last = simulateCalibrationField(1, options).frames.back();
  EXPECT_GT(last.true_bound.position_m, 1.19 * last.bound.position_m);
  EXPECT_LT(last.true_bound.position_m, 1.6 * last.bound.position_m);
  options.outliers = 0.0;
  const CalibrationField::Frame clean = simulateCalibrationField(1, options).frames.back();
  EXPECT_EQ(clean.true_bound.position_m, clean.bound.position_m);
}

}  // namespace
}  // namespace helical
