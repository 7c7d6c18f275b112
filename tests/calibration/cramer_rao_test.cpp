#include "engine/calibration/cramer_rao.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <vector>

#include "engine/calibration/camera_perturbation.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/training_flight.h"

namespace helical {
namespace {

using test::flyForTraining;
using test::TrainingFlight;

constexpr double kSigma = 0.5;
constexpr std::array<MarkerId, 4> kAll{markerId(0), markerId(1), markerId(2), markerId(3)};

/// Fisher information of camera and all helicopter poses together, by numeric differences, inverted whole.
Matrix6d numericCovariance(const TrainingFlight& flight, const std::vector<std::size_t>& frames) {
  const auto size = static_cast<Eigen::Index>(6 + 6 * frames.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto& frame = flight.frames[frames[f]];
    const auto offset = static_cast<Eigen::Index>(6 + 6 * f);
    information.block<6, 6>(offset, offset) += frame.pose_information;
    for (const MarkerId marker : kAll) {
      const auto pixel = [&](const Eigen::Matrix<double, 12, 1>& change) {
        const RigidTransform& body = frame.true_world_from_body;
        const RigidTransform moved{body.rotation * expSO3(change.tail<3>()),
                                   body.translation + change.segment<3>(6)};
        return *flight.camera.project(perturbCamera(flight.camera_from_world, change.head<6>()) *
                                      (moved * flight.markers.inBody(marker)));
      };
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(2, size);
      for (int i = 0; i < 12; ++i) {
        const Eigen::Matrix<double, 12, 1> step = 1e-5 * Eigen::Matrix<double, 12, 1>::Unit(i);
        jacobian.col(i < 6 ? i : offset + i - 6) = (pixel(step) - pixel(-step)) / 2e-5;
      }
      information += jacobian.transpose() * jacobian / (kSigma * kSigma);
    }
  }
  return information.inverse().topLeftCorner<6, 6>();
}

TEST(CramerRaoBound, IsTheCornerOfTheWholeInformationInverted) {
  const TrainingFlight flight = flyForTraining(1, {.duration_s = 5.0});
  CramerRaoBound bound;
  std::vector<std::size_t> frames;
  for (std::size_t k = 0; k < flight.frames.size(); k += 30) {
    const auto& frame = flight.frames[k];
    bound.add(flight.camera, flight.camera_from_world, flight.markers, kAll, frame.true_world_from_body,
              frame.pose_information, kSigma);
    frames.push_back(k);
  }
  const Matrix6d expected = numericCovariance(flight, frames);
  ASSERT_TRUE(bound.bound().has_value());
  EXPECT_NEAR(bound.bound()->position_m / std::sqrt(expected.bottomRightCorner<3, 3>().trace()), 1.0, 1e-3);
  EXPECT_NEAR(bound.bound()->orientation_rad / std::sqrt(expected.topLeftCorner<3, 3>().trace()), 1.0, 1e-3);
}

TEST(CramerRaoBound, ShrinksWithFramesAndWithKnowledgeOfThePose) {
  const TrainingFlight flight = flyForTraining(2, {.duration_s = 5.0});
  CramerRaoBound known, vague;
  double before = 1e9;
  for (std::size_t k = 0; k < flight.frames.size(); k += 10) {
    const auto& frame = flight.frames[k];
    for (auto* bound : {&known, &vague})
      bound->add(flight.camera, flight.camera_from_world, flight.markers, kAll, frame.true_world_from_body,
                 (bound == &known ? 1.0 : 0.1) * frame.pose_information, kSigma);
    if (!known.bound()) continue;
    EXPECT_LT(known.bound()->position_m, before);
    before = known.bound()->position_m;
  }
  EXPECT_LT(known.bound()->position_m, vague.bound()->position_m);
}

TEST(CramerRaoBound, HasNothingToSayWithoutFramesPosesOrBalls) {
  const TrainingFlight flight = flyForTraining(3, {.duration_s = 1.0});
  CramerRaoBound bound;
  EXPECT_FALSE(bound.bound().has_value());
  const auto& frame = flight.frames.front();
  bound.add(flight.camera, flight.camera_from_world, flight.markers, {}, frame.true_world_from_body,
            frame.pose_information, kSigma);
  EXPECT_FALSE(bound.bound().has_value());
  bound.add(flight.camera, flight.camera_from_world, flight.markers, {kAll.data(), 2},
            frame.true_world_from_body, Matrix6d::Zero(), kSigma);
  EXPECT_FALSE(bound.bound().has_value());
}

}  // namespace
}  // namespace helical
