#pragma once

#include <Eigen/Core>

#include "engine/helicopter/helicopter_parameters.h"
#include "engine/helicopter/helicopter_state.h"
#include "engine/helicopter/stick_demand.h"

namespace helical {

/// Air that moves: wind [m/s] in the world and a turbulent moment [N m] in the body.
struct Gust {
  Eigen::Vector3d wind_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d moment_in_body = Eigen::Vector3d::Zero();
};

/// Non-linear equations of motion of a coaxial helicopter with stabiliser bar: rigid body, rotor speeds, bar
/// axis and lower tip-path axis (21 states), integrated by Runge-Kutta 4, with swash-plate servos, ground
/// effect and skids on the ground (spring, damper, Coulomb friction at four corners). Model: see
/// HelicopterParameters; the lower rotor's tip-path lag is added because the published model is unstable in
/// attitude without it. One thread.
class Dynamics {
 public:
  explicit Dynamics(const HelicopterParameters& parameters);

  /// Puts it on its skids at rest, rotors still.
  void placeOnGround(double x, double y, double yaw);

  /// Sets the rigid body right; rotors, bar and servos stay as they are.
  void setState(const HelicopterState& state);

  /// One step of `dt` seconds (1 ms) under `demand`.
  void step(const StickDemand& demand, const Gust& gust, double dt);

  HelicopterState state() const;
  double upperRotorSpeed() const { return x_[kUpperSpeed]; }  ///< rad/s
  double lowerRotorSpeed() const { return x_[kLowerSpeed]; }  ///< rad/s
  bool onGround() const { return on_ground_; }
  /// Downward speed [m/s] at the hardest touch so far.
  double hardestTouch() const { return hardest_touch_; }
  const HelicopterParameters& parameters() const { return parameters_; }

 private:
  using State = Eigen::Matrix<double, 21, 1>;
  enum Index {
    kPosition = 0,
    kVelocity = 3,
    kRotation = 6,
    kSpin = 10,
    kUpperSpeed = 13,
    kLowerSpeed = 14,
    kBar = 15,
    kTipPath = 18
  };
  struct Wrench {
    Eigen::Vector3d force_in_world, moment_in_body;
  };

  State derivative(const State& x, const StickDemand& demand, const Gust& gust, bool* touching) const;
  Wrench rotors(const State& x, Eigen::Vector3d* tip_path_target) const;
  Wrench ground(const State& x, const Eigen::Matrix3d& world_from_body, bool* touching) const;

  HelicopterParameters parameters_;
  State x_;
  double swash_roll_ = 0.0;   ///< rad
  double swash_pitch_ = 0.0;  ///< rad
  bool on_ground_ = true;
  double hardest_touch_ = 0.0;
};

}  // namespace helical
