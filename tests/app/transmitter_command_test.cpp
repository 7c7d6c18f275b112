// `helical transmitter calibrate` and `... test` with an emulated analogue output and an operator who types: what is found
// is in the rig file, what was on the outputs on the way, and nothing arms before somebody has looked.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>

#include "engine/config/rig_file.h"
#include "tests/transmitter/emulated_bus.h"
#include "tests/transmitter/emulated_mcc.h"

namespace helical {
namespace {

const char* const kRig = R"(format_version = 1
[[camera]]
id = 1
size = [640, 480]
[camera.intrinsics]
fx = 567.6
fy = 567.6
cx = 319.5
cy = 239.5

[transmitter]  # ours
kind = "mcc-usb-3100"
rate_hz = 200

[safety]
fence_radius_m = 1.25
)";

class TransmitterCommand : public testing::Test {
 protected:
  TransmitterCommand()
      : folder_(std::filesystem::temp_directory_path() / ("helical_transmitter_" + std::to_string(getpid()))),
        device_(std::make_shared<EmulatedMcc>()),
        port_(bus_.plug(5, device_)) {
    std::filesystem::create_directories(folder_);
    std::ofstream(rig()) << kRig;
  }
  ~TransmitterCommand() override { std::filesystem::remove_all(folder_); }

  std::string rig() const { return (folder_ / "rig.toml").string(); }
  std::string text() const {
    std::ifstream stream(rig());
    std::ostringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  /// Its exit code.
  int run(const std::string& what, const std::string& typed) const {
    const std::string input = (folder_ / "typed").string();
    std::ofstream(input) << typed;
    const std::string command =
        std::string(HELICAL_PROGRAM) + " transmitter " + what + " --rig " + rig() + " <" + input + " 2>" + said();
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string said() const { return (folder_ / "said").string(); }

  EmulatedBus bus_;
  std::filesystem::path folder_;
  std::shared_ptr<EmulatedMcc> device_;
  std::unique_ptr<EmulatedPort> port_;
};

// Throttle on output 2 from 0.3 over 2 to 4.6 V; yaw on 1; roll on 0, reversed; pitch on 3, 20 V/s.
const char* const kTyped = "y\n2\n\n0.1\n0.3\n\n2\n\n4.6\n\n\n"
                           "1\n\n\n\n\n\n"
                           "0\n\n4.4\n\n2.6\n\n0.7\n\n\n"
                           "\n\n\n\n20\n\n";

TEST_F(TransmitterCommand, CalibratesLooksAndWritesTheRigFile) {
  ASSERT_EQ(run("calibrate", kTyped), 0);
  const TransmitterOptions measured = loadRig(rig()).transmitter;
  ASSERT_EQ(measured.channels.count, 4);
  const auto& all = measured.channels.all;
  EXPECT_EQ(all[0].axis, StickAxis::kThrottle);
  EXPECT_EQ(all[0].output, 2);
  EXPECT_EQ(all[0].minimum, 0.3);
  EXPECT_EQ(all[0].neutral, 2.0);
  EXPECT_EQ(all[0].maximum, 4.6);
  EXPECT_EQ(all[1].output, 1);
  EXPECT_EQ(all[2].axis, StickAxis::kRoll);
  EXPECT_EQ(all[2].output, 0);
  EXPECT_EQ(all[2].minimum, 0.7);
  EXPECT_EQ(all[2].neutral, 2.6);
  EXPECT_EQ(all[2].maximum, 4.4);
  EXPECT_TRUE(all[2].reverse) << "its left end has the higher voltage";
  EXPECT_EQ(all[3].output, 3) << "the one in brackets";
  EXPECT_EQ(all[3].slew_per_s, 20.0);
  EXPECT_FALSE(directionsChecked(measured)) << "it does not arm yet";
  EXPECT_NE(text().find("[transmitter]  # ours\n"), std::string::npos) << "the rest is as it was";
  EXPECT_NE(text().find("fence_radius_m = 1.25"), std::string::npos);
  // Voltages went out while they were typed.
  EXPECT_GT(device_->writes, 12);

  ASSERT_EQ(run("test", "y\ny\ny\ny\ny\n"), 0);
  EXPECT_TRUE(directionsChecked(loadRig(rig()).transmitter));
  ASSERT_EQ(run("calibrate", kTyped), 0);
  const TransmitterOptions again = loadRig(rig()).transmitter;
  EXPECT_EQ(again.channels.count, 4) << "in place of the old ones";
  EXPECT_FALSE(directionsChecked(again)) << "who calibrates anew looks anew";
}

TEST_F(TransmitterCommand, AStickThatGoesTheWrongWayIsTurnedRound) {
  ASSERT_EQ(run("calibrate", kTyped), 0);
  ASSERT_EQ(run("test", "y\ny\ny\nn\ny\ny\ny\n"), 0);
  const TransmitterOptions turned = loadRig(rig()).transmitter;
  EXPECT_FALSE(turned.channels.all[2].reverse);
  EXPECT_TRUE(directionsChecked(turned));
}

TEST_F(TransmitterCommand, GivingUpChangesNothing) {
  EXPECT_EQ(run("calibrate", "y\n2\n\n"), 1);
  EXPECT_EQ(text(), kRig);
  ASSERT_EQ(run("calibrate", kTyped), 0);
  const std::string before = text();
  for (const char* typed : {"n\n", "y\ny\n", "y\nn\n", "y\ny\ny\nn\nn\n"}) {
    EXPECT_EQ(run("test", typed), 1) << typed;
    EXPECT_EQ(text(), before);
  }
}

TEST_F(TransmitterCommand, WithoutADeviceItIsMissing) {
  port_->unplug();
  EXPECT_EQ(run("calibrate", kTyped), 3);
  EXPECT_EQ(text(), kRig);
}

/// Who watches is told before the first flight whether anybody would know that the pilot has taken over.
TEST_F(TransmitterCommand, TheDoctorKnowsWhetherThereIsATrainerSwitch) {
  const auto says = [this](const std::string& text) {
    std::ofstream(rig()) << text;
    const std::string file = (folder_ / "doctor").string();
    const std::string command = std::string(HELICAL_PROGRAM) + " doctor --rig " + rig() + " >" + file + " 2>" + said();
    std::ignore = std::system(command.c_str());
    std::ifstream stream(file);
    std::ostringstream all;
    all << stream.rdbuf();
    return all.str();
  };
  const std::string mcc = kRig;
  EXPECT_NE(says(mcc).find("the rig names no input"), std::string::npos);
  std::string wired = mcc;
  wired.replace(wired.find("rate_hz = 200"), 13, "trainer_input = 3");
  EXPECT_NE(says(wired).find("at digital input 3"), std::string::npos);
  std::string radio = mcc;
  radio.replace(radio.find("mcc-usb-3100"), 12, "crazyradio");
  EXPECT_NE(says(radio).find("has no input for one"), std::string::npos);
}

TEST_F(TransmitterCommand, ARigWithoutSuchATransmitterIsABadInput) {
  std::ofstream(rig()) << std::string(kRig).replace(std::string(kRig).find("mcc-usb-3100"), 12, "none");
  EXPECT_EQ(run("calibrate", kTyped), 2);
  std::ofstream(rig()) << kRig;
  EXPECT_EQ(run("test", "y\n"), 2) << "no channels to look at";
}

}  // namespace
}  // namespace helical
