#include "engine/tracking/motion_model.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/helicopter/helicopter_parameters.h"

namespace helical {
namespace {

constexpr double kLongestStep = 0.01;  // s; the linearisation's error over it is far below the noise

int stepsFor(double dt) {
  return std::max(1, static_cast<int>(std::ceil(std::abs(dt) / kLongestStep)));
}

void addIntegratedNoise(Matrix12d& covariance, int integral, int rate, double density, double dt) {
  const double q = density * density;
  covariance(integral, integral) += q * dt * dt * dt / 3.0;
  covariance(integral, rate) += q * dt * dt / 2.0;
  covariance(rate, integral) += q * dt * dt / 2.0;
  covariance(rate, rate) += q * dt;
}

void addNoise(Matrix12d& covariance, const MotionNoise& noise, double dt) {
  for (int axis = 0; axis < 3; ++axis) {
    addIntegratedNoise(covariance, kPositionError + axis, kVelocityError + axis,
                       axis < 2 ? noise.lateral : noise.vertical, dt);
    addIntegratedNoise(covariance, kRotationError + axis, kSpinError + axis,
                       axis < 2 ? noise.tilt : noise.yaw, dt);
  }
}

}  // namespace

void MotionModel::propagate(HelicopterState& state, double dt, bool airborne) const {
  const int steps = stepsFor(dt);
  for (int i = 0; i < steps; ++i) step(state, dt / steps, airborne);
}

void MotionModel::propagate(HelicopterState& state, Matrix12d& covariance, const MotionNoise& noise,
                            double dt, bool airborne) const {
  const int steps = stepsFor(dt);
  for (int i = 0; i < steps; ++i) {
    const Matrix12d f = transition(state, dt / steps, airborne);
    covariance = f * covariance * f.transpose();
    if (dt > 0.0) addNoise(covariance, noise, dt / steps);
    covariance = 0.5 * (covariance + covariance.transpose()).eval();
    step(state, dt / steps, airborne);
  }
}

Matrix12d MotionModel::transition(const HelicopterState& state, double dt, bool airborne) const {
  const Eigen::Vector3d turn = dt * state.angular_velocity_in_body;
  Matrix12d f = Matrix12d::Identity();
  f.block<3, 3>(kPositionError, kVelocityError) = dt * Eigen::Matrix3d::Identity();
  f.block<3, 3>(kRotationError, kRotationError) = expSO3(-turn).toRotationMatrix();
  f.block<3, 3>(kRotationError, kSpinError) = dt * rightJacobianSO3(turn);
  if (dt > 0.0) f.block<3, 3>(kSpinError, kSpinError) *= std::exp(-dt / spin_decay_s_);
  if (airborne) {
    Eigen::Matrix3d tilt =
        -kGravity * state.world_from_body.rotation.toRotationMatrix() * hat(Eigen::Vector3d::UnitZ());
    tilt.row(2).setZero();
    f.block<3, 3>(kVelocityError, kRotationError) = dt * tilt;
    f.block<3, 3>(kPositionError, kRotationError) = 0.5 * dt * dt * tilt;
  }
  return f;
}

void MotionModel::step(HelicopterState& state, double dt, bool airborne) const {
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  if (airborne) {
    const Eigen::Vector3d shaft = state.world_from_body.rotation * Eigen::Vector3d::UnitZ();
    acceleration.head<2>() = kGravity * shaft.head<2>();
  }
  state.world_from_body.translation += dt * state.velocity_in_world + 0.5 * dt * dt * acceleration;
  state.velocity_in_world += dt * acceleration;
  state.world_from_body.rotation =
      (state.world_from_body.rotation * expSO3(dt * state.angular_velocity_in_body)).normalized();
  if (dt > 0.0) state.angular_velocity_in_body *= std::exp(-dt / spin_decay_s_);
}

}  // namespace helical
