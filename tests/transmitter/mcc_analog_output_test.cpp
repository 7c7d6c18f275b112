// The analogue outputs behind an unmodified libusb. No time is measured: `now` is the tests' own.

#include "engine/transmitter/mcc_analog_output.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "engine/base/random.h"
#include "tests/transmitter/emulated_bus.h"
#include "tests/transmitter/emulated_mcc.h"

namespace helical {
namespace {

constexpr TimeNs kTick = 10 * kNanosecondsPerMillisecond;
constexpr TimeNs kSecond = kNanosecondsPerSecond;
constexpr StickDemand kFlying{0.5, 0.55, 0.2, -0.3};
constexpr double kStep = 10.0 / 65536.0;  // V, of 0 .. 10 V; twice that of +-10 V

UsbWanted wanted(const std::string& serial = "", int timeout_ms = 10'000) {
  UsbWanted one = MccProtocol::wanted(serial);
  one.timeout_ms = timeout_ms;
  return one;
}

/// The voltage that a channel should have, from its three points.
double expectedVolts(const OutputChannel& c, double stick) {
  const double neutral = c.neutral + c.trim;
  return stick < 0.0 ? neutral + stick * (neutral - c.minimum) : neutral + stick * (c.maximum - neutral);
}

void expectSticks(EmulatedMcc& device, const StickDemand& demand) {
  const OutputChannels channels = voltageChannels();
  const double sticks[] = {2.0 * demand.upper_rotor - 1.0, 2.0 * demand.lower_rotor - 1.0, -demand.roll, demand.pitch};
  const std::lock_guard lock(device.mutex);
  for (std::size_t i = 0; i < 4; ++i) {
    const OutputChannel& channel = channels.all[i];
    const double step = device.bipolar(channel.output) ? 2.0 * kStep : kStep;
    EXPECT_NEAR(device.volts(channel.output), expectedVolts(channel, sticks[i]), step) << toString(channel.axis);
  }
}

class MccTest : public testing::Test {
 protected:
  MccTest() : device_(std::make_shared<EmulatedMcc>()), port_(bus_.plug(5, device_)) {}

  EmulatedBus bus_;
  std::shared_ptr<EmulatedMcc> device_;
  std::unique_ptr<EmulatedPort> port_;
};

TEST_F(MccTest, GivesVoltagesWithinOneStepByTheDevicesOwnCalibration) {
  MccAnalogOutput output(wanted(), voltageChannels());
  EXPECT_FALSE(output.status().present) << "not before it was opened";
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const StickDemand demand{random.uniform(), random.uniform(), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
    output.send(demand, i * kTick);
    ASSERT_TRUE(output.status().present);
    ASSERT_FALSE(output.status().fault);
    expectSticks(*device_, demand);
  }
  const std::lock_guard lock(device_->mutex);
  EXPECT_FALSE(device_->bipolar(0));
  EXPECT_TRUE(device_->bipolar(1)) << "a channel with negative voltages";
  EXPECT_FALSE(device_->was_torn) << "all channels change at one instant";
  EXPECT_EQ(device_->writes, 50 * 4);
}

TEST_F(MccTest, IsTheMasterOfItsClockWhicheverValueMeansThat) {
  device_->master_value = 0;
  MccAnalogOutput output(wanted(), voltageChannels());
  output.send(kFlying, 0);
  expectSticks(*device_, kFlying);
  EXPECT_FALSE(device_->was_torn);
  auto slave = std::make_shared<EmulatedMcc>("5LAVE");
  slave->master_value = 0x7F;
  const auto port = bus_.plug(9, slave);
  MccAnalogOutput one_by_one(wanted("5LAVE"), voltageChannels());
  one_by_one.send(kFlying, 0);
  expectSticks(*slave, kFlying);
}

TEST_F(MccTest, TogglesAHeartbeatWithEveryDemandThatWentOut) {
  MccAnalogOutput output(wanted(), voltageChannels());
  const auto beat = [&](int i) {
    output.beat(i % 2 == 1);
    output.send(kFlying, i * kTick);
    return output.status().fault;
  };
  for (int i = 1; i <= 20; ++i) ASSERT_FALSE(beat(i));
  EXPECT_TRUE(device_->bit_drives);
  EXPECT_EQ(device_->toggles, 20);
  for (int i = 21; i <= 40; ++i) {
    device_->stalls = 1;
    ASSERT_TRUE(beat(i));
  }
  EXPECT_EQ(device_->toggles, 20) << "a hardware watchdog cuts";
  for (int i = 41; i <= 60; ++i) ASSERT_FALSE(beat(i));
  EXPECT_GE(device_->toggles, 39);
}

TEST_F(MccTest, AStallIsAFaultAndOverWithTheNextDemand) {
  MccAnalogOutput output(wanted(), voltageChannels());
  output.send({}, 0);
  device_->stalls = 1;
  output.send(kFlying, kTick);
  EXPECT_TRUE(output.status().fault);
  EXPECT_TRUE(output.status().present);
  EXPECT_EQ(output.status().trouble, TransmitterTrouble::kStalled);
  output.send(kFlying, 2 * kTick);
  EXPECT_FALSE(output.status().fault);
  expectSticks(*device_, kFlying);
}

TEST_F(MccTest, ADeviceThatHangsIsAFaultAfterTheTimeout) {
  MccAnalogOutput output(wanted("", 1000), voltageChannels());
  output.send({}, 0);
  device_->hangs = 1;
  output.send(kFlying, kTick);
  EXPECT_EQ(output.status().trouble, TransmitterTrouble::kTimedOut);
  EXPECT_TRUE(output.status().present);
  EXPECT_TRUE(output.status().fault);
  EXPECT_EQ(port_->inFlight(), 0) << "nothing is left behind";
  output.send(kFlying, 2 * kTick);
  EXPECT_FALSE(output.status().fault);
  expectSticks(*device_, kFlying);
}

TEST_F(MccTest, UnpluggedInFlightItIsGoneAtOnceAndFoundAgain) {
  MccAnalogOutput output(wanted("", 600'000), voltageChannels());
  output.send(kFlying, 0);
  device_->hangs = 1;
  std::thread puller([this] {
    while (port_->inFlight() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    port_->unplug();
  });
  output.send(kFlying, kTick);  // would wait for ten minutes
  puller.join();
  EXPECT_FALSE(output.status().present);
  EXPECT_FALSE(output.status().self_test_passed);
  EXPECT_TRUE(output.status().fault);
  EXPECT_EQ(output.status().trouble, TransmitterTrouble::kAbsent);

  auto again = std::make_shared<EmulatedMcc>();
  const auto port = bus_.plug(6, again);
  output.send({}, 2 * kTick);
  EXPECT_FALSE(output.status().present) << "it looks twice a second";
  output.send({}, kSecond);
  EXPECT_TRUE(output.status().present);
  EXPECT_FALSE(output.status().fault);
  expectSticks(*again, {});
}

TEST_F(MccTest, OfTwoDevicesItWantsToKnowWhichOne) {
  auto other = std::make_shared<EmulatedMcc>("0BADF00D");
  const auto port = bus_.plug(7, other);
  MccAnalogOutput any(wanted(), voltageChannels());
  any.send({}, 0);
  EXPECT_FALSE(any.status().present);
  EXPECT_EQ(any.status().trouble, TransmitterTrouble::kSeveral);
  MccAnalogOutput output(wanted("0BADF00D"), voltageChannels());
  output.send(kFlying, 0);
  expectSticks(*other, kFlying);
  EXPECT_TRUE(device_->reports.empty()) << "the other one is not touched";
  MccAnalogOutput missing(wanted("1234"), voltageChannels());
  missing.send({}, 0);
  EXPECT_EQ(missing.status().trouble, TransmitterTrouble::kAbsent);
}

TEST_F(MccTest, WithoutPermissionItSaysSo) {
  port_->unplug();
  const auto port = bus_.plug(8, device_, EmulatedPort::Access::kDenied);
  for (const char* serial : {"", "01A2B3C4"}) {
    MccAnalogOutput output(wanted(serial), voltageChannels());
    output.send({}, 0);
    EXPECT_FALSE(output.status().present);
    EXPECT_EQ(output.status().trouble, TransmitterTrouble::kNoPermission);
  }
  const auto found = UsbDevice::list(wanted());
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trouble, TransmitterTrouble::kNoPermission);
}

TEST_F(MccTest, ADeviceThatCannotDoWhatTheRigAsksIsNotFlown) {
  auto four = std::make_shared<EmulatedMcc>("F0UR", 0x009A);
  const auto port = bus_.plug(7, four);
  OutputChannels channels = voltageChannels();
  channels.all[3].output = 5;
  MccAnalogOutput output(wanted("F0UR"), channels);
  output.send(kFlying, 0);
  EXPECT_EQ(output.status().trouble, TransmitterTrouble::kUnfit);
  EXPECT_FALSE(output.status().present);

  device_->calibrated = false;
  MccAnalogOutput uncalibrated(wanted("01A2B3C4"), voltageChannels());
  uncalibrated.send(kFlying, 0);
  EXPECT_EQ(uncalibrated.status().trouble, TransmitterTrouble::kSelfTestFailed);
  EXPECT_FALSE(uncalibrated.status().self_test_passed);
  EXPECT_EQ(device_->writes, 0);
}

TEST_F(MccTest, WithoutChannelsNothingButTheHeartbeatLeaves) {
  MccAnalogOutput output(wanted(), OutputChannels{});
  output.send(kFlying, 0);
  output.send(kFlying, kTick);
  EXPECT_FALSE(output.status().fault);
  EXPECT_EQ(device_->writes, 0);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(device_->volts(i), 0.0);
}

TEST_F(MccTest, TheTrainerSwitchSaysWhoFlies) {
  MccAnalogOutput output(wanted(), voltageChannels(), 3);
  for (int i = 0; i < 6; ++i) {
    device_->trainer = i / 2 % 2 == 1;
    output.send(kFlying, i * kTick);
    EXPECT_FALSE(output.status().fault);
    EXPECT_EQ(output.status().pilot_flies, device_->trainer);
  }
  MccAnalogOutput without(wanted(), voltageChannels());
  device_->trainer = true;
  without.send(kFlying, 0);
  EXPECT_FALSE(without.status().pilot_flies);
}

TEST_F(MccTest, FindsWhatIsPluggedIn) {
  auto other = std::make_shared<EmulatedMcc>("0BADF00D", 0x009D);
  const auto port = bus_.plug(7, other);
  const auto found = UsbDevice::list(wanted());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].serial + found[1].serial, "01A2B3C40BADF00D");
  EXPECT_EQ(found[1].product, 0x009D);
  EXPECT_EQ(found[0].name, "USB-3103");
}

TEST(Mcc, WithoutAnOutEndpointItTakesReportsAsRequests) {
  EmulatedBus bus;
  auto device = std::make_shared<EmulatedMcc>("01A2B3C4", 0x009C, false);
  const auto port = bus.plug(5, device);
  MccAnalogOutput output(wanted(), voltageChannels());
  output.send(kFlying, 0);
  EXPECT_FALSE(output.status().fault);
  expectSticks(*device, kFlying);
}

TEST(Mcc, ThatIsNotThereIsLookedForTwiceASecond) {
  EmulatedBus bus;
  MccAnalogOutput output(wanted(), voltageChannels());
  output.send({}, kSecond);
  EXPECT_EQ(output.status().trouble, TransmitterTrouble::kAbsent);
  EXPECT_TRUE(output.status().fault);
  auto device = std::make_shared<EmulatedMcc>();
  const auto port = bus.plug(5, device);
  output.send({}, kSecond + 49 * kTick);
  EXPECT_FALSE(output.status().present);
  output.send({}, kSecond + 50 * kTick);
  EXPECT_TRUE(output.status().present);
}

}  // namespace
}  // namespace helical
