#include "engine/simulator/simulation_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "engine/base/error.h"

namespace helical {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::string complaintAbout(const SimulationOptions& options) {
  try {
    validate(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_FALSE(error.cure().empty());
    return error.problem();
  }
  return "none";
}

TEST(SimulationOptions, DefaultsAreValid) {
  EXPECT_NO_THROW(validate(SimulationOptions{}));
}

TEST(SimulationOptions, NamesEveryKeyOutOfItsRange) {
  using O = SimulationOptions;
  struct Case {
    const char* name;
    std::function<double&(O&)> value;
    double too_low, too_high;
  };
  const Case cases[] = {
      {"gust_factor", [](O& o) -> double& { return o.gust_factor; }, -0.1, 11.0},
      {"vary", [](O& o) -> double& { return o.vary; }, -0.1, 0.95},
      {"camera_rate_hz", [](O& o) -> double& { return o.camera_rate_hz; }, 4.0, 501.0},
      {"rate_error", [](O& o) -> double& { return o.rate_error; }, -1e-4, 0.02},
      {"readout_delay_s", [](O& o) -> double& { return o.readout_delay_s; }, -0.01, 0.3},
      {"field_empty_s", [](O& o) -> double& { return o.field_empty_s; }, -1.0, 61.0},
      {"image_noise", [](O& o) -> double& { return o.image_noise; }, -1.0, 51.0},
      {"light_drift", [](O& o) -> double& { return o.light_drift; }, -0.1, 0.6},
      {"noise.sigma_px", [](O& o) -> double& { return o.noise.sigma_px; }, -0.1, 21.0},
      {"noise.bias_px", [](O& o) -> double& { return o.noise.bias_px; }, -0.1, 21.0},
      {"noise.bias_time_s", [](O& o) -> double& { return o.noise.bias_time_s; }, 0.0, 1001.0},
      {"noise.dropout", [](O& o) -> double& { return o.noise.dropout; }, -0.1, 1.1},
      {"noise.false_markers", [](O& o) -> double& { return o.noise.false_markers; }, -0.1, 1.1},
      {"noise.outliers", [](O& o) -> double& { return o.noise.outliers; }, -0.1, 1.1}};
  for (const auto& c : cases)
    for (const double bad : {c.too_low, c.too_high, kNan}) {
      O options;
      c.value(options) = bad;
      EXPECT_THAT(complaintAbout(options), HasSubstr(std::string(c.name) + " is "));
    }
}

TEST(SimulationOptions, OcclusionsEndAfterTheyBegin) {
  SimulationOptions options;
  options.occlusions = {{cameraId(0), 5.0, 5.0}};
  EXPECT_THAT(complaintAbout(options), HasSubstr("occlusion"));
  options.occlusions = {{cameraId(0), 5.0, kNan}};
  EXPECT_THAT(complaintAbout(options), HasSubstr("occlusion"));
}

TEST(SimulationOptions, KnocksAreOfThisWorld) {
  SimulationOptions options;
  options.bumps = {{cameraId(0), -1.0, 0.1, 0.1}};
  EXPECT_THAT(complaintAbout(options), HasSubstr("bump time"));
  options.bumps = {{cameraId(0), 1.0, 4.0, 0.1}};
  EXPECT_THAT(complaintAbout(options), HasSubstr("bump angle"));
  options.bumps = {{cameraId(0), 1.0, 0.1, -0.1}};
  EXPECT_THAT(complaintAbout(options), HasSubstr("bump distance"));
}

}  // namespace
}  // namespace helical
