#include "engine/tracking/motion_model.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"
#include "engine/helicopter/helicopter_parameters.h"

namespace helical {
namespace {

using Vector12d = Eigen::Matrix<double, 12, 1>;

constexpr double kDecay = 0.3;

Eigen::Vector3d randomVector(Random& random, double sigma) {
  return sigma * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
}

HelicopterState randomState(Random& random) {
  HelicopterState state;
  state.world_from_body = {expSO3(randomVector(random, 0.8)), randomVector(random, 1.0)};
  state.velocity_in_world = randomVector(random, 1.0);
  state.angular_velocity_in_body = randomVector(random, 2.0);
  return state;
}

HelicopterState plus(HelicopterState state, const Vector12d& error) {
  state.world_from_body.translation += error.segment<3>(kPositionError);
  state.velocity_in_world += error.segment<3>(kVelocityError);
  state.world_from_body.rotation =
      (state.world_from_body.rotation * expSO3(error.segment<3>(kRotationError))).normalized();
  state.angular_velocity_in_body += error.segment<3>(kSpinError);
  return state;
}

Vector12d minus(const HelicopterState& a, const HelicopterState& b) {
  Vector12d error;
  error << a.world_from_body.translation - b.world_from_body.translation,
      a.velocity_in_world - b.velocity_in_world,
      logSO3(b.world_from_body.rotation.conjugate() * a.world_from_body.rotation),
      a.angular_velocity_in_body - b.angular_velocity_in_body;
  return error;
}

/// The covariance without noise carries F P F^T: with P = F0 F0^T of a random F0 it is compared with numeric
/// differences of the state's own motion.
TEST(MotionModel, CovarianceMovesAsTheStateDoes) {
  const MotionModel model(kDecay);
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const bool airborne = trial % 2 == 0;
    const HelicopterState start = randomState(random);
    const double dt = random.uniform(-0.01, 0.04);
    Matrix12d f;
    for (int i = 0; i < 12; ++i) {
      const double h = 1e-6;
      HelicopterState ahead = plus(start, h * Vector12d::Unit(i)),
                      behind = plus(start, -h * Vector12d::Unit(i));
      model.propagate(ahead, dt, airborne);
      model.propagate(behind, dt, airborne);
      f.col(i) = minus(ahead, behind) / (2.0 * h);
    }
    Matrix12d root;
    for (int i = 0; i < 144; ++i) root(i / 12, i % 12) = random.normal();
    const Matrix12d before = root * root.transpose();
    Matrix12d covariance = before;
    HelicopterState state = start;
    model.propagate(state, covariance, {}, dt, airborne);
    const Matrix12d expected = f * before * f.transpose();
    EXPECT_LT((covariance - expected).norm(), 1e-6 * expected.norm())
        << "dt " << dt << " airborne " << airborne;
    HelicopterState alone = start;
    model.propagate(alone, dt, airborne);
    EXPECT_LT(minus(state, alone).norm(), 1e-12) << "the same motion with and without covariance";
  }
}

TEST(MotionModel, TiltAcceleratesAlongTheShaftInTheAirOnly) {
  const MotionModel model(kDecay);
  HelicopterState state;
  state.world_from_body.rotation = expSO3({0.0, 0.1, 0.0});  // nose down: forwards
  HelicopterState standing = state;
  model.propagate(state, 0.1, true);
  EXPECT_NEAR(state.velocity_in_world.x(), 0.1 * kGravity * std::sin(0.1), 1e-9);
  EXPECT_NEAR(state.world_from_body.translation.x(), 0.5 * 0.01 * kGravity * std::sin(0.1), 1e-9);
  EXPECT_NEAR(state.velocity_in_world.z(), 0.0, 1e-12);
  model.propagate(standing, 0.1, false);
  EXPECT_EQ(standing.velocity_in_world, Eigen::Vector3d::Zero());
}

TEST(MotionModel, BodyRatesDecay) {
  const MotionModel model(kDecay);
  HelicopterState state;
  state.angular_velocity_in_body = {0.0, 0.0, 1.0};
  model.propagate(state, kDecay, false);
  EXPECT_NEAR(state.angular_velocity_in_body.z(), std::exp(-1.0), 1e-9);
  EXPECT_NEAR(yawOf(state.world_from_body.rotation), kDecay * (1.0 - std::exp(-1.0)), 0.005);
}

TEST(MotionModel, ForwardsAndBackIsWhereItWas) {
  const MotionModel model(kDecay);
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    HelicopterState start = randomState(random);
    const double dt = random.uniform(0.0, 0.01);
    HelicopterState spinning = start;
    model.propagate(spinning, dt, true);
    model.propagate(spinning, -dt, true);
    // The rates' decay is not undone: over cameras some milliseconds apart that is far below the noise.
    EXPECT_LT((spinning.world_from_body.translation - start.world_from_body.translation).norm(), 1e-4);
    EXPECT_LT(spinning.world_from_body.rotation.angularDistance(start.world_from_body.rotation),
              0.04 * dt * start.angular_velocity_in_body.norm() + 1e-9);

    start.angular_velocity_in_body.setZero();
    HelicopterState steady = start;
    model.propagate(steady, dt, trial % 2 == 0);
    model.propagate(steady, -dt, trial % 2 == 0);
    EXPECT_LT(minus(steady, start).norm(), 1e-12);
  }
}

TEST(MotionModel, StandingStillForNoTimeChangesNothing) {
  const MotionModel model(kDecay);
  Random random(3);
  const HelicopterState start = randomState(random);
  HelicopterState state = start;
  Matrix12d covariance = Matrix12d::Identity();
  model.propagate(state, covariance, {1.0, 1.0, 1.0, 1.0}, 0.0, true);
  EXPECT_LT(minus(state, start).norm(), 1e-12);
  EXPECT_LT((covariance - Matrix12d::Identity()).norm(), 1e-12);
}

TEST(MotionModel, CovarianceStaysSymmetricAndPositiveDefiniteForLong) {
  const MotionModel model(kDecay);
  Random random(4);
  HelicopterState state = randomState(random);
  Matrix12d covariance = 1e-4 * Matrix12d::Identity();
  const MotionNoise noise{0.15, 0.18, 2.4, 3.5};
  for (int i = 0; i < 20000; ++i) {
    model.propagate(state, covariance, noise, random.uniform(-0.002, 0.012), true);
    state.angular_velocity_in_body += randomVector(random, 0.05);
    if (i % 10 == 0) {
      // A measurement of position, as a filter would take it in.
      const Eigen::Matrix<double, 12, 3> p = covariance.leftCols<3>();
      const Eigen::Matrix3d s = p.topRows<3>() + 1e-6 * Eigen::Matrix3d::Identity();
      covariance -= p * s.inverse() * p.transpose();
      covariance += 1e-3 * covariance.diagonal().asDiagonal().toDenseMatrix();
    }
    ASSERT_LT((covariance - covariance.transpose()).norm(), 1e-9 * covariance.norm());
    if (i % 100 == 0) {
      const Eigen::SelfAdjointEigenSolver<Matrix12d> eigen(covariance);
      ASSERT_GT(eigen.eigenvalues().minCoeff(), 0.0) << i;
    }
  }
}

TEST(MotionModel, NoiseGrowsForwardsOnly) {
  const MotionModel model(kDecay);
  const MotionNoise noise{0.15, 0.18, 2.4, 3.5};
  HelicopterState state;
  Matrix12d forwards = Matrix12d::Zero(), back = Matrix12d::Zero();
  model.propagate(state, forwards, noise, 0.01, false);
  model.propagate(state, back, noise, -0.01, false);
  EXPECT_NEAR(forwards(kVelocityError, kVelocityError), 0.15 * 0.15 * 0.01, 1e-12);
  EXPECT_NEAR(forwards(kVelocityError + 2, kVelocityError + 2), 0.18 * 0.18 * 0.01, 1e-12);
  EXPECT_NEAR(forwards(kSpinError, kSpinError), 2.4 * 2.4 * 0.01, 1e-12);
  EXPECT_NEAR(forwards(kSpinError + 2, kSpinError + 2), 3.5 * 3.5 * 0.01, 1e-12);
  EXPECT_EQ(back.norm(), 0.0);
}

}  // namespace
}  // namespace helical
