#include "engine/tracking/tracker_options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "engine/base/error.h"

namespace helical {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string complaintAbout(const TrackerOptions& options) {
  try {
    validate(options);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_FALSE(error.cure().empty());
    return error.problem();
  }
  return "none";
}

TEST(TrackerOptions, DefaultsAreValid) {
  EXPECT_NO_THROW(validate(TrackerOptions{}));
}

TEST(TrackerOptions, NamesEveryKeyOutOfItsRange) {
  using O = TrackerOptions;
  struct Key {
    const char* name;
    double O::*member;
  };
  const Key keys[] = {{"acceleration_noise_lateral", &O::acceleration_noise_lateral},
                      {"acceleration_noise_vertical", &O::acceleration_noise_vertical},
                      {"spin_noise_tilt", &O::spin_noise_tilt},
                      {"spin_noise_yaw", &O::spin_noise_yaw},
                      {"spin_decay_s", &O::spin_decay_s},
                      {"gate_chi2", &O::gate_chi2},
                      {"reacquire_after_s", &O::reacquire_after_s}};
  for (const auto& key : keys)
    for (const double bad : {0.0, -1.0, kNan, kInfinity}) {
      O options;
      options.*key.member = bad;
      EXPECT_THAT(complaintAbout(options), HasSubstr(std::string(key.name) + " is "));
    }
  for (const double bad : {-0.1, 101.0, kNan}) {
    O options;
    options.centroid_bias_px = bad;
    EXPECT_THAT(complaintAbout(options), HasSubstr("centroid_bias_px is "));
  }
}

}  // namespace
}  // namespace helical
