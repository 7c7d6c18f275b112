#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "engine/base/error.h"
#include "engine/flight/controller_options.h"
#include "engine/flight/flight_plan.h"
#include "engine/flight/supervisor_options.h"

namespace helical {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Options>
std::string complaintAbout(const Options& options) {
  try {
    validate(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_FALSE(error.cure().empty());
    return error.problem();
  }
  return "none";
}

template <class Options>
struct Key {
  const char* name;
  double Options::*member;
};

TEST(ControllerOptions, DefaultsAreValid) {
  EXPECT_NO_THROW(validate(ControllerOptions{}));
}

TEST(ControllerOptions, NamesEveryKeyOutOfItsRange) {
  using O = ControllerOptions;
  const Key<O> gains[] = {{"position_p", &O::position_p},
                          {"position_d", &O::position_d},
                          {"position_i", &O::position_i},
                          {"position_i_limit", &O::position_i_limit},
                          {"position_error_limit", &O::position_error_limit},
                          {"tilt", &O::tilt},
                          {"height_p", &O::height_p},
                          {"height_d", &O::height_d},
                          {"height_i", &O::height_i},
                          {"yaw_p", &O::yaw_p},
                          {"yaw_rate_limit", &O::yaw_rate_limit},
                          {"yaw_d", &O::yaw_d},
                          {"yaw_i", &O::yaw_i},
                          {"ground_yaw_d", &O::ground_yaw_d},
                          {"ground_yaw_i", &O::ground_yaw_i},
                          {"output_delay_s", &O::output_delay_s}};
  for (const auto& key : gains)
    for (const double bad : {-0.001, kNan, kInfinity}) {
      O options;
      options.*key.member = bad;
      EXPECT_THAT(complaintAbout(options), HasSubstr(std::string(key.name) + " is "));
    }
  for (const double bad : {19.9, 501.0, -60.0, kNan}) {
    O options;
    options.rate_hz = bad;
    EXPECT_THAT(complaintAbout(options), HasSubstr("rate_hz"));
  }
  for (const double bad : {1.6, -1.6, kNan}) {
    O options;
    options.phase = bad;
    EXPECT_THAT(complaintAbout(options), HasSubstr("phase"));
  }
  O late;
  late.output_delay_s = 0.21;
  EXPECT_THAT(complaintAbout(late), HasSubstr("output_delay_s"));
}

TEST(SupervisorOptions, DefaultsAreValid) {
  EXPECT_NO_THROW(validate(SupervisorOptions{}));
}

TEST(SupervisorOptions, NamesEveryKeyOutOfItsRange) {
  using O = SupervisorOptions;
  const Key<O> limits[] = {{"coast_after_s", &O::coast_after_s},
                           {"neutral_after_s", &O::neutral_after_s},
                           {"speed_limit", &O::speed_limit},
                           {"fence_half_x", &O::fence_half_x},
                           {"fence_half_y", &O::fence_half_y},
                           {"fence_warning_margin", &O::fence_warning_margin},
                           {"residual_limit", &O::residual_limit},
                           {"position_sigma_limit", &O::position_sigma_limit},
                           {"arm_cameras", &O::arm_cameras},
                           {"arm_rate_share", &O::arm_rate_share},
                           {"disarm_idle_s", &O::disarm_idle_s},
                           {"descend_after_s", &O::descend_after_s},
                           {"descent_speed", &O::descent_speed},
                           {"longest_descent_s", &O::longest_descent_s},
                           {"tilt_limit", &O::tilt_limit},
                           {"tilt_time_s", &O::tilt_time_s},
                           {"fence_radius", &O::fence_radius},
                           {"fence_height", &O::fence_height},
                           {"hard_fence_margin", &O::hard_fence_margin},
                           {"flight_time_limit_s", &O::flight_time_limit_s},
                           {"transmitter_fault_s", &O::transmitter_fault_s},
                           {"transmitter_cut_s", &O::transmitter_cut_s}};
  for (const auto& key : limits)
    for (const double bad : {0.0, -1.0, kNan, kInfinity}) {
      O options;
      options.*key.member = bad;
      EXPECT_THAT(complaintAbout(options), HasSubstr(std::string(key.name) + " is "));
    }
}

TEST(SupervisorOptions, DescentFollowsNeutralSticksAndThoseTheCoast) {
  SupervisorOptions options;
  options.descend_after_s = options.neutral_after_s;
  EXPECT_THAT(complaintAbout(options), HasSubstr("descend_after_s"));
  options = {};
  options.neutral_after_s = options.coast_after_s;
  EXPECT_THAT(complaintAbout(options), HasSubstr("neutral_after_s"));
}

TEST(SupervisorOptions, ATransmitterThatDoesNotAnswerIsLandedOnBeforeItIsCut) {
  SupervisorOptions options;
  options.transmitter_cut_s = options.transmitter_fault_s;
  EXPECT_THAT(complaintAbout(options), HasSubstr("transmitter_cut_s is not longer"));
}

TEST(SupervisorOptions, TheFenceLeavesRoomToBePushedBackTo) {
  SupervisorOptions options;
  options.fence_radius = options.fence_warning_margin;
  EXPECT_THAT(complaintAbout(options), HasSubstr("fence_warning_margin"));
  options.fence = FenceShape::kBox;
  EXPECT_EQ(complaintAbout(options), "none");
  options.arm_rate_share = 1.1;
  EXPECT_THAT(complaintAbout(options), HasSubstr("arm_rate_share"));
}

TEST(FlightPlan, DefaultIsValid) {
  EXPECT_NO_THROW(validate(FlightPlan{}));
}

TEST(FlightPlan, NamesEveryValueOutOfItsRange) {
  struct Case {
    const char* name;
    std::function<void(FlightPlan&, double)> set;
    std::vector<double> bad;
  };
  const Case cases[] = {
      {"start_delay_s", [](auto& p, double v) { p.start_delay_s = v; }, {-0.1, 601.0, kNan}},
      {"climb_speed", [](auto& p, double v) { p.climb_speed = v; }, {0.0, 1.1, kNan}},
      {"descent_speed", [](auto& p, double v) { p.descent_speed = v; }, {0.0, 0.6, kNan}},
      {"touchdown_speed", [](auto& p, double v) { p.touchdown_speed = v; }, {0.0, 0.19, kNan}},
      {"land_at_s", [](auto& p, double v) { p.land_at_s = v; }, {kNan, kInfinity}},
      {"waypoint 1: height",
       [](auto& p, double v) { p.waypoints[0].position_above_pad.z() = v; },
       {0.09, kNan}},
      {"waypoint 1: position",
       [](auto& p, double v) { p.waypoints[0].position_above_pad.y() = v; },
       {kNan, kInfinity}},
      {"waypoint 1: yaw", [](auto& p, double v) { p.waypoints[0].yaw = v; }, {6.4, -6.4, kNan}},
      {"waypoint 1: hold_s", [](auto& p, double v) { p.waypoints[0].hold_s = v; }, {-0.1, kNan, kInfinity}},
      {"waypoint 1: speed", [](auto& p, double v) { p.waypoints[0].speed = v; }, {0.0, 1.1, kNan}}};
  for (const auto& c : cases)
    for (const double bad : c.bad) {
      FlightPlan plan;
      c.set(plan, bad);
      EXPECT_THAT(complaintAbout(plan), HasSubstr(std::string(c.name) + " is "));
    }
}

TEST(FlightPlan, NamesTheWaypointThatIsWrong) {
  FlightPlan plan;
  plan.waypoints.resize(3, plan.waypoints.front());
  plan.waypoints[2].speed = 7.0;
  EXPECT_THAT(complaintAbout(plan), HasSubstr("waypoint 3: speed"));
}

TEST(FlightPlan, NeedsAWaypoint) {
  FlightPlan plan;
  plan.waypoints.clear();
  EXPECT_THAT(complaintAbout(plan), HasSubstr("waypoint"));
}

}  // namespace
}  // namespace helical
