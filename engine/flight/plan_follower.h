#pragma once

#include "engine/flight/flight_plan.h"
#include "engine/flight/flight_state.h"

namespace helical {

/// Moves the set-point along a plan: up to the first waypoint's height, from waypoint to waypoint at their
/// speeds, down to the ground for landing. The reference waits for the helicopter where that is held back.
/// One thread.
class PlanFollower {
 public:
  explicit PlanFollower(const FlightPlan& plan);

  /// Another plan from now on, swapped so that nothing is allocated. It is flown on from the waypoint of the
  /// same number, or the last one; a waypoint that is the same as before is not held anew.
  void swapPlan(FlightPlan& plan);
  const FlightPlan& plan() const { return plan_; }

  /// Starts at lift-off from where the helicopter is; `pad_height` is the body's origin standing on the pad.
  void start(const SetPoint& here, double pad_height);

  /// Moves the set-point by `dt` seconds. `position` is the helicopter's now. In flight it makes for the
  /// waypoints; with `landing` it goes down where it is and on into the ground, so that it surely touches.
  const SetPoint& step(double dt, const Eigen::Vector3d& position, bool landing);

  /// Set-point to where the helicopter is, after a gap: no jump, no race back.
  void resetTo(const Eigen::Vector3d& position);

  /// Leaves the set-point where it is for this tick.
  void stay() { set_point_.velocity_in_world.setZero(); }

  bool atLowerEnd() const;                     ///< of a landing: as far under the ground as it goes
  bool finished() const { return finished_; }  ///< every waypoint was held
  bool atFirstWaypoint() const { return reached_first_; }
  const SetPoint& setPoint() const { return set_point_; }

 private:
  void climbOrFollow(double dt, const Eigen::Vector3d& position);
  void descend(double dt, const Eigen::Vector3d& position);

  FlightPlan plan_;
  SetPoint set_point_;
  double pad_height_ = 0.0;
  std::size_t waypoint_ = 0;
  double held_s_ = 0.0;
  bool reached_first_ = false;
  bool finished_ = false;
};

}  // namespace helical
