#include "engine/config/plan_file.h"

#include <gtest/gtest.h>

#include "engine/config/resource_files.h"
#include "engine/geometry/rotation.h"
#include "tests/config/rig_text.h"

namespace helical {
namespace {

const std::string kPlan = R"(format_version = 1
climb_speed_m_s = 0.3

[[waypoint]]
position_above_pad_m = [0, 0, 0.6]

[[waypoint]]
position_above_pad_m = [0.3, -0.1, 0.7]
yaw_deg = 30
hold_s = 2.0
speed_m_s = 0.2
)";

TEST(PlanFile, ReadsWhatTheFileSays) {
  const FlightPlan plan = parsePlan(kPlan, "folder/round.toml");
  EXPECT_EQ(plan.name, "round");
  EXPECT_EQ(plan.climb_speed, 0.3);
  EXPECT_EQ(plan.descent_speed, FlightPlan().descent_speed);
  EXPECT_EQ(plan.land_at_s, 0.0) << "lands after the last waypoint";
  ASSERT_EQ(plan.waypoints.size(), 2u);
  EXPECT_EQ(plan.waypoints[1].position_above_pad, Eigen::Vector3d(0.3, -0.1, 0.7));
  EXPECT_DOUBLE_EQ(plan.waypoints[1].yaw, toRadians(30.0));
  EXPECT_EQ(plan.waypoints[1].hold_s, 2.0);
  EXPECT_EQ(plan.waypoints[1].speed, 0.2);
}

TEST(PlanFile, MistakesAreFoundAtTheirLine) {
  const struct {
    const char *from, *to, *culprit, *said;
  } mistakes[] = {
      {"climb_speed_m_s", "climb_sped_m_s", "climb_sped_m_s", "did you mean 'climb_speed_m_s'?"},
      {"climb_speed_m_s = 0.3", "climb_speed_m_s = -1", "climb_speed_m_s", "climb_speed is -1"},
      {"format_version = 1", "format_version = 7", "format_version", "another format"},
      {"yaw_deg = 30", "yaw = 30", "yaw = 30", "unknown key 'yaw' in [waypoint]"},
      {"speed_m_s = 0.2", "speed_m_s = 0", "\nspeed_m_s = 0", "speed is 0"},
      {"hold_s = 2.0", "hold_s = -2.0", "hold_s", "hold_s is -2"},
      {"[0.3, -0.1, 0.7]", "[0.3, -0.1]", "[0.3, -0.1]", "2 entries, not 3"},
      {"position_above_pad_m = [0, 0, 0.6]", "", "[[waypoint]]", "'position_above_pad_m' is missing"},
  };
  for (const auto& mistake : mistakes) {
    const std::string text = replaced(kPlan, mistake.from, mistake.to);
    const Error error = errorOf([&] { parsePlan(text, "bad.toml"); });
    const int skipped = mistake.culprit[0] == '\n' ? 1 : 0;
    EXPECT_EQ(error.where(), "bad.toml:" + std::to_string(lineOf(text, mistake.culprit) + skipped))
        << error.what();
    EXPECT_NE(std::string(error.what()).find(mistake.said), std::string::npos) << error.what();
    EXPECT_FALSE(error.cure().empty());
  }
}

TEST(PlanFile, NeedsAWaypoint) {
  const Error error = errorOf([] { parsePlan("format_version = 1\n", "bad.toml"); });
  EXPECT_EQ(error.where(), "bad.toml:1");
  EXPECT_FALSE(error.cure().empty());
}

TEST(PlanFile, ShippedPlansLoad) {
  const FlightPlan hover = loadPlan(planPath("hover"));
  EXPECT_EQ(hover.name, "hover");
  EXPECT_EQ(hover.land_at_s, 19.0);
  ASSERT_EQ(hover.waypoints.size(), 1u);
  EXPECT_EQ(hover.waypoints[0].position_above_pad, Eigen::Vector3d(0, 0, 0.6));
  const FlightPlan waypoints = loadPlan(planPath("waypoints"));
  EXPECT_EQ(waypoints.waypoints.front().position_above_pad, Eigen::Vector3d(0, 0, 0.6));
  EXPECT_EQ(waypoints.waypoints.back().position_above_pad.head<2>(), Eigen::Vector2d(0, 0))
      << "it lands on the pad";
}

}  // namespace
}  // namespace helical
