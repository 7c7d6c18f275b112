// Which balls and lenses a refinement takes, which it refuses, and that it does not creep.

#include "engine/calibration/rig_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/looking_camera.h"

namespace helical {
namespace {

constexpr double kRefinedSigmaPx = 0.1, kRefinedRateHz = 60.0;

/// Three cameras whose poses are given exactly see a helicopter of some balls fly.
class RefinedFlight {
 public:
  explicit RefinedFlight(const SelfCalibrationOptions& self) {
    for (int c = 0; c < 3; ++c) {
      poses_.push_back(lookingFrom(2.1 * c - 0.5, 0.6, 2.7, 0.5));
      models_.emplace_back(640, 480, 567.6, 567.6, 319.5, 239.5);
    }
    RigRefinementOptions options;
    options.self = self;
    refinement_ = std::make_unique<RigRefinement>(models_, layout, options);
  }

  /// `tracked_from_world`: by how much the pose flown with is off.
  void fly(double seconds, const RigidTransform& tracked_from_world = {}) {
    for (const double end = time_ + seconds; time_ < end; time_ += 1.0 / kRefinedRateHz) {
      RigidTransform pose;
      pose.translation = {0.3 * std::sin(0.9 * time_), 0.3 * std::sin(1.3 * time_),
                          0.5 + 0.2 * std::sin(0.7 * time_)};
      pose.rotation = expSO3(Eigen::Vector3d(0.2 * std::sin(1.1 * time_), 0.2 * std::cos(1.7 * time_),
                                             0.4 * std::sin(0.5 * time_)));
      for (std::size_t c = 0; c < models_.size(); ++c) {
        NamedBalls seen;
        seen.exposure = fromSeconds(time_);
        seen.variance = static_cast<float>(kRefinedSigmaPx * kRefinedSigmaPx);
        for (std::size_t m = 0; m < balls.size(); ++m) {
          const auto pixel = models_[c].project(poses_[c] * (pose * balls[m]));
          if (!pixel) continue;
          seen.seen.set(m);
          seen.pixels[m] =
              (*pixel + kRefinedSigmaPx * Eigen::Vector2d(random_.normal(), random_.normal())).cast<float>();
          if (c == 2) seen.pixels[m].x() += static_cast<float>(m % 2 == 0 ? third_off_px : -third_off_px);
        }
        refinement_->see(cameraId(static_cast<int>(c)), seen, tracked_from_world * pose);
      }
    }
  }

  /// `believed`: the cameras' poses; status and what holds the world as given there.
  RigRefinement::Correction refine(std::span<const RigRefinement::Part> believed = {}) {
    std::array<RigRefinement::Part, 3> parts;
    for (std::size_t c = 0; c < 3; ++c) {
      parts[c].estimate.camera_from_world = poses_[c];
      parts[c].used = parts[c].holds = true;
    }
    if (!believed.empty()) std::ranges::copy(believed, parts.begin());
    EXPECT_EQ(refinement_->start(parts), nullptr);
    while (!refinement_->work()) {
    }
    return refinement_->correction();
  }

  /// The first two cameras hold the world; the third, in control, is believed to stand `off` by.
  std::array<RigRefinement::Part, 3> thirdIsOffBy(const RigidTransform& off) const {
    std::array<RigRefinement::Part, 3> parts;
    for (std::size_t c = 0; c < 3; ++c) {
      parts[c].estimate.camera_from_world = poses_[c];
      parts[c].estimate.status = CameraStatus::kCalibrated;
      parts[c].used = true;
      parts[c].holds = c < 2;
    }
    parts[2].estimate.camera_from_world = off * poses_[2];
    parts[2].estimate.covariance = 0.01 * Matrix6d::Identity();
    return parts;
  }

  /// That the third camera's images show: by so much per ball they contradict each other.
  double third_off_px = 0.0;
  const MarkerLayout layout = MarkerLayout::paper();
  std::vector<Eigen::Vector3d> balls{layout.all().begin(), layout.all().end()};
  RigRefinement& refinement() { return *refinement_; }

 private:
  Random random_{5};
  std::vector<RigidTransform> poses_;
  std::vector<CameraModel> models_;
  std::unique_ptr<RigRefinement> refinement_;
  double time_ = 0.0;
};

TEST(RigRefinement, OneBallFartherOffThanItMayBeIsNotSpreadOverAll) {
  for (const double off : {4e-3, 5e-3, 6e-3})
    for (std::size_t ball = 0; ball < 4; ++ball) {
      RefinedFlight flight({5e-4, 0.0});
      flight.balls[ball].y() += off;
      flight.fly(10.0);
      EXPECT_EQ(flight.refine(), RigRefinement::Correction::kUnsound) << 1e3 * off << " mm, ball " << ball;
      EXPECT_EQ(flight.refinement().markers().inBody(markerId(0)), flight.layout.inBody(markerId(0)));
    }
  RefinedFlight flight({5e-4, 0.0});
  flight.balls[1].y() += 1e-3;
  flight.fly(10.0);
  EXPECT_EQ(flight.refine(), RigRefinement::Correction::kFound);
}

TEST(RigRefinement, RepeatedItDoesNotCreepBeyondWhatTheRigAllows) {
  RefinedFlight flight({1e-3, 0.0});
  int found = 0;
  for (int i = 1; i <= 5; ++i) {
    flight.balls[1].y() += 2e-3;  // two of its sigmas with every refinement
    flight.fly(10.0);
    if (flight.refine() == RigRefinement::Correction::kFound) ++found;
    flight.refinement().startAfresh();
  }
  EXPECT_GE(found, 1);
  EXPECT_LE(found, 3);
  double farthest = 0.0;
  for (int m = 0; m < 4; ++m)
    farthest = std::max(
        farthest, (flight.refinement().markers().inBody(markerId(m)) - flight.layout.inBody(markerId(m)))
                      .cwiseAbs()
                      .maxCoeff());
  EXPECT_LE(farthest, 4e-3);
}

TEST(RigRefinement, WhereTheHelicopterWouldJumpNothingIsCorrected) {
  for (const bool turned : {false, true}) {
    RefinedFlight flight({1e-3, 0.0});
    flight.balls[1].y() += 2e-3;
    RigidTransform off;
    if (turned)
      off.rotation = expSO3(Eigen::Vector3d(0.0, 0.0, 0.06));
    else
      off.translation.x() = 0.12;
    flight.fly(10.0, off);
    EXPECT_EQ(flight.refine(), RigRefinement::Correction::kTooFar) << turned;
    EXPECT_EQ(flight.refinement().markers().inBody(markerId(1)), flight.layout.inBody(markerId(1)));
  }
}

TEST(RigRefinement, WhatManyImagesToldFewOnesDoNotReplace) {
  RefinedFlight flight({1e-3, 0.0});
  flight.balls[1].y() += 2e-3;
  flight.fly(20.0);
  ASSERT_EQ(flight.refine(), RigRefinement::Correction::kFound);
  const MarkerLayout found = flight.refinement().markers();
  for (int again = 0; again < 3; ++again) {
    flight.refinement().startAfresh();
    flight.fly(3.0);
    EXPECT_EQ(flight.refine(), RigRefinement::Correction::kNotNeeded);
    EXPECT_TRUE(std::ranges::equal(flight.refinement().markers().all(), found.all()));
  }
  // A ball that has moved since is another matter.
  flight.balls[3].x() += 2e-3;
  flight.refinement().startAfresh();
  flight.fly(20.0);
  EXPECT_EQ(flight.refine(), RigRefinement::Correction::kFound);
}

TEST(RigRefinement, ABallThatIsFarOffIsNotSaidToBeWhereItShould) {
  for (const double off : {10e-3, 15e-3, 20e-3})
    for (std::size_t ball = 0; ball < 4; ++ball) {
      RefinedFlight flight({5e-4, 0.0});
      flight.balls[ball].y() += off;
      flight.fly(10.0);
      EXPECT_EQ(flight.refine(), RigRefinement::Correction::kUnsound) << 1e3 * off << " mm, ball " << ball;
    }
}

TEST(RigRefinement, NoAnswerAtAllIsToldAsSuch) {
  for (const SelfCalibrationOptions& self : {SelfCalibrationOptions{}, SelfCalibrationOptions{5e-4, 0.0}}) {
    RefinedFlight flight(self);
    flight.third_off_px = 30.0;
    flight.balls[0].x() += 0.02;
    flight.balls[1].y() += 0.02;
    flight.balls[2].z() += 0.02;
    flight.fly(10.0);
    EXPECT_EQ(flight.refine(flight.thirdIsOffBy({})), RigRefinement::Correction::kNoAnswer) << self.any();
    EXPECT_EQ(flight.refinement().answer(cameraId(2)).status, CameraStatus::kUncalibrated);
  }
}

TEST(RigRefinement, BallsThatStandRightAreNotNeededThoughEveryCameraIsGiven) {
  RefinedFlight flight({5e-4, 0.0});
  flight.fly(10.0);
  EXPECT_EQ(flight.refine(), RigRefinement::Correction::kNotNeeded);
}

TEST(RigRefinement, NoCameraInControlJumpsFartherThanFlyingOnBears) {
  for (const bool turned : {false, true})
    for (const double sizes : {0.5, 2.0}) {
      RefinedFlight flight({});
      flight.fly(10.0);
      RigidTransform off;
      if (turned)
        off.rotation = expSO3(Eigen::Vector3d(0.0, 0.0, sizes * 0.04));
      else
        off.translation.x() = sizes * 0.08;
      const bool bears = sizes < 1.0;
      EXPECT_EQ(flight.refine(flight.thirdIsOffBy(off)),
                bears ? RigRefinement::Correction::kNotSought : RigRefinement::Correction::kCamerasTooFar);
      EXPECT_EQ(flight.refinement().answer(cameraId(2)).status,
                bears ? CameraStatus::kCalibrated : CameraStatus::kUncalibrated);
      // One that is not flown on may have been anywhere.
      auto parts = flight.thirdIsOffBy(off);
      parts[2].estimate.status = CameraStatus::kCalibrating;
      EXPECT_EQ(flight.refine(parts), RigRefinement::Correction::kNotSought);
    }
}

}  // namespace
}  // namespace helical
