// What the operator decides about a camera's calibration, and calibrations that are saved and adopted.

#include "engine/pipeline/calibration_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"
#include "engine/pipeline/announcer.h"
#include "engine/pipeline/calibration_record.h"
#include "engine/pipeline/flight_tap.h"
#include "tests/pipeline/flight_fixture.h"

namespace helical {
namespace {

constexpr int kSecond = 60;  // ticks

struct Flight {
  explicit Flight(const RigConfig& rig, FlightTap* tap = nullptr) : lock_step(rig, {}, tap) {}
  const EngineSnapshot& run(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      OperatorCommands commands;
      commands.arm = commands.take_off = ++tick == kSecond;
      now = lock_step.tick(commands);
    }
    return now;
  }
  const char* order(CalibrationOrderKind kind, int camera) {
    CalibrationOrder order;
    order.kind = kind;
    order.camera = cameraId(camera);
    return lock_step.orderCalibration(order);
  }
  const CameraSnapshot& camera(std::size_t index) const { return now.cameras[index]; }

  LockStep lock_step;
  EngineSnapshot now;
  int tick = 0;
};

TEST(CalibrationOrder, ACameraWithoutAPoseLearnsWithoutAGuess) {
  Flight flight(test::shippedRig("paper", 1));
  flight.run(1);
  EXPECT_EQ(flight.camera(2).estimate.status, CameraStatus::kUncalibrated);
  flight.run(12 * kSecond);
  EXPECT_STREQ(flight.camera(2).calibration_method, "joint");
  EXPECT_EQ(flight.camera(2).estimate.status, CameraStatus::kCalibrated);
  EXPECT_LT(cameraError(flight.camera(2).estimate.camera_from_world, flight.camera(2).true_camera_from_world)
                .position,
            0.01);
}

TEST(CalibrationOrder, AFrozenCameraLearnsNothingUntilItIsResumed) {
  Flight flight(test::shippedRig("paper", 2));
  flight.run(8 * kSecond);
  ASSERT_EQ(flight.order(CalibrationOrderKind::kFreeze, 2), nullptr);
  flight.run(1);
  EXPECT_TRUE(flight.camera(2).frozen);
  const Eigen::Vector3d frozen = flight.camera(2).estimate.camera_from_world.translation;
  flight.run(kSecond);
  EXPECT_EQ(flight.camera(2).estimate.camera_from_world.translation, frozen);
  EXPECT_EQ(flight.camera(2).estimate.status, CameraStatus::kCalibrated);
  ASSERT_EQ(flight.order(CalibrationOrderKind::kResume, 2), nullptr);
  flight.run(kSecond);
  EXPECT_NE(flight.camera(2).estimate.camera_from_world.translation, frozen);
}

TEST(CalibrationOrder, ACameraThatDoesNotKnowItsPlaceIsNotAccepted) {
  Flight flight(test::shippedRig("paper", 3));
  flight.run(1);
  EXPECT_NE(flight.order(CalibrationOrderKind::kAccept, 2), nullptr);
  EXPECT_NE(flight.order(CalibrationOrderKind::kAccept, 0), nullptr) << "it does not learn";
  flight.run(kSecond);
  EXPECT_NE(flight.camera(2).estimate.status, CameraStatus::kCalibrated);
}

TEST(CalibrationOrder, AnAcceptedCameraComesInAtOnceAndStays) {
  Flight flight(test::shippedRig("paper", 3));
  while (flight.now.tick < 10 * kSecond && flight.order(CalibrationOrderKind::kAccept, 2) != nullptr)
    flight.run(1);
  flight.run(1);
  EXPECT_EQ(flight.camera(2).estimate.status, CameraStatus::kCalibrated);
  flight.run(6 * kSecond);
  EXPECT_EQ(flight.camera(2).estimate.status, CameraStatus::kCalibrated);
}

TEST(CalibrationOrder, TheRigFileIsTrustedOnlyWhereItSaysSomething) {
  Flight flight(test::shippedRig("paper", 4));
  flight.run(8 * kSecond);
  EXPECT_NE(flight.order(CalibrationOrderKind::kTrustRig, 2), nullptr);
  EXPECT_EQ(flight.order(CalibrationOrderKind::kTrustRig, 0), nullptr);
  flight.run(1);
  EXPECT_EQ(flight.camera(0).estimate.status, CameraStatus::kCalibrated);
}

TEST(CalibrationOrder, WhatOneFlightLearntAnotherOneAdopts) {
  const RigConfig rig = test::shippedRig("paper", 5);
  Flight first(rig);
  first.run(12 * kSecond);
  const SavedCalibration saved = calibrationOf(rig, first.now);
  ASSERT_EQ(saved.cameras.size(), 3u);
  EXPECT_EQ(saved.cameras[0].method, "given");
  EXPECT_EQ(saved.cameras[2].method, "joint");
  Flight second(rig);
  for (const CalibrationOrder& order : adoptOrders(saved, rig, rig.markers_in_body))
    EXPECT_EQ(second.lock_step.orderCalibration(order), nullptr);
  second.run(3);
  EXPECT_EQ(second.camera(2).estimate.status, CameraStatus::kCalibrated);
  EXPECT_EQ(second.camera(2).calibration_method, nullptr);
  EXPECT_EQ(second.camera(2).estimate.camera_from_world.translation,
            saved.cameras[2].camera_from_world.translation);
  EXPECT_EQ(second.camera(2).estimate.covariance, saved.cameras[2].covariance);
}

TEST(CalibrationOrder, ARefinementNeedsFramesAndSomethingToRefine) {
  Flight learner(test::shippedRig("paper", 8)), known(test::shippedRig("calibrated", 8));
  learner.run(1);
  EXPECT_NE(learner.order(CalibrationOrderKind::kRefine, 0), nullptr);
  known.run(8 * kSecond);
  EXPECT_STREQ(known.order(CalibrationOrderKind::kRefine, 0),
               "every camera's pose is given exactly, or it saw too little");
}

TEST(CalibrationOrder, ARefinedCameraStandsWhereAllOfThemTogetherSay) {
  double before_m = 0.0, after_m = 0.0;
  int refined = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    RigConfig rig = test::shippedRig("eight-uncalibrated", seed);
    for (std::size_t c = 0; c < 2; ++c) rig.cameras[c].camera_from_world = rig.simulation.true_camera_from_world[c];
    Flight flight(rig);
    flight.run(14 * kSecond);
    const RigidTransform given = flight.camera(0).estimate.camera_from_world;
    const auto errors = [&] {
      double sum = 0.0;
      for (std::size_t c = 2; c < 8; ++c)
        sum += std::pow(cameraError(flight.camera(c).estimate.camera_from_world,
                                    flight.camera(c).true_camera_from_world).position, 2);
      return sum;
    };
    before_m += errors();
    ASSERT_EQ(flight.order(CalibrationOrderKind::kRefine, 0), nullptr);
    EXPECT_NE(flight.order(CalibrationOrderKind::kRefine, 0), nullptr) << "one at a time";
    flight.run(8 * kSecond);
    after_m += errors();
    EXPECT_EQ(flight.camera(0).estimate.camera_from_world.translation, given.translation);
    for (std::size_t c = 2; c < 8; ++c) {
      // One that knows clearly more by itself goes on by itself.
      refined += std::string_view(flight.camera(c).calibration_method) == "refined";
      EXPECT_EQ(flight.camera(c).estimate.status, CameraStatus::kCalibrated);
    }
    const auto known = [&] {
      double sum = 0.0;
      for (std::size_t c = 2; c < 8; ++c) sum += flight.camera(c).estimate.covariance.trace();
      return sum;
    };
    const double after_refinement = known();
    flight.run(3 * kSecond);
    EXPECT_LT(known(), after_refinement) << "they learn on";
  }
  EXPECT_GE(refined, 16);
  std::printf("eight cameras: %.2f mm before the refinement, %.2f mm after it\n",
              1e3 * std::sqrt(before_m / 24.0), 1e3 * std::sqrt(after_m / 24.0));
  EXPECT_LT(after_m, before_m);
}

TEST(CalibrationOrder, ACameraThatIsKnockedEndsTheRefinement) {
  RigConfig rig = test::shippedRig("paper", 9);
  rig.simulation.bumps = {{cameraId(0), 14.1, toRadians(5.0), 0.05}};
  Flight flight(rig);
  flight.run(14 * kSecond);
  ASSERT_EQ(flight.order(CalibrationOrderKind::kRefine, 0), nullptr);
  flight.run(6 * kSecond);
  EXPECT_EQ(flight.camera(0).knocks_found, 1);
  EXPECT_STREQ(flight.camera(2).calibration_method, "joint");
}

TEST(CalibrationOrder, ACalibrationOfOtherBallsIsRefused) {
  RigConfig rig = test::shippedRig("paper", 6);
  SavedCalibration saved;
  saved.cameras.push_back({"1", "joint", *rig.cameras[0].camera_from_world, Matrix6d::Zero()});
  saved.markers_in_body = {{0.1, 0.0, 0.0}, {0.0, 0.1, 0.0}, {0.0, 0.0, 0.1}};
  EXPECT_THROW(giveCalibration(saved, rig), Error);
}

TEST(CalibrationOrder, BallsOfALoadedCalibrationAreNotTakenOverAndItIsSaid) {
  const RigConfig rig = test::shippedRig("paper", 6);
  SavedCalibration saved;
  saved.cameras.push_back({"1", "joint", *rig.cameras[0].camera_from_world, Matrix6d::Zero()});
  const Announcer announcer(rig);
  const auto told = [&](const MarkerLayout& flown_with) {
    const CalibrationOrder order = adoptOrders(saved, rig, flown_with).at(0);
    return std::string(announcer.ordered(0, order, nullptr).text.data());
  };
  const std::string as_always = "Camera 1: believed to stand where the loaded calibration says";
  EXPECT_EQ(told(rig.markers_in_body), as_always);
  std::vector<Eigen::Vector3d> others(rig.markers_in_body.all().begin(), rig.markers_in_body.all().end());
  others[2].z() += 1.2e-3;
  const std::string refused_balls =
      "Camera 1: placed by the loaded calibration, but its balls are not used, off by up to: 1.2 mm";
  // It was found with the rig's balls, and others are flown with.
  EXPECT_EQ(told(MarkerLayout(others, rig.markers_in_body.radius())), refused_balls);
  saved.markers_in_body = others;
  EXPECT_EQ(told(rig.markers_in_body), refused_balls);
  EXPECT_EQ(told(MarkerLayout(others, rig.markers_in_body.radius())), as_always);
  saved.markers_in_body.pop_back();
  EXPECT_THROW(adoptOrders(saved, rig, rig.markers_in_body), Error);
}

/// What it shows contradicts the others: it is taken out, as after a knock, and the others stay.
TEST(CalibrationOrder, AnAdoptedFocalLengthThatDoesNotFitIsLaidAtNoOthersDoor) {
  for (const double scale : {0.95, 0.99, 1.01, 1.05}) {
    const RigConfig rig = test::shippedRig("calibrated", 3);
    Flight flight(rig);
    flight.run(10 * kSecond);
    CalibrationOrder order;
    order.kind = CalibrationOrderKind::kAdopt;
    order.camera = cameraId(1);
    order.camera_from_world = *rig.cameras[1].camera_from_world;
    order.focal_scale = scale;
    ASSERT_EQ(flight.lock_step.orderCalibration(order), nullptr);
    flight.run(4 * kSecond);
    EXPECT_FALSE(flight.now.verdict.crashed) << scale;
    EXPECT_EQ(flight.camera(1).knocks_found, 1) << scale;
    for (const std::size_t other : {0u, 2u}) {
      EXPECT_EQ(flight.camera(other).knocks_found, 0) << scale;
      EXPECT_EQ(flight.camera(other).estimate.status, CameraStatus::kCalibrated) << scale;
    }
  }
}

TEST(CalibrationOrder, ACalibrationOfAnotherRigIsRefused) {
  SavedCalibration saved;
  saved.cameras.push_back({"nobody", "joint", {}, Matrix6d::Zero()});
  RigConfig rig = test::shippedRig("paper", 6);
  EXPECT_THROW(adoptOrders(saved, rig, rig.markers_in_body), Error);
  EXPECT_THROW(giveCalibration(saved, rig), Error);
}

TEST(CalibrationOrder, ARigIsGivenACalibrationAndKeepsItsTruth) {
  RigConfig rig = test::shippedRig("calibrated", 7);
  const RigidTransform truth = *rig.cameras[1].camera_from_world;
  SavedCalibration saved;
  RigidTransform elsewhere = truth;
  elsewhere.translation.x() += 0.01;
  saved.cameras.push_back({"2", "joint", elsewhere, Matrix6d::Identity()});
  giveCalibration(saved, rig);
  EXPECT_EQ(rig.cameras[1].camera_from_world->translation, elsewhere.translation);
  EXPECT_EQ(rig.simulation.true_camera_from_world[1]->translation, truth.translation);
  EXPECT_FALSE(rig.cameras[1].learns());
}

}  // namespace
}  // namespace helical
