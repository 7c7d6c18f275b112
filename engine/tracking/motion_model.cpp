#include "engine/tracking/motion_model.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/rotation.h"
#include "engine/helicopter/helicopter_parameters.h"

namespace helical {
namespace {

constexpr double kLettingGo = 3.0;
constexpr double kLongestStep = 0.01;  // s; the linearisation's error over it is far below the noise

void addIntegratedNoise(Matrix12d& covariance, int integral, int rate, double density, double dt) {
  const double q = density * density;
  covariance(integral, integral) += q * dt * dt * dt / 3.0;
  covariance(integral, rate) += q * dt * dt / 2.0;
  covariance(rate, integral) += q * dt * dt / 2.0;
  covariance(rate, rate) += q * dt;
}

}  // namespace

void MotionModel::propagate(HelicopterState& state, Matrix12d* covariance, double dt, bool airborne) const {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(dt) / kLongestStep)));
  for (int i = 0; i < steps; ++i) step(state, covariance, dt / steps, airborne);
}

void MotionModel::step(HelicopterState& state, Matrix12d* covariance, double dt, bool airborne) const {
  const double spin_decay = dt > 0.0 ? std::exp(-dt / options_.spin_decay_s) : 1.0;
  const Eigen::Vector3d spin = state.angular_velocity_in_body;
  const Eigen::Matrix3d world_from_body = state.world_from_body.rotation.toRotationMatrix();

  if (covariance != nullptr) {
    Matrix12d transition = Matrix12d::Identity();
    transition.block<3, 3>(kPositionError, kVelocityError) = dt * Eigen::Matrix3d::Identity();
    transition.block<3, 3>(kRotationError, kRotationError) = expSO3(-dt * spin).toRotationMatrix();
    transition.block<3, 3>(kRotationError, kSpinError) = dt * rightJacobianSO3(dt * spin);
    transition.block<3, 3>(kSpinError, kSpinError) *= spin_decay;
    if (airborne) {
      Eigen::Matrix3d tilt = -kGravity * world_from_body * hat(Eigen::Vector3d::UnitZ());
      tilt.row(2).setZero();
      transition.block<3, 3>(kVelocityError, kRotationError) = dt * tilt;
      transition.block<3, 3>(kPositionError, kRotationError) = 0.5 * dt * dt * tilt;
    }
    *covariance = transition * *covariance * transition.transpose();
    if (dt > 0.0) {
      for (int axis = 0; axis < 3; ++axis) {
        addIntegratedNoise(
            *covariance, kPositionError + axis, kVelocityError + axis,
            axis < 2 ? options_.acceleration_noise_lateral : options_.acceleration_noise_vertical, dt);
        // The skids hold it, then let go at once against all the torque that the trims do not balance.
        const double yaw_noise = (airborne ? 1.0 : kLettingGo) * options_.spin_noise_yaw;
        addIntegratedNoise(*covariance, kRotationError + axis, kSpinError + axis,
                           axis < 2 ? options_.spin_noise_tilt : yaw_noise, dt);
      }
    }
    *covariance = 0.5 * (*covariance + covariance->transpose()).eval();
  }

  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
  if (airborne) acceleration.head<2>() = kGravity * world_from_body.col(2).head<2>();
  state.world_from_body.translation += dt * state.velocity_in_world + 0.5 * dt * dt * acceleration;
  state.velocity_in_world += dt * acceleration;
  state.world_from_body.rotation = (state.world_from_body.rotation * expSO3(dt * spin)).normalized();
  state.angular_velocity_in_body *= spin_decay;
}

}  // namespace helical
