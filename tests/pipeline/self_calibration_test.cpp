// Balls and focal lengths that are not what the rig says, found in flight by a refinement and flown on with.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <vector>

#include "engine/config/plan_file.h"
#include "engine/config/resource_files.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/calibration_record.h"
#include "engine/simulator/true_rig.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

constexpr int kTicksPerSecond = 60;
constexpr int kRefineAt = 14 * kTicksPerSecond;
constexpr int kSettled = 20 * kTicksPerSecond;
constexpr int kEnd = 26 * kTicksPerSecond;
constexpr std::uint64_t kSeeds = 4;

using OnTick = std::function<void(LockStep&, const EngineSnapshot&)>;

CalibrationOrder orderFor(int camera, CalibrationOrderKind kind) {
  CalibrationOrder order;
  order.camera = cameraId(camera);
  order.kind = kind;
  return order;
}

/// Flies image-free to the end; errors are rms over the last six seconds.
struct SelfCalibratedFlight {
  SelfCalibratedFlight(const RigConfig& rig, bool refines, const char* plan = "hover", const OnTick& on_tick = {})
      : lock_step(rig, loadPlan(planPath(plan))) {
    double squares = 0.0, turns = 0.0;
    int count = 0;
    for (int i = 0; i < kEnd; ++i) {
      OperatorCommands commands;
      commands.arm = commands.take_off = i == kTicksPerSecond;
      if (refines && i == kRefineAt) refusal = lock_step.orderCalibration(orderFor(0, CalibrationOrderKind::kRefine));
      now = lock_step.tick(commands);
      if (on_tick) on_tick(lock_step, now);
      if (i > kRefineAt) longest_without_pose_s = std::max(longest_without_pose_s, toSeconds(now.pose_age));
      if (i < kSettled) continue;
      const RigidTransform off = now.truth.world_from_body.inverse() * now.tracked.state.world_from_body;
      squares += off.translation.squaredNorm();
      turns += std::pow(Eigen::AngleAxisd(off.rotation).angle(), 2);
      ++count;
    }
    position_rms_m = std::sqrt(squares / count);
    turn_rms = std::sqrt(turns / count);
  }
  double errorOfCamera3() const {
    const CameraSnapshot& camera = now.cameras[2];
    return cameraError(camera.estimate.camera_from_world, camera.true_camera_from_world).position;
  }

  LockStep lock_step;
  EngineSnapshot now;
  const char* refusal = nullptr;
  double position_rms_m = 0.0, turn_rms = 0.0, longest_without_pose_s = 0.0;
};

RigConfig rigThatCorrects(std::uint64_t seed, double marker_sigma_m, double focal_sigma) {
  RigConfig rig = test::shippedRig("paper", seed);
  rig.self_calibration.marker_sigma_m = marker_sigma_m;
  rig.self_calibration.focal_sigma = focal_sigma;
  return rig;
}

/// How far distances between balls are off [m], rms: what images can tell of the balls.
double shapeError(const MarkerLayout& found, const MarkerLayout& truth) {
  double squares = 0.0;
  int count = 0;
  for (int a = 0; a < truth.count(); ++a)
    for (int b = 0; b < a; ++b) {
      const double off = (found.inBody(markerId(a)) - found.inBody(markerId(b))).norm() -
                         (truth.inBody(markerId(a)) - truth.inBody(markerId(b))).norm();
      squares += off * off;
      ++count;
    }
  return std::sqrt(squares / count);
}

/// Mean squares over the seeds.
struct Errors {
  double camera = 0.0, position = 0.0, turn = 0.0, shape = 0.0;

  void add(const SelfCalibratedFlight& flight, const MarkerLayout& true_balls) {
    camera += std::pow(flight.errorOfCamera3(), 2) / kSeeds;
    position += std::pow(flight.position_rms_m, 2) / kSeeds;
    turn += std::pow(flight.turn_rms, 2) / kSeeds;
    shape += std::pow(shapeError(flight.now.markers, true_balls), 2) / kSeeds;
  }
  void print(const char* what) const {
    std::printf("%s: camera 3 off by %.2f mm, the pose by %.2f mm and %.2f deg, distances of balls by %.3f mm rms\n",
                what, 1e3 * std::sqrt(camera), 1e3 * std::sqrt(position), toDegrees(std::sqrt(turn)),
                1e3 * std::sqrt(shape));
  }
};

TEST(SelfCalibration, BallsThatAreAMillimetreOffAreFoundAndFlownOnWith) {
  Errors before, after;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    RigConfig rig = rigThatCorrects(seed, 1e-3, 0.0);
    rig.simulation.marker_error_m = 1e-3;
    const SelfCalibratedFlight plain(rig, false), refined(rig, true);
    ASSERT_EQ(refined.refusal, nullptr);
    EXPECT_EQ(refined.now.refinement.outcome, RefinementOutcome::kCorrected);
    EXPECT_GT(refined.now.refinement.balls_off_m, 0.0);
    EXPECT_EQ(refined.now.cameras[2].estimate.status, CameraStatus::kCalibrated);
    EXPECT_LT(refined.longest_without_pose_s, 0.1);
    EXPECT_FALSE(refined.now.verdict.crashed);
    const MarkerLayout truth = trueMarkers(rig.markers_in_body, rig.simulation);
    before.add(plain, truth);
    after.add(refined, truth);
  }
  before.print("as the rig says");
  after.print("refined");
  EXPECT_LT(after.camera, 0.1 * before.camera);
  EXPECT_LT(after.shape, 0.1 * before.shape);
  EXPECT_LT(after.position, 0.5 * before.position);
  EXPECT_LT(after.turn, 0.1 * before.turn);
}

TEST(SelfCalibration, FocalLengthsThatAreOffAreFoundWhereImagesTellThem) {
  Errors before, after;
  double focal_before = 0.0, focal_after = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    RigConfig rig = rigThatCorrects(seed, 0.0, 0.01);
    rig.simulation.focal_error = 0.005;
    const SelfCalibratedFlight plain(rig, false), refined(rig, true);
    EXPECT_EQ(refined.now.refinement.outcome, RefinementOutcome::kCorrected);
    EXPECT_LT(refined.longest_without_pose_s, 0.1);
    before.add(plain, rig.markers_in_body);
    after.add(refined, rig.markers_in_body);
    // Hovering tells those of the known cameras; that of the third one is its distance, too.
    EXPECT_EQ(refined.now.cameras[2].focal_scale, 1.0);
    for (int c = 0; c < 2; ++c) {
      const CameraModel& model = rig.cameras[static_cast<std::size_t>(c)].model;
      const double truth = trueModel(cameraId(c), model, rig.simulation).fx() / model.fx();
      focal_before += std::pow(truth - 1.0, 2);
      focal_after += std::pow(truth - refined.now.cameras[static_cast<std::size_t>(c)].focal_scale, 2);
    }
  }
  before.print("as the rig says");
  after.print("refined");
  std::printf("focal lengths off by %.3f %%, refined %.3f %%\n", 100.0 * std::sqrt(focal_before / 2 / kSeeds),
              100.0 * std::sqrt(focal_after / 2 / kSeeds));
  EXPECT_LT(focal_after, 0.05 * focal_before);
  EXPECT_LT(after.position, 0.5 * before.position);
  EXPECT_LT(after.camera, 1.1 * before.camera);
}

TEST(SelfCalibration, WhereNothingIsOffNothingIsSpoiled) {
  Errors before, after;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const RigConfig rig = rigThatCorrects(seed, 1e-3, 0.01);
    const SelfCalibratedFlight plain(rigThatCorrects(seed, 0.0, 0.0), true), refined(rig, true);
    EXPECT_EQ(plain.now.refinement.outcome, RefinementOutcome::kCameras);
    EXPECT_EQ(refined.now.refinement.outcome, RefinementOutcome::kKept);
    EXPECT_TRUE(std::ranges::equal(refined.now.markers.all(), rig.markers_in_body.all()));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(refined.now.cameras[c].focal_scale, 1.0);
    before.add(plain, rig.markers_in_body);
    after.add(refined, rig.markers_in_body);
  }
  before.print("cameras alone");
  after.print("balls and focal lengths, too");
  EXPECT_LT(after.camera, 1.5 * before.camera);
  EXPECT_LT(after.position, 1.05 * before.position);
}

TEST(SelfCalibration, BallsThatAreFartherOffThanTheyMayBeStayAndItIsSaid) {
  RigConfig rig = rigThatCorrects(2, 5e-4, 0.0);
  std::vector<Eigen::Vector3d> balls(rig.markers_in_body.all().begin(), rig.markers_in_body.all().end());
  balls[1].y() += 4e-3;
  rig.simulation.markers_before = MarkerLayout(balls, rig.markers_in_body.radius());
  const SelfCalibratedFlight refined(rig, true);
  EXPECT_EQ(refined.now.refinement.outcome, RefinementOutcome::kUnsound);
  EXPECT_TRUE(std::ranges::equal(refined.now.markers.all(), rig.markers_in_body.all()));
}

TEST(SelfCalibration, ABallThatLiesWhereItCannotBeIsNotSaidToBeRight) {
  for (std::size_t ball = 0; ball < 4; ++ball) {
    RigConfig rig = rigThatCorrects(2, 5e-4, 0.0);
    std::vector<Eigen::Vector3d> balls(rig.markers_in_body.all().begin(), rig.markers_in_body.all().end());
    balls[ball].y() += 10e-3;
    rig.simulation.markers_before = MarkerLayout(balls, rig.markers_in_body.radius());
    const SelfCalibratedFlight refined(rig, true);
    EXPECT_NE(refined.now.refinement.outcome, RefinementOutcome::kCorrected);
    EXPECT_TRUE(refined.now.refinement.outcome != RefinementOutcome::kKept ||
                refined.now.refinement.balls_hardly_seen > 0);
  }
}

TEST(SelfCalibration, ASecondRefinementDoesNotUndoWhatTheFirstFound) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    RigConfig rig = rigThatCorrects(seed, 1e-3, 0.0);
    rig.simulation.marker_error_m = 1e-3;
    int tick = 0, again_at = 0;
    std::optional<MarkerLayout> found;
    const SelfCalibratedFlight flown(rig, true, "hover", [&](LockStep& flight, const EngineSnapshot& now) {
      ++tick;
      if (again_at == 0 && now.refinement.ended == 1) {
        again_at = tick + 3 * kTicksPerSecond;
        found = now.markers;
      }
      if (tick == again_at) {
        EXPECT_EQ(flight.orderCalibration(orderFor(0, CalibrationOrderKind::kRefine)), nullptr);
      }
    });
    ASSERT_TRUE(found);
    EXPECT_EQ(flown.now.refinement.ended, 2u);
    EXPECT_EQ(flown.now.refinement.outcome, RefinementOutcome::kKept);
    EXPECT_TRUE(std::ranges::equal(flown.now.markers.all(), found->all())) << seed;
  }
}

/// The camera jumps some frames before the balls are corrected.
TEST(SelfCalibration, WhatSpeaksForAKnockOutlivesACorrection) {
  RigConfig rig = test::shippedRig("calibrated", 1);
  rig.self_calibration.marker_sigma_m = rig.simulation.marker_error_m = 1e-3;
  int tick = 0, corrected_at = 0;
  const SelfCalibratedFlight quiet(rig, true, "hover", [&](LockStep&, const EngineSnapshot& now) {
    ++tick;
    if (corrected_at == 0 && now.refinement.ended > 0) corrected_at = tick;
  });
  ASSERT_EQ(quiet.now.refinement.outcome, RefinementOutcome::kCorrected);
  rig.simulation.bumps = {{cameraId(1), (corrected_at - 4.0) / kTicksPerSecond, toRadians(1.0), 0.01}};
  std::array<int, 2> found_at{};
  for (const bool refines : {false, true}) {
    tick = 0;
    const SelfCalibratedFlight knocked(rig, refines, "hover", [&](LockStep&, const EngineSnapshot& now) {
      ++tick;
      if (found_at[refines] == 0 && now.cameras[1].knocks_found > 0) found_at[refines] = tick;
    });
  }
  std::printf("corrected at tick %d; knock found at %d, without that at %d\n", corrected_at, found_at[1], found_at[0]);
  EXPECT_GE(found_at[1], corrected_at);
  EXPECT_LE(found_at[1], found_at[0] + 1);
}

struct TimedOrder {
  int tick;
  CalibrationOrder order;
};

/// Each order is taken, the last one while the refinement runs, which then is broken off and changes nothing.
void expectBrokenOffBy(const std::vector<TimedOrder>& orders) {
  RigConfig rig = rigThatCorrects(1, 1e-3, 0.0);
  rig.simulation.marker_error_m = 1e-3;
  int tick = 0;
  const SelfCalibratedFlight broken(rig, true, "hover", [&](LockStep& flight, const EngineSnapshot& now) {
    ++tick;
    for (const TimedOrder& each : orders)
      if (tick == each.tick) {
        EXPECT_EQ(now.refinement.ended, 0u);
        EXPECT_EQ(flight.orderCalibration(each.order), nullptr);
      }
  });
  EXPECT_EQ(broken.now.refinement.outcome, RefinementOutcome::kOvertaken);
  EXPECT_EQ(broken.now.refinement.ended, 1u);
  EXPECT_TRUE(std::ranges::equal(broken.now.markers.all(), rig.markers_in_body.all()));
}

TEST(SelfCalibration, ACameraThatIsFrozenMeanwhileBreaksItOff) {
  expectBrokenOffBy({{kRefineAt + 5, orderFor(2, CalibrationOrderKind::kFreeze)}});
}

TEST(SelfCalibration, AFrozenCameraThatHoldsTheWorldAndIsPlacedMeanwhileBreaksItOff) {
  expectBrokenOffBy({{kRefineAt - 5, orderFor(0, CalibrationOrderKind::kFreeze)},
                     {kRefineAt + 5, orderFor(0, CalibrationOrderKind::kTrustRig)}});
}

TEST(SelfCalibration, AFrozenLearnerStaysWhereItIsAndLearnsAnewFromTheBallsThatWereFound) {
  RigConfig rig = rigThatCorrects(1, 1e-3, 0.0);
  rig.simulation.marker_error_m = 1e-3;
  Eigen::Vector3d frozen;
  int tick = 0, resumed_at = 0;
  double error_before = 0.0;
  const SelfCalibratedFlight flown(rig, true, "hover", [&](LockStep& flight, const EngineSnapshot& now) {
    const CameraSnapshot& camera = now.cameras[2];
    if (++tick == kRefineAt - 5) flight.orderCalibration(orderFor(2, CalibrationOrderKind::kFreeze));
    if (tick == kRefineAt) frozen = camera.estimate.camera_from_world.translation;
    if (resumed_at > 0 && tick == resumed_at + 5) {
      EXPECT_EQ(camera.estimate.status, CameraStatus::kCalibrating);
    }
    if (resumed_at > 0 || now.refinement.ended == 0) return;
    EXPECT_EQ(now.refinement.outcome, RefinementOutcome::kCorrected);
    EXPECT_EQ(camera.estimate.status, CameraStatus::kCalibrated);
    EXPECT_EQ(camera.estimate.camera_from_world.translation, frozen);
    error_before = cameraError(camera.estimate.camera_from_world, camera.true_camera_from_world).position;
    flight.orderCalibration(orderFor(2, CalibrationOrderKind::kResume));
    resumed_at = tick;
  });
  ASSERT_GT(resumed_at, 0);
  EXPECT_EQ(flown.now.cameras[2].estimate.status, CameraStatus::kCalibrated);
  std::printf("camera 3 off by %.2f mm, learnt anew %.2f mm\n", 1e3 * error_before, 1e3 * flown.errorOfCamera3());
  EXPECT_LT(flown.errorOfCamera3(), 0.5 * error_before);
}

TEST(SelfCalibration, WhatWasFoundIsSavedAndFliesFromTheStartInTheSameField) {
  RigConfig rig = rigThatCorrects(2, 1e-3, 0.01);
  rig.simulation.marker_error_m = 1e-3;
  rig.simulation.focal_error = 0.003;
  const SelfCalibratedFlight first(rig, true);
  ASSERT_EQ(first.now.refinement.outcome, RefinementOutcome::kCorrected);
  const SavedCalibration saved = calibrationOf(rig, first.now);
  ASSERT_EQ(saved.markers_in_body.size(), 4u);
  EXPECT_NE(saved.cameras[0].focal_scale, 1.0);
  RigConfig given = rig;
  giveCalibration(saved, given);
  EXPECT_TRUE(std::ranges::equal(given.markers_in_body.all(), first.now.markers.all()));
  EXPECT_EQ(given.cameras[0].model.fx(), saved.cameras[0].focal_scale * rig.cameras[0].model.fx());
  const MarkerLayout truth = trueMarkers(rig.markers_in_body, rig.simulation);
  EXPECT_TRUE(std::ranges::equal(trueMarkers(given.markers_in_body, given.simulation).all(), truth.all()));
  const SelfCalibratedFlight plain(rig, false), second(given, false);
  EXPECT_LT(second.turn_rms, 0.5 * plain.turn_rms);
  const SavedCalibration again = calibrationOf(given, second.now);
  EXPECT_EQ(again.markers_in_body, saved.markers_in_body);
  EXPECT_EQ(again.cameras[0].focal_scale, saved.cameras[0].focal_scale);
}

}  // namespace
}  // namespace helical
