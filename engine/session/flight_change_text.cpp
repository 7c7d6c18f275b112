#include "engine/session/flight_change_text.h"

#include <array>
#include <nlohmann/json.hpp>

#include "engine/session/byte_stream.h"

namespace helical {
namespace {

using nlohmann::json;

json planJson(const FlightPlan& plan) {
  json waypoints = json::array();
  for (const Waypoint& waypoint : plan.waypoints) {
    const Eigen::Vector3d& p = waypoint.position_above_pad;
    waypoints.push_back({p.x(), p.y(), p.z(), waypoint.yaw, waypoint.hold_s, waypoint.speed});
  }
  return {{"name", plan.name},
          {"start_delay_s", plan.start_delay_s},
          {"climb_speed", plan.climb_speed},
          {"descent_speed", plan.descent_speed},
          {"touchdown_speed", plan.touchdown_speed},
          {"land_at_s", plan.land_at_s},
          {"waypoints", waypoints}};
}

FlightPlan planOf(const json& value) {
  FlightPlan plan;
  plan.name = value.at("name").get<std::string>();
  plan.start_delay_s = value.at("start_delay_s").get<double>();
  plan.climb_speed = value.at("climb_speed").get<double>();
  plan.descent_speed = value.at("descent_speed").get<double>();
  plan.touchdown_speed = value.at("touchdown_speed").get<double>();
  plan.land_at_s = value.at("land_at_s").get<double>();
  plan.waypoints.clear();
  for (const json& waypoint : value.at("waypoints")) {
    const auto v = waypoint.get<std::array<double, 6>>();
    plan.waypoints.push_back({{v[0], v[1], v[2]}, v[3], v[4], v[5]});
  }
  return plan;
}

}  // namespace

std::string textOf(const FlightChange& change) {
  json value = json::object();
  if (change.plan) value["plan"] = planJson(*change.plan);
  if (change.control)
    for (const ControllerKey& key : controllerKeys()) value["control"][key.name] = *change.control.*key.value;
  return value.dump();
}

FlightChange flightChangeOf(const std::string& text, const ControllerOptions& control) {
  FlightChange change;
  try {
    const json value = json::parse(text);
    if (value.contains("plan")) change.plan = planOf(value.at("plan"));
    if (value.contains("control")) {
      change.control = control;
      for (const ControllerKey& key : controllerKeys())
        *change.control.*key.value = value.at("control").at(key.name).get<double>();
    }
    validate(change);
  } catch (const std::exception&) {
    throw CutShort();
  }
  return change;
}

}  // namespace helical
