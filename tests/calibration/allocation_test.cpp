#include <gtest/gtest.h>

#include <string>

#include "engine/calibration/admission.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/calibration/cramer_rao.h"
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

}  // namespace
}  // namespace helical
