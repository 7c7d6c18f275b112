#include "engine/config/plan_file.h"

#include "engine/config/option_fields.h"
#include "engine/config/text_file.h"
#include "engine/config/toml_table.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr OptionField<FlightPlan> kPlanFields[] = {
    {"carried_s", &FlightPlan::carried_s},
    {"start_delay_s", &FlightPlan::start_delay_s},
    {"climb_speed_m_s", &FlightPlan::climb_speed},
    {"descent_speed_m_s", &FlightPlan::descent_speed},
    {"touchdown_speed_m_s", &FlightPlan::touchdown_speed},
    {"land_at_s", &FlightPlan::land_at_s},
};

constexpr OptionField<Waypoint> kWaypointFields[] = {
    {"yaw_deg", &Waypoint::yaw, toRadians(1.0)},
    {"hold_s", &Waypoint::hold_s},
    {"speed_m_s", &Waypoint::speed},
};

Waypoint readWaypoint(TomlTable& table) {
  Waypoint waypoint;
  readOptions(table, kWaypointFields, waypoint);
  const Eigen::VectorXd origin = Eigen::VectorXd::Zero(3);
  waypoint.position_above_pad =
      table.required("position_above_pad_m", table.numbers("position_above_pad_m", 3), origin,
                     "position_above_pad_m = [0.0, 0.0, 0.6]");
  table.finish();
  return waypoint;
}

/// Adds the waypoints one by one, so that what is wrong with one is found at its table.
void readWaypoints(std::vector<TomlTable> tables, FlightPlan& plan) {
  plan.waypoints.clear();
  for (TomlTable& table : tables) {
    plan.waypoints.push_back(readWaypoint(table));
    table.locate([&] { validate(plan); });
  }
}

}  // namespace

FlightPlan parsePlan(std::string_view toml, const std::string& name) {
  TomlTable root = TomlTable::parse(toml, name);
  FlightPlan plan;
  plan.name = root.text("name").value_or(std::filesystem::path(name).stem().string());
  plan.land_at_s = 0.0;
  const int version =
      root.required("format_version", root.integer("format_version"), 1, "format_version = 1");
  readOptions(root, kPlanFields, plan);
  std::vector<TomlTable> waypoints = root.tables("waypoint");
  root.finish();
  if (version != 1)
    root.fail("format_version", "a plan of another format than 1", "use a plan of format_version 1");
  root.locate([&] { validate(plan); });
  readWaypoints(std::move(waypoints), plan);
  root.locate([&] { validate(plan); });
  return plan;
}

FlightPlan loadPlan(const std::filesystem::path& file) {
  return parsePlan(readTextFile(file, "flight plan"), file.string());
}

}  // namespace helical
