#include "engine/transmitter/output_channel.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/random.h"

namespace helical {
namespace {

constexpr TimeNs kMs = kNanosecondsPerMillisecond;
constexpr ChannelLimits kVolts{-10.0, 10.0, 10.0, true};

OutputChannels channels() {
  OutputChannels all;
  all.count = 4;
  all.all[0] = {StickAxis::kThrottle, 0, 0.5, 2.0, 4.5, 0.0, false, 0.0};
  all.all[1] = {StickAxis::kYaw, 1, 1.0, 2.5, 4.5, 0.0, false, 0.0};
  all.all[2] = {StickAxis::kRoll, 2, 1.0, 2.5, 4.5, 0.25, true, 0.0};
  all.all[3] = {StickAxis::kPitch, 3, 1.0, 2.5, 4.5, 0.0, false, 0.0};
  return all;
}

TEST(OutputChannel, GoesThroughItsThreePointsWithTrimAndReverse) {
  ChannelMapper mapper(channels());
  auto values = mapper.step({}, 0);
  EXPECT_DOUBLE_EQ(values[0], 0.5) << "rest";
  EXPECT_DOUBLE_EQ(values[1], 2.5);
  EXPECT_DOUBLE_EQ(values[2], 2.75) << "trim moves neutral";
  values = mapper.step({1.0, 1.0, 1.0, 1.0}, kMs);
  EXPECT_DOUBLE_EQ(values[0], 4.5);
  EXPECT_DOUBLE_EQ(values[1], 2.5);
  EXPECT_DOUBLE_EQ(values[2], 1.0) << "reversed";
  EXPECT_DOUBLE_EQ(values[3], 4.5);
  values = mapper.step({0.3, 0.7, -1.0, -0.5}, 2 * kMs);
  EXPECT_DOUBLE_EQ(values[0], 2.0) << "half throttle is neutral";
  EXPECT_DOUBLE_EQ(values[1], 2.5 + 0.4 * 2.0) << "more lower rotor turns to the left";
  EXPECT_DOUBLE_EQ(values[2], 4.5);
  EXPECT_DOUBLE_EQ(values[3], 2.5 - 0.5 * 1.5);
}

TEST(OutputChannel, StaysWithinItsEndsWhateverIsAsked) {
  ChannelMapper mapper(channels());
  Random random(4);
  TimeNs now = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto stick = [&] { return random.uniform(-5.0, 5.0); };
    const auto values = mapper.step({stick(), stick(), stick(), stick()}, now += kMs);
    for (std::size_t c = 0; c < values.size(); ++c) {
      ASSERT_GE(values[c], channels().all[c].minimum);
      ASSERT_LE(values[c], channels().all[c].maximum);
    }
  }
}

TEST(OutputChannel, SlewLimitsAllButAThrottleThatGoesDown) {
  OutputChannels all = channels();
  for (auto& channel : all.all) channel.slew_per_s = 10.0;
  ChannelMapper mapper(all);
  mapper.step({}, 0);
  auto values = mapper.step({1.0, 1.0, -1.0, 1.0}, 50 * kMs);
  EXPECT_DOUBLE_EQ(values[0], 1.0);
  EXPECT_DOUBLE_EQ(values[2], 3.25);
  EXPECT_DOUBLE_EQ(values[3], 3.0);
  values = mapper.step({1.0, 1.0, -1.0, 1.0}, 1000 * kMs);
  EXPECT_DOUBLE_EQ(values[0], 4.5);
  values = mapper.step({}, 1001 * kMs);
  EXPECT_DOUBLE_EQ(values[0], 0.5) << "a cut is a cut";
  EXPECT_NEAR(values[3], 4.49, 1e-9);
}

TEST(OutputChannel, RefusesWhatCannotBeFlown) {
  EXPECT_NO_THROW(validate(channels(), kVolts));
  EXPECT_NO_THROW(validate(OutputChannels{}, kVolts)) << "nobody has measured them yet";
  const std::function<void(OutputChannels&)> mistakes[] = {
      [](auto& c) { c.all[0].reverse = true; },
      [](auto& c) { c.all[0].minimum = -0.1; },
      [](auto& c) { c.all[1].maximum = 10.5; },
      [](auto& c) { c.all[1].maximum = 2.0; },
      [](auto& c) { c.all[1].trim = 2.5; },
      [](auto& c) { c.all[2].slew_per_s = -1.0; },
      [](auto& c) { c.all[2].neutral = std::numeric_limits<double>::quiet_NaN(); },
      [](auto& c) { c.all[3].output = 2; },
      [](auto& c) { c.all[3].output = 16; },
      [](auto& c) { c.all[3].axis = StickAxis::kRoll; },
      [](auto& c) { c.all[1].axis = StickAxis::kLowerRotor; },
      [](auto& c) { c.count = 3; },
  };
  for (const auto& mistake : mistakes) {
    OutputChannels wrong = channels();
    mistake(wrong);
    EXPECT_THROW(validate(wrong, kVolts), Error) << "mistake " << &mistake - mistakes;
  }
  OutputChannels rotors = channels();
  rotors.all[0].axis = StickAxis::kUpperRotor;
  rotors.all[1] = {StickAxis::kLowerRotor, 1, 0.5, 2.0, 4.5, 0.0, false, 0.0};
  EXPECT_NO_THROW(validate(rotors, kVolts));
  EXPECT_THROW(validate(rotors, ChannelLimits{-10.0, 10.0, 10.0, false}), Error);
}

TEST(OutputChannel, AFingerprintKnowsWhatADirectionDependsOn) {
  const std::uint64_t before = fingerprintOf(channels());
  OutputChannels other = channels();
  other.all[2].reverse = false;
  EXPECT_NE(fingerprintOf(other), before);
  other = channels();
  other.all[3].output = 7;
  EXPECT_NE(fingerprintOf(other), before);
  other = channels();
  other.all[3].maximum = 4.4;
  EXPECT_NE(fingerprintOf(other), before);
  other = channels();
  other.all[3].trim = 0.01;
  EXPECT_EQ(fingerprintOf(other), before) << "trimming in the field asks for no new look";
}

}  // namespace
}  // namespace helical
