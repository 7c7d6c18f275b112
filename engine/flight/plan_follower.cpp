#include "engine/flight/plan_follower.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kYawRate = 0.6;        // rad/s of the reference
constexpr double kYawFreeHeight = 0.1;  // m above the pad, below which the heading is left as it is
constexpr double kLongestLead = 0.12;   // m that the climbing reference may run ahead
constexpr double kSlowHeight = 0.12;    // m above the pad, below which the descent is slow
constexpr double kBelowGround = -0.15;  // m: the reference's end when landing

}  // namespace

PlanFollower::PlanFollower(const FlightPlan& plan) : plan_(plan) {}

void PlanFollower::swapPlan(FlightPlan& plan) {
  const Waypoint before = plan_.waypoints[waypoint_];
  const bool had_more = waypoint_ < plan.waypoints.size();
  std::swap(plan_, plan);
  waypoint_ = std::min(waypoint_, plan_.waypoints.size() - 1);
  const Waypoint& now = plan_.waypoints[waypoint_];
  const bool same = had_more && now.position_above_pad == before.position_above_pad && now.yaw == before.yaw;
  if (!same) held_s_ = 0.0;
  finished_ = false;
}

void PlanFollower::start(const SetPoint& here, double pad_height) {
  set_point_ = here;
  set_point_.velocity_in_world.setZero();
  pad_height_ = pad_height;
  waypoint_ = 0;
  held_s_ = 0.0;
  reached_first_ = finished_ = false;
}

void PlanFollower::resetTo(const Eigen::Vector3d& position) {
  set_point_.position_in_world = position;
  set_point_.velocity_in_world.setZero();
}

const SetPoint& PlanFollower::step(double dt, const Eigen::Vector3d& position, bool landing) {
  const Eigen::Vector3d before = set_point_.position_in_world;
  if (landing)
    descend(dt, position);
  else
    climbOrFollow(dt, position);
  set_point_.velocity_in_world = (set_point_.position_in_world - before) / dt;
  return set_point_;
}

void PlanFollower::climbOrFollow(double dt, const Eigen::Vector3d& position) {
  const Waypoint& waypoint = plan_.waypoints[waypoint_];
  Eigen::Vector3d target = waypoint.position_above_pad;
  target.z() += pad_height_;
  Eigen::Vector3d& reference = set_point_.position_in_world;
  if (!reached_first_) {
    // Up first, over the place where it should hover.
    const Eigen::Vector2d aside = target.head<2>() - reference.head<2>();
    reference.head<2>() += aside * std::min(1.0, waypoint.speed * dt / std::max(aside.norm(), 1e-9));
    const bool runs_ahead = reference.z() - position.z() > kLongestLead;
    if (!runs_ahead) reference.z() += std::clamp(target.z() - reference.z(), 0.0, plan_.climb_speed * dt);
    if (position.z() - pad_height_ > kYawFreeHeight)
      set_point_.yaw += std::clamp(wrapAngle(waypoint.yaw - set_point_.yaw), -kYawRate * dt, kYawRate * dt);
    reached_first_ = reference.z() >= target.z() - 1e-9;
    return;
  }
  const Eigen::Vector3d way = target - reference;
  const double distance = way.norm();
  const double reach = waypoint.speed * dt;
  reference = distance <= reach ? target : Eigen::Vector3d(reference + way * (reach / distance));
  const double turn = wrapAngle(waypoint.yaw - set_point_.yaw);
  set_point_.yaw = wrapAngle(set_point_.yaw + std::clamp(turn, -kYawRate * dt, kYawRate * dt));
  if (distance > reach || std::abs(turn) > kYawRate * dt) return;
  held_s_ += dt;
  if (held_s_ < waypoint.hold_s) return;
  if (waypoint_ + 1 < plan_.waypoints.size()) {
    ++waypoint_;
    held_s_ = 0.0;
  } else {
    finished_ = true;
  }
}

bool PlanFollower::atLowerEnd() const {
  return set_point_.position_in_world.z() <= pad_height_ + kBelowGround + 1e-9;
}

void PlanFollower::descend(double dt, const Eigen::Vector3d& position) {
  const double height = position.z() - pad_height_;
  const double speed = height < kSlowHeight ? plan_.touchdown_speed : plan_.descent_speed;
  double& reference = set_point_.position_in_world.z();
  reference = std::max(reference - speed * dt, pad_height_ + kBelowGround);
}

}  // namespace helical
