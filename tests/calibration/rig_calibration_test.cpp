#include "engine/calibration/rig/rig_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/calibration/rig/point_structure.h"
#include "engine/calibration/rig/rig_covariance.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/rig_recording.h"

namespace helical {
namespace {

std::vector<std::optional<RigidTransform>> posesOf(const RigCalibration& calibration) {
  std::vector<std::optional<RigidTransform>> poses;
  for (const CalibratedCamera& c : calibration.cameras) poses.push_back(c.camera_from_world);
  return poses;
}

RigCalibration solve(const std::vector<RigCamera>& cameras, const PointRows& rows,
                     const RigCalibrationOptions& options = {}) {
  return calibrateRig(cameras, rows, "made up", options);
}

std::string reasonsOf(const RigCalibration& calibration) {
  std::string all;
  for (const std::string& reason : calibration.reasons) all += reason + "\n";
  return all;
}

TEST(RigCalibration, BoardSetsPosesAndScale) {
  RecordingOptions recording;
  recording.duration_s = 4.0;
  const MadeRecording made = wavedBoard(recording, 11);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(solved.verdict, RigVerdict::kGood) << reasonsOf(solved);
  EXPECT_EQ(solved.target, TargetKind::kBody);
  EXPECT_TRUE(solved.metric);
  const PoseErrors errors = poseErrors(made.cameras, posesOf(solved), false);
  EXPECT_LT(errors.degrees, 0.1);
  EXPECT_LT(errors.metres, 0.005);
  EXPECT_NEAR(solved.sigma_px, 0.5, 0.03);
}

/// As a user has them: points and focal lengths off the truth by these sigmas.
struct WrongBoard {
  MadeRecording made;
  std::vector<RigCamera> cameras;
  PointRows rows;
  std::vector<double> focal_errors;

  WrongBoard(double point_sigma_m, double focal_sigma, std::uint64_t seed) {
    RecordingOptions recording;
    recording.duration_s = 4.0;
    made = wavedBoard(recording, seed);
    cameras = made.unposed();
    rows = made.rows;
    Random random(seed + 500);
    for (RigCamera& camera : cameras) {
      focal_errors.push_back(focal_sigma * random.normal());
      camera.model = camera.model.withFocalScale(1.0 / (1.0 + focal_errors.back()));
    }
    std::map<std::pair<double, double>, Eigen::Vector3d> shifts;
    for (Eigen::Vector3d& point : rows.in_body) {
      const auto [shift, is_new] = shifts.try_emplace({point.x(), point.y()});
      if (is_new)
        shift->second = point_sigma_m * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      point += shift->second;
    }
  }
};

TEST(RigCalibration, PointsOfTheBodyThatAreOffAreFound) {
  const WrongBoard board(1e-3, 0.0, 21);
  RigCalibrationOptions options;
  options.self.marker_sigma_m = 1e-3;
  const RigCalibration plain = solve(board.cameras, board.rows),
                       refined = solve(board.cameras, board.rows, options);
  EXPECT_EQ(refined.verdict, RigVerdict::kGood) << reasonsOf(refined);
  EXPECT_LT(refined.sigma_px, plain.sigma_px);
  EXPECT_NEAR(refined.sigma_px, 0.5, 0.03);
  ASSERT_EQ(refined.points.size(), 24u);
  EXPECT_TRUE(plain.points.empty());
  // Distances are what images tell: the body's frame is the user's.
  double before = 0.0, after = 0.0;
  for (std::size_t a = 0; a < 24; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const auto truth = [](const CalibratedPoint& p) {
        return Eigen::Vector3d(0.06 * std::round(p.given.x() / 0.06), 0.06 * std::round(p.given.y() / 0.06),
                               0.0);
      };
      const double apart = (truth(refined.points[a]) - truth(refined.points[b])).norm();
      before += std::pow((refined.points[a].given - refined.points[b].given).norm() - apart, 2);
      after += std::pow((refined.points[a].found - refined.points[b].found).norm() - apart, 2);
    }
  // How large the whole is, nothing but the user's own coordinates tells.
  EXPECT_LT(after, 0.2 * before);
  EXPECT_LT(refined.points[0].sigma_m.value(), 1e-3);
  EXPECT_GT(refined.points[0].sigma_m.value(), 0.0);
  const double error = poseErrors(board.made.cameras, posesOf(refined), false).metres;
  EXPECT_LT(error, poseErrors(board.made.cameras, posesOf(plain), false).metres);
  EXPECT_GT(refined.cameras[1].position_sigma_m, plain.cameras[1].position_sigma_m)
      << "it knows less of the scale";
  for (const CalibratedCamera& c : refined.cameras) EXPECT_EQ(c.focal_scale, 1.0);
}

TEST(RigCalibration, FocalLengthsThatAreOffAreFound) {
  const WrongBoard board(0.0, 0.01, 22);
  RigCalibrationOptions options;
  options.self.focal_sigma = 0.01;
  const RigCalibration plain = solve(board.cameras, board.rows),
                       refined = solve(board.cameras, board.rows, options);
  EXPECT_EQ(refined.verdict, RigVerdict::kGood) << reasonsOf(refined);
  EXPECT_NEAR(refined.sigma_px, 0.5, 0.03);
  double squares = 0.0;
  for (std::size_t c = 0; c < board.cameras.size(); ++c) {
    const double off = refined.cameras[c].focal_scale - (1.0 + board.focal_errors[c]);
    EXPECT_LT(std::abs(off), 4.0 * refined.cameras[c].focal_sigma.value());
    EXPECT_LT(refined.cameras[c].focal_sigma.value(), 0.003);
    squares += off * off;
  }
  EXPECT_LT(std::sqrt(squares / 4.0), 0.002);
  EXPECT_LT(poseErrors(board.made.cameras, posesOf(refined), false).metres,
            0.5 * poseErrors(board.made.cameras, posesOf(plain), false).metres);
  EXPECT_TRUE(refined.points.empty());
}

/// It is the focal lengths that are wrong, not the poses.
TEST(RigCalibration, WrongFocalLengthsAreNotLaidAtGivenPosesDoor) {
  const WrongBoard board(0.0, 0.03, 24);
  std::vector<RigCamera> cameras = board.cameras;
  for (const std::size_t c : {0U, 1U}) cameras[c].camera_from_world = board.made.cameras[c].camera_from_world;
  RigCalibrationOptions options;
  options.self.focal_sigma = 0.03;
  const RigCalibration solved = solve(cameras, board.rows, options);
  EXPECT_EQ(reasonsOf(solved).find("given poses"), std::string::npos) << reasonsOf(solved);
  EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
  for (std::size_t c = 0; c < cameras.size(); ++c)
    EXPECT_NEAR(solved.cameras[c].focal_scale, 1.0 + board.focal_errors[c], 0.01) << c;
}

TEST(RigCalibration, WhereNothingIsOffRefiningSpoilsLittle) {
  const WrongBoard board(0.0, 0.0, 23);
  RigCalibrationOptions options;
  options.self = {1e-4, 0.002};
  const RigCalibration plain = solve(board.cameras, board.rows),
                       refined = solve(board.cameras, board.rows, options);
  EXPECT_EQ(refined.verdict, plain.verdict) << reasonsOf(refined);
  EXPECT_LT(poseErrors(board.made.cameras, posesOf(refined), false).metres, 0.01);
  for (const CalibratedCamera& c : refined.cameras)
    EXPECT_NEAR(c.focal_scale, 1.0, 4.0 * c.focal_sigma.value());
}

TEST(RigCalibration, WhatIsFartherOffThanItMayBeIsSaid) {
  const WrongBoard board(0.0, 0.03, 24);
  RigCalibrationOptions options;
  options.self.focal_sigma = 0.002;
  const RigCalibration refined = solve(board.cameras, board.rows, options);
  EXPECT_NE(refined.verdict, RigVerdict::kGood);
  EXPECT_NE(reasonsOf(refined).find("the focal length of camera"), std::string::npos) << reasonsOf(refined);
}

TEST(RigCalibration, RefiningNeedsABody) {
  RigCalibrationOptions options;
  options.self.focal_sigma = 0.01;
  const MadeRecording light = wavedLight({}, 25);
  EXPECT_THROW(solve(light.unposed(), light.rows, options), Error);
  options.self = {1e-3, 0.0};
  RecordingOptions recording;
  recording.duration_s = 4.0;
  MadeRecording board = wavedBoard(recording, 25);
  Random random(25);
  for (Eigen::Vector3d& point : board.rows.in_body) point.z() = 1e-6 * random.normal();
  EXPECT_THROW(solve(board.unposed(), board.rows, options), Error) << "every row has a point of its own";
}

TEST(RigCalibration, NamedMarkersGiveShapeButNoScale) {
  RecordingOptions recording;
  recording.duration_s = 5.0;
  const MadeRecording made = namedMarkers(recording, 12);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(solved.verdict, RigVerdict::kGood) << reasonsOf(solved);
  EXPECT_EQ(solved.target, TargetKind::kMarkers);
  EXPECT_FALSE(solved.metric);
  const PoseErrors errors = poseErrors(made.cameras, posesOf(solved), true);
  EXPECT_LT(errors.degrees, 0.1);
  EXPECT_LT(errors.metres, 0.01);
}

TEST(RigCalibration, MarkersThatStandStillAreOnePointEach) {
  const MadeRecording made = stillMarkers({}, 13);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(solved.target, TargetKind::kStillMarkers);
  EXPECT_EQ(solved.items, 60);
  EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
  EXPECT_LT(poseErrors(made.cameras, posesOf(solved), true).metres, 0.02);
}

TEST(RigCalibration, WavedLightWithOutliersThatAreRejectedAndCounted) {
  for (const double outliers : {0.1, 0.3}) {
    RecordingOptions recording;
    recording.duration_s = 30.0;
    recording.outliers = outliers;
    const MadeRecording made = wavedLight(recording, 14);
    const RigCalibration solved = solve(made.unposed(), made.rows);
    EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
    const PoseErrors errors = poseErrors(made.cameras, posesOf(solved), true);
    EXPECT_LT(errors.degrees, 0.15) << outliers;
    EXPECT_LT(errors.metres, 0.015) << outliers;
    for (const CalibratedCamera& c : solved.cameras) {
      const double share = static_cast<double>(c.rejected) / static_cast<double>(c.observations);
      EXPECT_NEAR(share, outliers, 0.06) << c.label;
      EXPECT_LT(c.reprojection_rms_px, 1.0);
    }
  }
}

TEST(RigCalibration, CamerasThatExposeOnTheirOwnAreInterpolated) {
  RecordingOptions recording;
  recording.duration_s = 20.0;
  recording.rate_hz = 60.0;
  recording.together = false;
  recording.jitter_s = 0.004;
  recording.outliers = 0.1;
  const MadeRecording made = wavedLight(recording, 15);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(solved.timing, Timing::kInterpolated);
  EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
  EXPECT_LT(poseErrors(made.cameras, posesOf(solved), true).metres, 0.015);
}

TEST(RigCalibration, GivenPosesStandAndSetWorldAndScale) {
  RecordingOptions recording;
  recording.duration_s = 20.0;
  const MadeRecording made = wavedLight(recording, 16);
  std::vector<RigCamera> cameras = made.unposed();
  cameras[0].camera_from_world = made.cameras[0].camera_from_world;
  cameras[2].camera_from_world = made.cameras[2].camera_from_world;
  const RigCalibration solved = solve(cameras, made.rows);
  EXPECT_EQ(solved.verdict, RigVerdict::kGood) << reasonsOf(solved);
  EXPECT_TRUE(solved.metric);
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    const Vector6d error =
        cameraPerturbation(*made.cameras[c].camera_from_world, *solved.cameras[c].camera_from_world);
    EXPECT_LT(error.tail<3>().norm(), cameras[c].camera_from_world ? 1e-12 : 0.01) << c;
    EXPECT_EQ(solved.cameras[c].covariance.has_value(), !cameras[c].camera_from_world) << c;
  }
}

TEST(RigCalibration, GivenPosesThatWereMovedAreNotBelieved) {
  const MadeRecording made = wavedLight({}, 17);
  std::vector<RigCamera> cameras = made.unposed();
  cameras[0].camera_from_world = made.cameras[0].camera_from_world;
  cameras[1].camera_from_world =
      perturbCamera(*made.cameras[1].camera_from_world, (Vector6d() << 0.1, 0, 0, 0, 0, 0).finished());
  const RigCalibration solved = solve(cameras, made.rows);
  EXPECT_EQ(solved.verdict, RigVerdict::kBad);
  EXPECT_NE(reasonsOf(solved).find("given poses disagree"), std::string::npos);
}

TEST(RigCalibration, DistanceOfTwoCamerasSetsTheScale) {
  const MadeRecording made = wavedLight({}, 18);
  RigCalibrationOptions options;
  const auto centre = [&](std::size_t c) { return made.cameras[c].camera_from_world->inverseTranslation(); };
  options.scale = KnownDistance{1, 3, (centre(1) - centre(3)).norm()};
  const RigCalibration solved = solve(made.unposed(), made.rows, options);
  EXPECT_TRUE(solved.metric);
  EXPECT_LT(poseErrors(made.cameras, posesOf(solved), false).metres, 0.03);
}

TEST(RigCalibration, TwoScalesAreRefused) {
  const MadeRecording made = wavedBoard({}, 19);
  RigCalibrationOptions options;
  options.scale = KnownDistance{0, 1, 2.0};
  EXPECT_THROW(solve(made.unposed(), made.rows, options), Error);
}

/// The mean of e^T C^-1 e over many recordings is the number of parameters when the covariance is true.
TEST(RigCalibration, CovarianceIsTrue) {
  constexpr int kRuns = 24;
  double nees = 0.0;
  int count = 0;
  for (int run = 0; run < kRuns; ++run) {
    RecordingOptions recording;
    recording.cameras = 3;
    recording.duration_s = 4.0;
    const MadeRecording made = wavedLight(recording, 100 + static_cast<std::uint64_t>(run));
    std::vector<RigCamera> cameras = made.cameras;
    cameras[2].camera_from_world.reset();
    const RigCalibration solved = solve(cameras, made.rows);
    ASSERT_TRUE(solved.cameras[2].covariance.has_value()) << run;
    const Vector6d e =
        cameraPerturbation(*made.cameras[2].camera_from_world, *solved.cameras[2].camera_from_world);
    nees += e.dot(solved.cameras[2].covariance->ldlt().solve(e));
    ++count;
  }
  // Standard deviation of the mean of a chi square of 6: sqrt(12 / 24) = 0.7.
  EXPECT_NEAR(nees / count, 6.0, 2.1);
}

TEST(RigCalibration, CovarianceOfAFreeBoardRigIsTrue) {
  constexpr int kRuns = 10;
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    RecordingOptions recording;
    recording.cameras = 3;
    recording.duration_s = 1.0;
    const MadeRecording made = wavedBoard(recording, 200 + static_cast<std::uint64_t>(run));
    const RigCalibration solved = solve(made.unposed(), made.rows);
    // The first camera is the world: compare in its frame.
    const RigidTransform world = made.cameras[0].camera_from_world->inverse();
    for (const std::size_t c : {1U, 2U}) {
      const Vector6d e = cameraPerturbation(*made.cameras[c].camera_from_world * world,
                                            *solved.cameras[c].camera_from_world);
      ASSERT_TRUE(solved.cameras[c].covariance.has_value());
      nees += e.dot(solved.cameras[c].covariance->ldlt().solve(e)) / 2.0;
    }
  }
  EXPECT_NEAR(nees / kRuns, 6.0, 3.0);
}

/// Webcams: equal stamps, exposures up to a frame apart.
RecordingOptions freeRunning(double duration_s) {
  RecordingOptions recording;
  recording.duration_s = duration_s;
  recording.late_s = {0.0, -0.02, 0.012, 0.005};
  return recording;
}

/// Within 3 % of a period: the noise of the light's places pulls a delay that much.
void expectDelays(const RigCalibration& solved, const std::vector<double>& late_s) {
  EXPECT_TRUE(solved.delays);
  for (std::size_t c = 0; c < late_s.size(); ++c)
    EXPECT_NEAR(solved.cameras[c].late_s.value(), late_s[c], 1e-3) << c;
}

TEST(RigCalibration, DelaysBetweenCamerasAreFoundByALight) {
  const RecordingOptions recording = freeRunning(20.0);
  const MadeRecording made = wavedLight(recording, 21);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
  expectDelays(solved, recording.late_s);
  const PoseErrors errors = poseErrors(made.cameras, posesOf(solved), true);
  RigCalibrationOptions trusting;
  trusting.trust_stamps = true;
  const RigCalibration trusted = solve(made.unposed(), made.rows, trusting);
  EXPECT_FALSE(trusted.delays);
  EXPECT_LT(errors.metres, 0.2 * poseErrors(made.cameras, posesOf(trusted), true).metres);
  EXPECT_LT(errors.metres, 0.01);
}

/// Webcams as they come: frames of their own rhythm or not, a third of the centroids false.
TEST(RigCalibration, DelaysAreFoundAmongFalseCentroids) {
  for (const bool together : {true, false}) {
    RecordingOptions recording = freeRunning(12.0);
    recording.together = together;
    recording.outliers = 0.3;
    const MadeRecording made = wavedLight(recording, 71);
    const RigCalibration solved = solve(made.unposed(), made.rows);
    EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
    ASSERT_TRUE(solved.delays);
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_NEAR(solved.cameras[c].late_s.value(), recording.late_s[c], 0.004) << together << c;
    EXPECT_LT(poseErrors(made.cameras, posesOf(solved), true).metres, 0.015) << together;
  }
}

TEST(RigCalibration, DelaysBetweenCamerasAreFoundByABoard) {
  const RecordingOptions recording = freeRunning(4.0);
  const MadeRecording made = wavedBoard(recording, 22);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(solved.verdict, RigVerdict::kGood) << reasonsOf(solved);
  expectDelays(solved, recording.late_s);
  EXPECT_LT(poseErrors(made.cameras, posesOf(solved), false).metres, 0.005);
}

TEST(RigCalibration, CamerasTriggeredTogetherHaveNoDelays) {
  for (const std::uint64_t seed : {31U, 32U, 33U, 34U, 35U, 36U}) {
    RecordingOptions recording;
    recording.cameras = seed % 2 == 0 ? 2 : 4;
    recording.duration_s = 6.0;
    recording.outliers = 0.05;
    EXPECT_FALSE(solve(wavedLight(recording, seed).unposed(), wavedLight(recording, seed).rows).delays)
        << seed;
  }
}

/// What hardly moves in a period shows how noise averages, and no delay.
TEST(RigCalibration, ASlowTargetShowsNoDelays) {
  RecordingOptions recording;
  recording.duration_s = 4.0;
  recording.rate_hz = 300.0;
  recording.late_s = {0.0, -0.0015, 0.001, 0.0};
  const MadeRecording made = wavedLight(recording, 41);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  for (const CalibratedCamera& c : solved.cameras) EXPECT_EQ(c.late_s.value(), 0.0) << c.label;
  EXPECT_LT(poseErrors(made.cameras, posesOf(solved), true).metres, 0.02);
}

/// Without a period there is no motion.
TEST(RigCalibration, OneInstantIsEnoughForABoard) {
  RecordingOptions recording;
  recording.duration_s = 1.5 / recording.rate_hz;
  recording.dropout = 0.0;
  const MadeRecording made = wavedBoard(recording, 42);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_FALSE(solved.delays);
  for (const CalibratedCamera& c : solved.cameras) {
    ASSERT_TRUE(c.camera_from_world.has_value()) << c.label;
    EXPECT_TRUE(c.covariance && c.covariance->allFinite()) << c.label;
  }
}

/// Where they are so many frames late that nothing of it fits, too; in step with the others or not.
TEST(RigCalibration, StampsThatAreFramesOffAreFound) {
  const std::pair<double, bool> cases[] = {{0.055, true}, {0.31, false}, {-0.7, true}};
  for (const auto& [late, together] : cases) {
    RecordingOptions recording;
    recording.cameras = 3;
    recording.duration_s = 12.0;
    recording.outliers = 0.1;
    recording.together = together;
    recording.late_s = {0.0, late, 0.0};
    const MadeRecording made = wavedLight(recording, 43);
    const RigCalibration solved = solve(made.unposed(), made.rows);
    EXPECT_NE(solved.verdict, RigVerdict::kBad) << late << reasonsOf(solved);
    ASSERT_TRUE(solved.delays) << late;
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(solved.cameras[c].late_s.value(), recording.late_s[c], 0.004) << late << c;
    EXPECT_LT(poseErrors(made.cameras, posesOf(solved), true).metres, 0.02) << late;
  }
}

/// Of two cameras there is no majority; the first one's stamps count.
TEST(RigCalibration, OfTwoCamerasTheOtherIsLate) {
  RecordingOptions recording;
  recording.cameras = 2;
  recording.duration_s = 20.0;
  recording.together = false;
  recording.late_s = {0.4, 0.1};
  const MadeRecording made = wavedLight(recording, 47);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
  EXPECT_EQ(solved.cameras[0].late_s.value(), 0.0);
  EXPECT_NEAR(solved.cameras[1].late_s.value(), -0.3, 0.015);
}

/// A board may go without names of its points, and its cameras without a common rhythm.
TEST(RigCalibration, ABoardWithoutNamesIsInterpolatedPointByPoint) {
  RecordingOptions recording;
  recording.duration_s = 3.0;
  recording.together = false;
  const MadeRecording made = wavedBoard(recording, 44);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
  EXPECT_LT(solved.sigma_px, 0.7);
  EXPECT_LT(poseErrors(made.cameras, posesOf(solved), false).metres, 0.005);
}

TEST(RigCalibration, CovarianceKnowsOfTheDelays) {
  constexpr int kRuns = 10;
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    RecordingOptions recording = freeRunning(6.0);
    recording.cameras = 3;
    const MadeRecording made = wavedLight(recording, 300 + static_cast<std::uint64_t>(run));
    std::vector<RigCamera> cameras = made.cameras;
    cameras[2].camera_from_world.reset();
    const RigCalibration solved = solve(cameras, made.rows);
    ASSERT_TRUE(solved.delays) << run;
    ASSERT_TRUE(solved.cameras[2].covariance.has_value()) << run;
    const Vector6d e =
        cameraPerturbation(*made.cameras[2].camera_from_world, *solved.cameras[2].camera_from_world);
    nees += e.dot(solved.cameras[2].covariance->ldlt().solve(e));
  }
  // Standard deviation of the mean of a chi square of 6: sqrt(12 / 10) = 1.1.
  EXPECT_NEAR(nees / kRuns, 6.0, 3.3);
}

/// That of the second given camera is not known exactly either, and moves the light's places: all the same
/// only if that camera sees nothing move.
TEST(RigCalibration, CovarianceKnowsOfTheDelayOfASecondGivenCamera) {
  RecordingOptions recording;
  recording.cameras = 3;
  MadeRecording made = wavedLight(recording, 25);
  SightingTable table = bringTogether(made.rows, made.cameras, "made up").front();
  table.late_s.assign(3, 0.0);
  RigState state;
  for (const RigCamera& camera : made.cameras) state.camera_from_world.push_back(camera.camera_from_world);
  state.points.resize(static_cast<std::size_t>(table.items));
  state.world_from_body.resize(state.points.size());
  state.fixed = {true, true, false};
  placePoints(state, made.cameras, table, 5.0);
  const auto place_variance = [&] {
    return rigCovariance(state, made.cameras, table, std::nullopt)
        .cameras[2]
        ->bottomRightCorner<3, 3>()
        .trace();
  };
  const double open = place_variance();
  for (Sighting& s : table.sightings)
    if (s.camera == 1) s.motion.velocity.setZero();
  EXPECT_GT(open, 1.002 * place_variance());
}

/// Three poses of a board with all of its points open: what those take up of the residuals counts.
TEST(RigCalibration, APixelsSigmaCountsTheFreePoints) {
  double sum = 0.0;
  constexpr int kRuns = 8;
  for (int run = 0; run < kRuns; ++run) {
    RecordingOptions recording;
    recording.duration_s = 0.105;
    recording.dropout = 0.0;
    const MadeRecording made = wavedBoard(recording, 500 + static_cast<std::uint64_t>(run));
    RigCalibrationOptions options;
    options.self.marker_sigma_m = 0.02;
    options.trust_stamps = true;
    const RigCalibration solved = solve(made.unposed(), made.rows, options);
    ASSERT_EQ(solved.points.size(), 24u);
    sum += solved.sigma_px;
  }
  EXPECT_NEAR(sum / kRuns, 0.5, 0.015);
}

/// Four points at one instant cannot tell of themselves, too.
TEST(RigCalibration, SigmasThatAreNotKnownAreNotZero) {
  RecordingOptions recording;
  recording.cameras = 2;
  recording.duration_s = 1.5 / recording.rate_hz;
  recording.dropout = 0.0;
  MadeRecording made = wavedBoard(recording, 45);
  PointRows few;
  few.markers = made.rows.markers;
  for (std::size_t i = 0; i < made.rows.rows.size(); ++i) {
    const Eigen::Vector3d& at = made.rows.in_body[i];
    const auto edge = [](double x, double far) { return x < 1e-9 || x > far - 1e-9; };
    if (!edge(at.x(), 0.3) || !edge(at.y(), 0.18)) continue;
    few.rows.push_back(made.rows.rows[i]);
    few.in_body.push_back(at);
  }
  RigCalibrationOptions options;
  options.self = {0.02, 0.1};
  const RigCalibration solved = solve(made.unposed(), few, options);
  EXPECT_EQ(solved.verdict, RigVerdict::kBad);
  ASSERT_EQ(solved.points.size(), 4u);
  EXPECT_FALSE(solved.points[0].sigma_m.has_value());
  EXPECT_FALSE(solved.cameras[1].focal_sigma.has_value());
}

/// Wrong focal lengths hide in poses and in the light's places; right ones are not doubted.
TEST(RigCalibration, WrongIntrinsicsOfALightsCamerasAreSaid) {
  for (const bool wrong : {true, false})
    for (const std::uint64_t seed : {81U, 82U, 83U}) {
      RecordingOptions recording;
      recording.duration_s = 20.0;
      recording.outliers = 0.1;
      const MadeRecording made = wavedLight(recording, seed);
      std::vector<RigCamera> cameras = made.unposed();
      if (wrong)
        for (std::size_t c = 0; c < cameras.size(); ++c)
          cameras[c].model = cameras[c].model.withFocalScale(c % 2 == 0 ? 1.02 : 0.98);
      const RigCalibration solved = solve(cameras, made.rows);
      EXPECT_EQ(solved.verdict == RigVerdict::kGood, !wrong) << reasonsOf(solved);
      EXPECT_EQ(reasonsOf(solved).find("contradicts the given intrinsics") != std::string::npos, wrong);
      EXPECT_NEAR(solved.cameras[0].focal_off, wrong ? 1.0 / 1.02 - 1.0 : 0.0, 0.006) << seed;
    }
}

/// Rows of frames that are only near each other keep what their stamps say.
TEST(RigCalibration, RowsPutTogetherRememberTheirStamps) {
  RecordingOptions recording;
  recording.cameras = 2;
  MadeRecording made = wavedLight(recording, 46);
  for (PointRow& row : made.rows.rows)
    if (row.camera == 1) row.time_s += 0.005;
  for (const SightingTable& table : bringTogether(made.rows, made.cameras, "made up"))
    EXPECT_NEAR(table.stamps_after_s[1] - table.stamps_after_s[0],
                table.timing == Timing::kTogether ? 0.005 : 0.0, 1e-9);
}

TEST(RigCalibration, ADelayIsNotToldOfACameraThatIsNotPlaced) {
  RecordingOptions recording;
  recording.duration_s = 20.0;
  recording.together = false;
  recording.late_s = {0.0, -0.02, 0.012, 0.005};
  MadeRecording made = wavedLight(recording, 43);
  for (PointRow& row : made.rows.rows)
    if (row.camera == 3) row.time_s += 1000.0;
  const RigCalibration solved = solve(made.unposed(), made.rows);
  ASSERT_TRUE(solved.delays);
  ASSERT_FALSE(solved.cameras[3].camera_from_world.has_value());
  EXPECT_FALSE(solved.cameras[3].late_s.has_value());
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(solved.cameras[c].late_s.value(), recording.late_s[c], 2e-3) << c;
}

TEST(RigCalibration, CameraThatSharesNothingIsNamed) {
  MadeRecording made = wavedLight({}, 20);
  for (PointRow& row : made.rows.rows)
    if (row.camera == 3) row.time_s += 1000.0;
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(solved.verdict, RigVerdict::kBad);
  EXPECT_FALSE(solved.cameras[3].camera_from_world.has_value());
  EXPECT_NE(reasonsOf(solved).find("camera 4 shares no observation"), std::string::npos) << reasonsOf(solved);
}

TEST(RigCalibration, CameraThatOnlyOneOtherSeesWithHasNoScale) {
  MadeRecording made = wavedLight({}, 21);
  // Camera 4 sees the light only while 1 and 2 are covered: nothing ties its distance to theirs.
  std::erase_if(made.rows.rows, [](const PointRow& row) {
    return (row.time_s < 5.0) ? row.camera == 3 : row.camera == 0 || row.camera == 1;
  });
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(solved.verdict, RigVerdict::kBad);
}

TEST(RigCalibration, NoiseIsNoCalibration) {
  RecordingOptions recording;
  recording.duration_s = 2.0;
  MadeRecording made = wavedLight(recording, 22);
  Random random(5);
  for (PointRow& row : made.rows.rows) row.pixel = {random.uniform(0, 640), random.uniform(0, 480)};
  EXPECT_EQ(solve(made.unposed(), made.rows).verdict, RigVerdict::kBad);
}

TEST(RigCalibration, ALightOnALineIsNoCalibration) {
  for (const int cameras : {2, 3}) {
    RecordingOptions recording;
    recording.cameras = cameras;
    recording.outliers = 0.1;
    recording.reach = {1.0, 0.003, 0.003};
    const MadeRecording made = wavedLight(recording, 48);
    const RigCalibration solved = solve(made.unposed(), made.rows);
    EXPECT_EQ(solved.verdict, RigVerdict::kBad);
    EXPECT_NE(reasonsOf(solved).find("along a line"), std::string::npos) << reasonsOf(solved);
  }
}

TEST(RigCalibration, ALightThatRestedBeforeItWasWavedIsNoLine) {
  RecordingOptions recording;
  recording.cameras = 3;
  recording.duration_s = 30.0;
  recording.outliers = 0.0;
  MadeRecording made = wavedLight(recording, 50);
  std::map<std::int32_t, Eigen::Vector2d> at_rest;
  Random random(51);
  for (PointRow& row : made.rows.rows) {
    if (row.time_s > 0.6 * recording.duration_s) continue;
    const Eigen::Vector2d first = at_rest.try_emplace(row.camera, row.pixel).first->second;
    row.pixel = first + 0.2 * Eigen::Vector2d(random.normal(), random.normal());
  }
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(reasonsOf(solved).find("along a line"), std::string::npos) << reasonsOf(solved);
  EXPECT_NE(solved.verdict, RigVerdict::kBad) << reasonsOf(solved);
}

/// Two cameras of which each has two fifths of its centroids false agree in a third of all.
TEST(RigCalibration, ManyFalseCentroidsDoNotSpoilAPair) {
  RecordingOptions recording;
  recording.cameras = 2;
  recording.duration_s = 30.0;
  recording.outliers = 0.4;
  const MadeRecording made = wavedLight(recording, 49);
  const RigCalibration solved = solve(made.unposed(), made.rows);
  EXPECT_EQ(solved.verdict, RigVerdict::kUsable) << reasonsOf(solved);
  EXPECT_GT(solved.cameras[0].rejected, solved.cameras[0].observations / 2);
  EXPECT_LT(solved.cameras[0].near_misses, 0.2);
  const auto second_from_first = [](const RigidTransform& first, const RigidTransform& second) {
    return second.rotation * first.rotation.conjugate();
  };
  const double off =
      toDegrees(second_from_first(*solved.cameras[0].camera_from_world, *solved.cameras[1].camera_from_world)
                    .angularDistance(second_from_first(*made.cameras[0].camera_from_world,
                                                       *made.cameras[1].camera_from_world)));
  EXPECT_LT(off, 0.7);
}

/// What a camera saw before or after `at_s` as if it had been turned by three degrees.
void turnCamera(MadeRecording& made, std::int32_t camera, double at_s, bool before) {
  for (PointRow& row : made.rows.rows)
    if (row.camera == camera && (row.time_s < at_s) == before) row.pixel += Eigen::Vector2d(25.0, 12.0);
}

TEST(RigCalibration, ACameraThatWasMovedIsNamedWithItsTime) {
  for (const bool early : {true, false}) {
    MadeRecording made = wavedLight({}, 50);
    turnCamera(made, 2, early ? 3.0 : 7.0, early);
    const RigCalibration solved = solve(made.unposed(), made.rows);
    EXPECT_EQ(solved.verdict, early ? RigVerdict::kUsable : RigVerdict::kBad) << reasonsOf(solved);
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(solved.cameras[c].moved.has_value(), c == 2) << c;
    ASSERT_TRUE(solved.cameras[2].moved.has_value());
    EXPECT_NEAR(solved.cameras[2].moved->at_s, early ? 3.0 : 7.0, 0.2);
    EXPECT_EQ(solved.cameras[2].moved->fits_before, !early);
  }
}

TEST(RigCalibration, LightThatDoesNotMoveIsNoCalibration) {
  RecordingOptions recording;
  recording.duration_s = 2.0;
  MadeRecording made = wavedLight(recording, 23);
  std::vector<Eigen::Vector2d> first(made.cameras.size(), Eigen::Vector2d::Zero());
  for (PointRow& row : made.rows.rows) {
    auto& pixel = first[static_cast<std::size_t>(row.camera)];
    if (pixel.isZero()) pixel = row.pixel;
    row.pixel = pixel;
  }
  EXPECT_EQ(solve(made.unposed(), made.rows).verdict, RigVerdict::kBad);
}

TEST(RigCalibration, RepeatsBitForBit) {
  RecordingOptions recording;
  recording.outliers = 0.2;
  const MadeRecording made = wavedLight(recording, 24);
  const RigCalibration a = solve(made.unposed(), made.rows), b = solve(made.unposed(), made.rows);
  for (std::size_t c = 0; c < a.cameras.size(); ++c) {
    ASSERT_TRUE(a.cameras[c].camera_from_world.has_value());
    EXPECT_EQ(a.cameras[c].camera_from_world->translation, b.cameras[c].camera_from_world->translation);
  }
}

}  // namespace
}  // namespace helical
