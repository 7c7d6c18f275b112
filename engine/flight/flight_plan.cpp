#include "engine/flight/flight_plan.h"

#include <cmath>

#include "engine/base/error.h"

namespace helical {
namespace {

void require(bool condition, const std::string& key, double value, const char* cure) {
  if (!condition || !std::isfinite(value))
    throw Error(ErrorKind::kInput, key + " is " + std::to_string(value), {}, cure);
}

}  // namespace

void validate(const FlightPlan& plan) {
  require(plan.carried_s == 0.0 || (plan.carried_s >= 10.0 && plan.carried_s <= 600.0), "carried_s", plan.carried_s,
          "give 10 to 600 s, or 0 for not at all");
  require(plan.start_delay_s >= 0.0 && plan.start_delay_s <= 600.0, "start_delay_s", plan.start_delay_s,
          "give 0 to 600 seconds");
  require(plan.climb_speed > 0.0 && plan.climb_speed <= 1.0, "climb_speed", plan.climb_speed,
          "give up to 1 m/s");
  require(plan.descent_speed > 0.0 && plan.descent_speed <= 0.5, "descent_speed", plan.descent_speed,
          "give up to 0.5 m/s");
  require(plan.touchdown_speed > 0.0 && plan.touchdown_speed <= plan.descent_speed, "touchdown_speed",
          plan.touchdown_speed, "give at most the descent speed");
  require(true, "land_at_s", plan.land_at_s, "give a time, or 0 to land after the last waypoint");
  if (plan.waypoints.empty())
    throw Error(ErrorKind::kInput, "the plan has no waypoint", {}, "give at least one: the place to hover");
  for (std::size_t i = 0; i < plan.waypoints.size(); ++i) {
    const Waypoint& waypoint = plan.waypoints[i];
    const std::string name = "waypoint " + std::to_string(i + 1);
    const double height = waypoint.position_above_pad.z();
    require(height >= 0.1, name + ": height", height, "give at least 0.1 m above the pad");
    require(waypoint.position_above_pad.allFinite(), name + ": position", waypoint.position_above_pad.sum(),
            "give three numbers in metres");
    require(std::abs(waypoint.yaw) <= 6.3, name + ": yaw", waypoint.yaw, "give at most one turn");
    require(waypoint.hold_s >= 0.0, name + ": hold_s", waypoint.hold_s, "give 0 or more seconds");
    require(waypoint.speed > 0.0 && waypoint.speed <= 1.0, name + ": speed", waypoint.speed,
            "give up to 1 m/s");
  }
}

}  // namespace helical
