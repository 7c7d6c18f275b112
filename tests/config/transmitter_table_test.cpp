#include "engine/config/transmitter_table.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "engine/config/rig_file.h"
#include "engine/transmitter/shared_output.h"
#include "tests/config/rig_text.h"

namespace helical {
namespace {

const std::string kChannels = R"(
[[transmitter.channel]]
stick = "throttle"
minimum = 0.4
neutral = 2.0
maximum = 4.5
[[transmitter.channel]]
stick = "yaw"
output = 3
minimum = 0.5
neutral = 2.5
maximum = 4.5
trim = 0.2
[[transmitter.channel]]
stick = "roll"
minimum = 0.5
neutral = 2.5
maximum = 4.5
reverse = true
[[transmitter.channel]]
stick = "pitch"
output = 1
minimum = 0.5
neutral = 2.5
maximum = 4.5
slew_per_s = 20
)";

std::string rigWith(const std::string& transmitter) {
  return goodRig() + "\n[transmitter]\n" + transmitter;
}

TransmitterOptions read(const std::string& transmitter) {
  return parseRig(rigWith(transmitter), "rig.toml").transmitter;
}

TEST(TransmitterTable, ReadsTheChannelsOfAnAnalogueOutput) {
  const TransmitterOptions options = read("kind = \"mcc-usb-3100\"\ndevice = \"01A2B3C4\"\nbench = true\ntrainer_input = 3\n" + kChannels);
  ASSERT_EQ(options.channels.count, 4);
  const auto& [throttle, yaw, roll, pitch] =
      std::tie(options.channels.all[0], options.channels.all[1], options.channels.all[2], options.channels.all[3]);
  EXPECT_EQ(throttle.axis, StickAxis::kThrottle);
  EXPECT_EQ(throttle.output, 0);
  EXPECT_EQ(throttle.minimum, 0.4);
  EXPECT_EQ(throttle.neutral, 2.0);
  EXPECT_EQ(throttle.maximum, 4.5);
  EXPECT_EQ(yaw.output, 3);
  EXPECT_EQ(yaw.trim, 0.2);
  EXPECT_EQ(roll.output, 2) << "in their order unless it says otherwise";
  EXPECT_TRUE(roll.reverse);
  EXPECT_FALSE(pitch.reverse);
  EXPECT_EQ(pitch.slew_per_s, 20.0);
  EXPECT_TRUE(options.bench);
  const OutputSettings settings = outputSettings(options);
  EXPECT_STREQ(settings.device.data(), "mcc-usb-3100");
  EXPECT_STREQ(settings.address.data(), "01A2B3C4");
  EXPECT_TRUE(settings.bench);
  EXPECT_EQ(settings.trainer_input, 3);
  EXPECT_EQ(outputSettings(read("kind = \"crazyradio\"\n")).trainer_input, -1);
}

TEST(TransmitterTable, ChannelsCountAsCheckedUntilTheyChange) {
  TransmitterOptions options = read("kind = \"mcc-usb-3100\"\n" + kChannels);
  EXPECT_FALSE(directionsChecked(options));
  EXPECT_FALSE(outputSettings(options).directions_checked);
  const std::string checked = "directions_checked = \"" + fingerprintText(options.channels) + "\"\n";
  options = read("kind = \"mcc-usb-3100\"\n" + checked + kChannels);
  EXPECT_TRUE(outputSettings(options).directions_checked);
  options = read("kind = \"mcc-usb-3100\"\n" + checked + replaced(kChannels, "reverse = true", "reverse = false"));
  EXPECT_FALSE(outputSettings(options).directions_checked);
  options = read("kind = \"mcc-usb-3100\"\n");
  options.directions_checked = fingerprintText(options.channels);
  EXPECT_FALSE(directionsChecked(options)) << "no channels are none to look at";
}

TEST(TransmitterTable, ReadsARadio) {
  const TransmitterOptions options = read(
      "kind = \"crazyradio\"\n[transmitter.radio]\nchannel = 7\nrate_kbps = 250\naddress = \"e70102030A\"\npower = 1\n");
  EXPECT_EQ(options.radio.channel, 7);
  EXPECT_EQ(options.radio.rate_kbps, 250);
  EXPECT_EQ(options.radio.power, 1);
  EXPECT_EQ(options.radio.address, (std::array<std::uint8_t, 5>{0xE7, 1, 2, 3, 10}));
}

/// What would never say that the pilot flies must not look as if it could.
TEST(TransmitterTable, ATrainerSwitchNeedsADeviceWithAnInputForIt) {
  for (const char* kind : {"crazyradio", "simulated", "none"}) {
    const std::string text = rigWith("kind = \"" + std::string(kind) + "\"\ntrainer_input = 2\n");
    const Error error = errorOf([&] { parseRig(text, "rig.toml"); });
    EXPECT_NE(error.problem().find("trainer_input"), std::string::npos) << kind << ": " << error.what();
  }
}

struct Mistake {
  std::string from, to, culprit;
};

TEST(TransmitterTable, MistakesHaveTheirLine) {
  const std::string good = "kind = \"mcc-usb-3100\"\n" + kChannels;
  for (const Mistake& mistake : {Mistake{"stick = \"yaw\"", "stick = \"jaw\"", "stick = \"jaw\""},
                                 Mistake{"output = 3", "output = 16", "output = 16"},
                                 Mistake{"output = 3", "outputs = 3", "outputs = 3"},
                                 Mistake{"kind = \"mcc-usb-3100\"", "kind = \"mcc\"", "kind = \"mcc\""},
                                 Mistake{"kind = \"mcc-usb-3100\"", "kind = \"mcc-usb-3100\"\nbench = 1", "bench = 1"}}) {
    const std::string text = rigWith(replaced(good, mistake.from, mistake.to));
    const Error error = errorOf([&] { parseRig(text, "bad.toml"); });
    EXPECT_EQ(error.where(), "bad.toml:" + std::to_string(lineOf(text, mistake.culprit))) << error.what();
    EXPECT_FALSE(error.cure().empty());
  }
}

TEST(TransmitterTable, RefusesChannelsThatCannotBeFlown) {
  const std::string good = "kind = \"mcc-usb-3100\"\n" + kChannels;
  EXPECT_NO_THROW(parseRig(rigWith(good), "good.toml"));
  for (const auto& [from, to] : {std::pair("minimum = 0.4", "minimum = -0.4"), std::pair("neutral = 2.0", "neutral = 5.0"),
                                 std::pair("output = 3", "output = 0"), std::pair("stick = \"yaw\"", "stick = \"roll\""),
                                 std::pair("kind = \"mcc-usb-3100\"", "kind = \"simulated\""),
                                 std::pair("maximum = 4.5\n[[transmitter.channel]]\nstick = \"yaw\"",
                                           "maximum = 4.5\nreverse = true\n[[transmitter.channel]]\nstick = \"yaw\"")})
    EXPECT_EQ(errorOf([&] { parseRig(rigWith(replaced(good, from, to)), "bad.toml"); }).kind(), ErrorKind::kInput) << to;
  for (const char* radio : {"channel = 126", "rate_kbps = 500", "address = \"E7\"", "address = \"E7E7E7E7EG\"", "power = 4"})
    EXPECT_THROW(read("kind = \"crazyradio\"\n[transmitter.radio]\n" + std::string(radio) + "\n"), Error) << radio;
  EXPECT_THROW(read("kind = \"mcc-usb-3100\"\ndevice = \"" + std::string(600, 'x') + "\"\n"), Error);
}

}  // namespace
}  // namespace helical
