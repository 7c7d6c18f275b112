#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/base/random.h"
#include "engine/calibration/admission.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/calibration/cold_start.h"
#include "engine/calibration/cramer_rao.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/looking_camera.h"
#include "tests/calibration/training_flight.h"
#include "tests/support/allocation_counter.h"

namespace helical {
namespace {

TEST(Allocation, NoMethodAllocatesInFlight) {
  const test::TrainingFlight flight = test::flyForTraining(1, {.duration_s = 10.0, .outliers = 0.1});
  for (const auto& method : calibratorNames()) {
    const auto calibrator = makeCalibrator(method, {}, flight.camera, flight.markers, 1);
    const long before = test::allocations();
    calibrator->restart(flight.guess);
    for (const auto& frame : flight.frames) calibrator->step(frame.view());
    calibrator->restart(flight.guess);
    for (const auto& frame : flight.frames) calibrator->step(frame.view());
    EXPECT_EQ(test::allocations() - before, 0) << method;
  }
}

TEST(Allocation, NorDoAdmissionAndBound) {
  const test::TrainingFlight flight = test::flyForTraining(1, {.duration_s = 1.0});
  const CameraEstimate estimate{flight.camera_from_world, Matrix6d::Identity(), CameraStatus::kCalibrating};
  const std::array<MarkerId, 4> all{markerId(0), markerId(1), markerId(2), markerId(3)};
  CramerRaoBound bound;
  AdmissionMemory memory;
  double sum = 0.0;
  const long before = test::allocations();
  for (const auto& frame : flight.frames) {
    bound.add(flight.camera, flight.camera_from_world, flight.markers, all, frame.true_world_from_body,
              frame.pose_information, 0.5);
    memory = admit({}, memory,
                   {frame.exposure, uncertaintyAround(flight.camera, estimate, Eigen::Vector3d::Zero(), 0.3),
                    normalisedResidual(flight.camera, flight.markers, estimate, frame.view())});
    if (bound.bound()) sum += bound.bound()->position_m;
  }
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_GT(sum, 0.0);
}

/// Two metres and a half away, a third of the circle apart, looking at a point above the pad.
RigidTransform coldCamera(std::size_t index) {
  return lookingFrom(2.0944 * static_cast<double>(index) - 0.5, 0.7, 2.5, 0.3);
}

/// Two seconds on the pad, then carried about.
RigidTransform carriedTo(double time_s) {
  const double t = std::max(0.0, time_s - 2.0), grown = std::min(1.0, t);
  RigidTransform pose;
  pose.translation = {0.3 * grown * std::sin(1.1 * t), 0.3 * grown * std::sin(0.7 * t),
                      0.06 + 0.25 * grown * (1.0 - std::cos(0.9 * t))};
  pose.rotation = expSO3({0.15 * grown * std::sin(1.7 * t), 0.15 * grown * std::sin(1.3 * t), 0.4 * std::sin(0.5 * t)});
  return pose;
}

Observation seenBy(const CameraModel& model, std::size_t camera, const MarkerLayout& markers, double time_s,
                   Random& random) {
  Observation observation;
  observation.camera = cameraId(static_cast<int>(camera));
  observation.exposure = fromSeconds(time_s);
  for (const Eigen::Vector3d& ball : markers.all()) {
    const auto pixel = model.project(coldCamera(camera) * (carriedTo(time_s) * ball));
    if (!pixel) continue;
    Centroid& centroid = observation.centroids[static_cast<std::size_t>(observation.count++)];
    centroid.pixel = *pixel + 0.1 * Eigen::Vector2d(random.normal(), random.normal());
    centroid.covariance = 0.01 * Eigen::Matrix2d::Identity();
  }
  return observation;
}

TEST(Allocation, NorDoesAColdStart) {
  const CameraModel model(640, 480, 567.6, 567.6, 319.5, 239.5);
  const MarkerLayout markers = MarkerLayout::paper();
  const std::vector<CameraEstimate> nothing(3);
  ColdStart start({model, model, model}, markers, 0.06, nothing);
  Random random(3);
  int answers = 0;
  const long before = test::allocations();
  for (int frame = 0; frame < 60 * 20; ++frame)
    for (std::size_t camera = 0; camera < 3; ++camera) {
      const double time_s = (frame + 0.3 * static_cast<double>(camera) + 1.0) / 60.0;
      start.step(seenBy(model, camera, markers, time_s, random));
      answers += start.takeAnswer();
    }
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_GE(answers, 1);
  for (std::size_t camera = 0; camera < 3; ++camera)
    EXPECT_LT(test::positionError(start.answer()[camera].camera_from_world, coldCamera(camera)), 0.02) << camera;
}

}  // namespace
}  // namespace helical
