// The real program helical-output with emulated devices: what the ground station demands arrives as volts and
// packets, a device that was away comes back at rest, and a ground station that is killed leaves the sticks
// at rest.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <thread>

#include "engine/transmitter/output_process.h"
#include "tests/transmitter/emulated_bus.h"
#include "tests/transmitter/emulated_crazyradio.h"
#include "tests/transmitter/emulated_mcc.h"

namespace helical {
namespace {

constexpr StickDemand kFlying{0.5, 0.55, 0.2, -0.3};
constexpr double kHalfOfUpperRotor = 2.4, kRestOfUpperRotor = 0.3;  // V, see voltageChannels()
constexpr int kUpperOutput = 2;
constexpr double kStep = 10.0 / 65536.0;

int kills() {
  const char* wanted = std::getenv("HELICAL_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 5;
}

/// Generous, for slow and busy machines.
bool eventually(const std::function<bool()>& condition) {
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (std::chrono::steady_clock::now() < give_up) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

OutputSettings settingsOf(const char* device, const OutputChannels& channels) {
  OutputSettings settings;
  std::strncpy(settings.device.data(), device, settings.device.size() - 1);
  settings.channels = channels;
  settings.directions_checked = true;
  return settings;
}

/// A ground station of this process.
class Station {
 public:
  explicit Station(const OutputSettings& settings) : output_(settings, HELICAL_OUTPUT_PROGRAM) {}
  bool sendUntil(const StickDemand& demand, const std::function<bool()>& condition) {
    return eventually([&] {
      output_.send(demand, 0);
      return condition();
    });
  }
  bool unlock() {
    return sendUntil({}, [&] { return output_.report().sequence > 0 && !output_.report().locked; });
  }
  bool isLocked() const { return output_.report().locked; }
  TransmitterStatus status() const { return output_.status(); }
  std::uint64_t reports() const { return output_.report().sequence; }

 private:
  OutputProcess output_;
};

double voltsOf(EmulatedMcc& device, int output) {
  const std::lock_guard lock(device.mutex);
  return device.volts(output);
}

bool isAt(EmulatedMcc& device, double volts) {
  return std::abs(voltsOf(device, kUpperOutput) - volts) < kStep;
}

TEST(UsbOutputProcess, PutsVoltagesOutAndComesBackAtRestAfterItWasUnplugged) {
  EmulatedBus bus;
  auto device = std::make_shared<EmulatedMcc>();
  auto port = bus.plug(5, device);
  Station station(settingsOf("mcc-usb-3100", voltageChannels()));
  ASSERT_TRUE(station.unlock());
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return isAt(*device, kHalfOfUpperRotor); }));
  EXPECT_TRUE(station.status().present);
  EXPECT_TRUE(station.status().channels_calibrated);
  EXPECT_GT(device->toggles, 0);

  port->unplug();
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return !station.status().present; }));
  EXPECT_TRUE(station.status().fault);
  EXPECT_EQ(station.status().trouble, TransmitterTrouble::kAbsent);

  auto again = std::make_shared<EmulatedMcc>();
  const auto next_port = bus.plug(6, again);
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return station.status().present; }));
  const std::uint64_t reports = station.reports();
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return station.reports() > reports + 20; }));
  EXPECT_TRUE(station.isLocked());
  EXPECT_TRUE(isAt(*again, kRestOfUpperRotor)) << "though the ground station has flown on all the while";
  ASSERT_TRUE(station.unlock());
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return isAt(*again, kHalfOfUpperRotor); }));
}

TEST(UsbOutputProcess, ARadioThatIsNotHeardForLongComesBackAtRest) {
  EmulatedBus bus;
  auto device = std::make_shared<EmulatedCrazyradio>();
  const auto port = bus.plug(5, device);
  const auto thrust = [&] {
    const std::lock_guard lock(device->mutex);
    const auto points = device->packetsOf(0x3C);
    return points.empty() ? -1 : points.back()[13] | points.back()[14] << 8;
  };
  const auto hears = [&](bool yes) {
    const std::lock_guard lock(device->mutex);
    device->hears = yes;
  };
  Station station(settingsOf("crazyradio", radioChannels()));
  ASSERT_TRUE(station.unlock());
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return thrust() > 30000; }));
  hears(false);
  // A report that is late on a busy machine is a fault, too.
  const auto unheard = [&] { return station.status().trouble == TransmitterTrouble::kNotAcknowledged; };
  ASSERT_TRUE(station.sendUntil(kFlying, unheard));
  EXPECT_TRUE(station.status().fault);
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return station.isLocked() && thrust() == 0; }));
  hears(true);
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return !station.status().fault; }));
  const std::uint64_t reports = station.reports();
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return station.reports() > reports + 20; }));
  EXPECT_EQ(thrust(), 0);
  ASSERT_TRUE(station.unlock());
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return thrust() > 30000; }));
}

TEST(UsbOutputProcess, ARadioThatIsSoonHeardAgainStillHasWhatHoldsTheHelicopter) {
  EmulatedBus bus;
  auto device = std::make_shared<EmulatedCrazyradio>();
  const auto port = bus.plug(5, device);
  OutputSettings settings = settingsOf("crazyradio", radioChannels());
  settings.guard.hold_s = 1000.0;  // "soon", on however busy a machine
  Station station(settings);
  const auto setPoints = [&] {
    const std::lock_guard lock(device->mutex);
    return device->packetsOf(0x3C);
  };
  const auto thrust = [&](const auto& points) { return points.empty() ? -1 : points.back()[13] | points.back()[14] << 8; };
  ASSERT_TRUE(station.unlock());
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return thrust(setPoints()) > 30000; }));
  for (const std::uint64_t lost : {1, 10, 60}) {
    const std::uint64_t reports = station.reports();
    {
      const std::lock_guard lock(device->mutex);
      device->hears = false;
    }
    ASSERT_TRUE(station.sendUntil(kFlying, [&] {
      return station.status().trouble == TransmitterTrouble::kNotAcknowledged && station.reports() > reports + lost;
    }));
    {
      const std::lock_guard lock(device->mutex);
      device->hears = true;
    }
    ASSERT_TRUE(station.sendUntil(kFlying, [&] { return !station.status().fault; }));
    EXPECT_FALSE(station.isLocked());
    EXPECT_GT(thrust(setPoints()), 30000) << "after " << lost << " packets without an answer";
  }
}

TEST(UsbOutputProcess, OnTheBenchNothingButRestLeaves) {
  EmulatedBus bus;
  auto device = std::make_shared<EmulatedMcc>();
  const auto port = bus.plug(5, device);
  OutputSettings settings = settingsOf("mcc-usb-3100", voltageChannels());
  settings.bench = true;
  Station station(settings);
  ASSERT_TRUE(station.unlock());
  const std::uint64_t reports = station.reports();
  ASSERT_TRUE(station.sendUntil(kFlying, [&] { return station.reports() > reports + 50; }));
  EXPECT_TRUE(station.status().bench);
  EXPECT_FALSE(station.isLocked()) << "everything else runs";
  EXPECT_TRUE(isAt(*device, kRestOfUpperRotor));
  EXPECT_GT(device->toggles, 10);
}

TEST(UsbOutputProcess, WithoutCalibratedAndCheckedChannelsItSaysSo) {
  EmulatedBus bus;
  auto device = std::make_shared<EmulatedMcc>();
  const auto port = bus.plug(5, device);
  for (const bool checked : {false, true}) {
    OutputSettings settings = settingsOf("mcc-usb-3100", checked ? OutputChannels{} : voltageChannels());
    settings.directions_checked = checked;
    Station station(settings);
    ASSERT_TRUE(station.sendUntil({}, [&] { return station.status().present && station.reports() > 0; }));
    EXPECT_TRUE(station.status().self_test_passed);
    EXPECT_FALSE(station.status().channels_calibrated);
  }
}

/// The ground station of ground_station.cpp, in a process of its own.
class OtherStation {
 public:
  OtherStation() : pid_(fork()) {
    if (pid_ != 0) return;
    execl(HELICAL_GROUND_STATION, HELICAL_GROUND_STATION, HELICAL_OUTPUT_PROGRAM, "01A2B3C4", "mcc-usb-3100", nullptr);
    _exit(127);
  }
  ~OtherStation() {
    send(SIGCONT);
    send(SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  void send(int signal_number) const { kill(pid_, signal_number); }

 private:
  pid_t pid_;
};

TEST(UsbOutputProcessKills, VoltagesGoToRestWithoutTheirGroundStation) {
  for (int i = 0; i < 2 * kills(); ++i) {
    const int signal_number = i % 2 == 0 ? SIGKILL : SIGSTOP;
    EmulatedBus bus;
    auto device = std::make_shared<EmulatedMcc>();
    const auto port = bus.plug(5, device);
    const OtherStation station;
    ASSERT_TRUE(eventually([&] { return std::abs(voltsOf(*device, 0) - 2.5) < kStep; })) << "half of the upper rotor";
    station.send(signal_number);
    ASSERT_TRUE(eventually([&] { return std::abs(voltsOf(*device, 0) - 0.5) < kStep; }));
    EXPECT_NEAR(voltsOf(*device, 2), 2.5, kStep) << "roll";
    EXPECT_NEAR(voltsOf(*device, 3), 2.5, kStep) << "pitch";
    station.send(SIGCONT);
    const int writes = [&] {
      const std::lock_guard lock(device->mutex);
      return device->writes;
    }();
    // One that was stopped flies on when it goes on; its voltages do not. One that was killed writes no more.
    eventually([&] {
      const std::lock_guard lock(device->mutex);
      return signal_number == SIGKILL || device->writes > writes + 80;
    });
    EXPECT_NEAR(voltsOf(*device, 0), 0.5, kStep);
  }
}

}  // namespace
}  // namespace helical
