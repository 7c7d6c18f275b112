#include "engine/calibration/admission.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/calibration/camera_perturbation.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/training_flight.h"

namespace helical {
namespace {

using test::flyForTraining;
using test::TrainingFlight;

/// Feeds the rule 60 frames a second of the same evidence.
class Camera {
 public:
  void see(double seconds, double uncertainty_m, double residual) {
    for (int k = 0; k < static_cast<int>(std::lround(60 * seconds)); ++k) {
      time_ += fromSeconds(1.0 / 60.0);
      const CameraStatus before = memory.status;
      memory = admit(options, memory, {time_, uncertainty_m, residual});
      changes += memory.status != before ? 1 : 0;
    }
  }
  void skip(double seconds) { time_ += fromSeconds(seconds); }

  AdmissionOptions options;
  AdmissionMemory memory;
  int changes = 0;

 private:
  TimeNs time_ = kNanosecondsPerSecond;
};

TEST(Admission, TakesAWindowOfGoodFrames) {
  Camera camera;
  camera.see(0.4, 0.001, 1.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrating);
  camera.see(0.2, 0.001, 1.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrated);
}

TEST(Admission, NeedsBothUncertaintyAndResidual) {
  Camera unsure, wrong;
  unsure.see(10.0, 0.02, 1.0);
  wrong.see(10.0, 0.001, 3.0);
  EXPECT_EQ(unsure.memory.status, CameraStatus::kCalibrating);
  EXPECT_EQ(wrong.memory.status, CameraStatus::kCalibrating);
}

TEST(Admission, HasHysteresisBetweenItsLimits) {
  Camera camera;
  camera.see(1.0, 0.001, 1.0);
  camera.see(20.0, 0.02, 4.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrated);
  EXPECT_EQ(camera.changes, 1);
}

TEST(Admission, RejectsAKnockedCameraAndTakesItBackWhenItIsGoodAgain) {
  Camera camera;
  camera.see(2.0, 0.001, 1.0);
  camera.see(0.3, 0.001, 18.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kRejected);
  camera.see(5.0, 0.001, 3.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kRejected);
  camera.see(4.0, 0.001, 1.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrated);
}

TEST(Admission, OnlyUncertaintySendsBackToCalibrating) {
  Camera camera;
  camera.see(2.0, 0.001, 1.0);
  camera.see(0.1, 0.05, 1.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrating);
  camera.see(2.0, std::nan(""), 1.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrating);
}

TEST(Admission, FramesWithoutAResidualChangeNothingAndOneBadFrameDoesNotCount) {
  Camera camera;
  camera.see(2.0, 0.001, 1.0);
  camera.see(2.0, 1.0, -1.0);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrated);
  camera.see(1.0 / 60.0, 0.001, 1e9);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrated);
  camera.skip(5.0);
  camera.see(1.0 / 60.0, 0.001, 1e9);
  EXPECT_EQ(camera.memory.status, CameraStatus::kCalibrated);
}

TEST(Admission, RejectsOptionsThatLeaveNoGap) {
  const auto with = [](auto change) {
    AdmissionOptions options;
    change(options);
    return options;
  };
  EXPECT_NO_THROW(validate(AdmissionOptions{}));
  EXPECT_THROW(validate(with([](auto& o) { o.drop_residual = o.admit_residual; })), Error);
  EXPECT_THROW(validate(with([](auto& o) { o.drop_uncertainty_m = 0.001; })), Error);
  EXPECT_THROW(validate(with([](auto& o) { o.window_s = 0.0; })), Error);
  EXPECT_THROW(validate(with([](auto& o) { o.reach_m = std::nan(""); })), Error);
}

TEST(UncertaintyAround, IsTheLargestErrorThatTheCovarianceAllowsNearby) {
  const TrainingFlight flight = flyForTraining(1, {.duration_s = 0.1});
  CameraEstimate estimate{flight.camera_from_world, Matrix6d::Zero(), CameraStatus::kCalibrating};
  estimate.covariance.diagonal().tail<3>().setConstant(0.01 * 0.01);
  const Eigen::Vector3d centre(0, 0, 0.3);
  EXPECT_NEAR(uncertaintyAround(flight.camera, estimate, centre, 0.01), 0.01, 0.001);
  estimate.covariance.setZero();
  estimate.covariance(2, 2) = 0.01 * 0.01;  // a roll: nothing on the axis, all of it off it
  const Eigen::Vector3d on_axis = flight.camera_from_world.inverse() * Eigen::Vector3d(0, 0, 2.5);
  EXPECT_LT(uncertaintyAround(flight.camera, estimate, on_axis, 1e-6), 1e-6);
  EXPECT_NEAR(uncertaintyAround(flight.camera, estimate, on_axis, 0.3), 0.003, 0.0006);
}

TEST(NormalisedResidual, IsOneForExpectedErrorsAndIgnoresOneFalseBall) {
  const TrainingFlight flight = flyForTraining(2, {.outliers = 0.02});
  const CameraEstimate truth{flight.camera_from_world, Matrix6d::Zero(), CameraStatus::kCalibrated};
  double sum = 0.0;
  int count = 0;
  for (const auto& frame : flight.frames) {
    const double residual = normalisedResidual(flight.camera, flight.markers, truth, frame.view());
    if (residual < 0.0) continue;
    EXPECT_GE(frame.pixels.size(), 3u);
    sum += residual;
    ++count;
  }
  EXPECT_GT(count, 700);
  EXPECT_NEAR(sum / count, 1.0, 0.3);
}

/// How far apart two poses of a camera put the helicopter, across the line of sight.
double errorAtHelicopter(const TrainingFlight& flight, const RigidTransform& pose,
                         const Eigen::Vector3d& place) {
  const Eigen::Vector3d in_true = flight.camera_from_world * place, in_estimated = pose * place;
  return in_true.z() * (in_true / in_true.z() - in_estimated / in_estimated.z()).norm();
}

/// The rule with the methods: the good ones are let in, whoever is let in is right where it flies, and the
/// one that never finds the camera stays out.
TEST(Admission, LetsInWhatIsGoodEnough) {
  const AdmissionOptions options;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const TrainingFlight flight = flyForTraining(100 + seed);
    for (const auto& method : calibratorNames()) {
      const auto calibrator = makeCalibrator(method, {}, flight.camera, flight.markers, 1);
      calibrator->restart(flight.guess);
      AdmissionMemory memory;
      for (const auto& frame : flight.frames) {
        calibrator->step(frame.view());
        const CameraEstimate estimate = calibrator->estimate();
        const CameraStatus before = memory.status;
        memory = admit(
            options, memory,
            {frame.exposure,
             uncertaintyAround(flight.camera, estimate, frame.world_from_body.translation, options.reach_m),
             normalisedResidual(flight.camera, flight.markers, estimate, frame.view())});
        if (before != CameraStatus::kCalibrated && memory.status == CameraStatus::kCalibrated) {
          EXPECT_LT(errorAtHelicopter(flight, estimate.camera_from_world, frame.world_from_body.translation),
                    0.015)
              << method;
        }
      }
      const bool good = method == "particle-filter" || method == "growing-gauss-newton";
      if (good) {
        EXPECT_EQ(memory.status, CameraStatus::kCalibrated) << method << seed;
      }
      if (method == "particle-filter-literal") {
        EXPECT_NE(memory.status, CameraStatus::kCalibrated) << seed;
      }
    }
  }
}

}  // namespace
}  // namespace helical
