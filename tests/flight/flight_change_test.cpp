#include "engine/flight/flight_change.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "engine/base/error.h"

namespace helical {
namespace {

std::string complaintAbout(const FlightChange& change) {
  try {
    validate(change);
  } catch (const Error& error) {
    EXPECT_FALSE(error.cure().empty());
    return error.problem();
  }
  return "none";
}

TEST(FlightChange, NothingAndDefaultsAreValid) {
  EXPECT_EQ(complaintAbout({}), "none");
  EXPECT_EQ(complaintAbout({FlightPlan{}, ControllerOptions{}}), "none");
}

TEST(FlightChange, GainsAndTrimsKeepToTheirSafeRanges) {
  for (const ControllerKey& key : controllerKeys()) {
    for (const double good : {key.lowest, key.highest}) {
      ControllerOptions control;
      control.*key.value = good;
      EXPECT_EQ(complaintAbout({{}, control}), "none") << key.name;
    }
    for (const double bad :
         {key.lowest - 0.01, key.highest + 0.01, std::numeric_limits<double>::quiet_NaN()}) {
      ControllerOptions control;
      control.*key.value = bad;
      EXPECT_THAT(complaintAbout({{}, control}), testing::HasSubstr(std::string(key.name) + " is ")) << bad;
    }
  }
}

TEST(FlightChange, ABadPlanIsNamed) {
  FlightPlan plan;
  plan.climb_speed = 7.0;
  EXPECT_THAT(complaintAbout({plan, ControllerOptions{}}), testing::HasSubstr("climb_speed"));
}

}  // namespace
}  // namespace helical
