// The Aravis source against virtual cameras in this process: the real protocol over loopback.

#include "engine/cameras/aravis/aravis_camera.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "engine/base/error.h"
#include "engine/base/monotonic.h"
#include "engine/simulator/gige/virtual_camera.h"
#include "tests/support/error_of.h"

namespace helical {
namespace {

using gige::CameraFaults;
using gige::VirtualCamera;

constexpr int kWidth = 128, kHeight = 96;
constexpr TimeNs kPatience = 20 * kNanosecondsPerSecond;

/// Each test has addresses of its own, so that none meets the end of another.
std::string nextAddress() {
  static int last = 1;
  return "127.7.1." + std::to_string(++last);
}

/// A camera whose pictures hold, in their first pixels, the time for which they were asked: it survives as grey.
class Stage {
 public:
  Stage() : address_(nextAddress()), picture_(3U * kWidth * kHeight, 50) { start(); }

  void start() {
    VirtualCamera::Options options;
    options.identity = {parseIp(address_), "T-1", "test", kWidth, kHeight};
    device_ = std::make_unique<VirtualCamera>(options, [this](TimeNs mid_exposure) { return draw(mid_exposure); });
  }
  void stop() { device_.reset(); }

  VirtualCamera& device() { return *device_; }
  const std::string& address() const { return address_; }

  DeviceOptions options() const {
    DeviceOptions o;
    o.format = "Mono8";
    o.rate_hz = 60.0;
    o.exposure_us = 2000.0;
    return o;
  }

 private:
  ImageView draw(TimeNs mid_exposure) {
    for (std::size_t byte = 0; byte < 8; ++byte)
      for (std::size_t channel = 0; channel < 3; ++channel)
        picture_[3 * byte + channel] = static_cast<std::uint8_t>(mid_exposure >> (8 * byte));
    return {picture_.data(), kWidth, kHeight, 3 * kWidth, PixelFormat::kBgr8};
  }

  std::string address_;
  std::vector<std::uint8_t> picture_;
  std::unique_ptr<VirtualCamera> device_;
};

class Client {
 public:
  Client(const Stage& stage, const DeviceOptions& options)
      : clock(std::make_shared<MonotonicClock>()),
        link(std::make_shared<CameraLink>()),
        camera(std::make_unique<AravisCamera>(cameraId(0), stage.address(), options, kWidth, kHeight, clock, link)) {}

  /// The next frame, for which a sensible machine needs no `kPatience`.
  bool next(Frame& frame) {
    const TimeNs deadline = clock->now() + kPatience;
    while (clock->now() < deadline) {
      camera->wait(clock->now() + 20 * kNanosecondsPerMillisecond);
      if (camera->poll(frame)) return true;
    }
    return false;
  }
  /// Polls until `condition` holds.
  bool until(const std::function<bool()>& condition) {
    const TimeNs deadline = clock->now() + kPatience;
    Frame frame;
    while (!condition()) {
      if (clock->now() > deadline) return false;
      camera->wait(clock->now() + 20 * kNanosecondsPerMillisecond);
      while (camera->poll(frame)) ++frames;
    }
    return true;
  }
  bool streams() { return link->state == LinkState::kStreaming; }

  std::shared_ptr<MonotonicClock> clock;
  std::shared_ptr<CameraLink> link;
  std::unique_ptr<AravisCamera> camera;
  int frames = 0;
};

/// The time that the picture was asked for, on the client's clock.
TimeNs drawnFor(const Frame& frame, const Client& client) {
  std::int64_t time = 0;
  for (int byte = 7; byte >= 0; --byte) time = time << 8 | frame.image.data[byte];
  return time + client.clock->now() - monotonicNow();
}

TEST(AravisCamera, StreamsWholeFramesInOrder) {
  Stage stage;
  Client client(stage, stage.options());
  Frame frame;
  std::uint64_t last = 0;
  for (int i = 0; i < 30; ++i) {
    ASSERT_TRUE(client.next(frame));
    EXPECT_GT(frame.sequence, last);
    last = frame.sequence;
    EXPECT_EQ(frame.image.width, kWidth);
    EXPECT_EQ(frame.image.height, kHeight);
    EXPECT_EQ(frame.image.format, PixelFormat::kMono8);
    EXPECT_EQ(frame.image.row(kHeight - 1)[kWidth - 1], 50);
    EXPECT_LE(frame.first_packet, frame.arrival);
    EXPECT_NE(frame.device_time, 0);
  }
}

TEST(AravisCamera, ChangesBrightnessByExposureTimeAndGain) {
  Stage stage;
  DeviceOptions options = stage.options();
  options.exposure_us = 4000.0;
  options.gain_db = 6.0206;  // twice
  Client client(stage, options);
  Frame frame;
  ASSERT_TRUE(client.next(frame));
  EXPECT_EQ(frame.image.row(50)[50], 200);
  EXPECT_EQ(client.link->exposure_us.load(), 4000.0);
  EXPECT_NEAR(client.link->gain.load(), 6.0206, 1e-3);
  EXPECT_TRUE(client.link->gain_in_db.load());
}

TEST(AravisCamera, AppliesWhiteBalanceAndRegion) {
  Stage stage;
  DeviceOptions options = stage.options();
  options.format = "RGB8";
  options.balance_red = 2.0;
  options.balance_blue = 0.5;
  Client client(stage, options);
  Frame frame;
  ASSERT_TRUE(client.next(frame));
  EXPECT_EQ(frame.image.format, PixelFormat::kRgb8);
  const std::uint8_t* const pixel = frame.image.row(50) + 150;
  EXPECT_EQ(std::vector<int>(pixel, pixel + 3), (std::vector<int>{100, 50, 25}));
}

// Offset of the clocks -20 and +20 ms on top of an arbitrary start, drift 50 millionths.
TEST(AravisCamera, FindsTheTimeOfExposureOnOurClock) {
  for (const double sign : {-1.0, 1.0}) {
    Stage stage;
    stage.device().setClock(sign * 0.02, sign * 50e-6);
    Client client(stage, stage.options());
    Frame frame;
    TimeNs worst = 0;
    for (int i = 0; i < 120; ++i) {
      ASSERT_TRUE(client.next(frame));
      if (i >= 60) worst = std::max(worst, std::abs(frame.exposure - drawnFor(frame, client)));
    }
    EXPECT_LT(worst, kNanosecondsPerMillisecond);
  }
}

/// With chunks a virtual camera's packets are stamped when they leave, milliseconds after the exposure.
TEST(AravisCamera, TakesTheTimeOfExposureFromChunks) {
  Stage stage;
  DeviceOptions options = stage.options();
  Client client(stage, options);
  Frame frame;
  for (int i = 0; i < 60; ++i) ASSERT_TRUE(client.next(frame));
  EXPECT_LT(std::abs(frame.exposure - drawnFor(frame, client)), kNanosecondsPerMillisecond);
  EXPECT_EQ(frame.image.row(kHeight - 1)[kWidth - 1], 50);
}

TEST(AravisCamera, ExposesOnPulsesOfALine) {
  Stage stage;
  DeviceOptions options = stage.options();
  options.trigger = TriggerMode::kLine;
  Client client(stage, options);
  Frame frame;
  client.camera->wait(client.clock->now() + 300 * kNanosecondsPerMillisecond);
  EXPECT_FALSE(client.camera->poll(frame));
  for (int i = 0; i < 3; ++i) {
    stage.device().pulseLine();
    EXPECT_TRUE(client.next(frame));
  }
  EXPECT_FALSE(client.camera->poll(frame));
}

/// How near the exposures of two cameras come to each other at best, over 30 of each: they free-run out of phase.
TimeNs nearestExposures(const DeviceOptions& options) {
  Stage stage, other_stage;
  Client client(stage, options), other(other_stage, options);
  const TimeNs to_other = other.clock->now() - client.clock->now();
  std::vector<TimeNs> exposures, others;
  Frame frame;
  for (int i = 0; i < 30; ++i) {
    if (!client.next(frame)) return kPatience;
    exposures.push_back(frame.exposure + to_other);
    if (!other.next(frame)) return kPatience;
    others.push_back(frame.exposure);
  }
  TimeNs nearest = kPatience;
  for (const TimeNs one : exposures)
    for (const TimeNs another : others) nearest = std::min(nearest, std::abs(one - another));
  return nearest;
}

TEST(AravisCamera, ExposesTogetherWithOthersByCommandAndByAction) {
  DeviceOptions options = Stage().options();
  options.rate_hz = 25.0;
  options.trigger = TriggerMode::kSoftware;
  EXPECT_LT(nearestExposures(options), 3 * kNanosecondsPerMillisecond);
  options.trigger = TriggerMode::kAction;
  EXPECT_LT(nearestExposures(options), 3 * kNanosecondsPerMillisecond);
  options.ptp = true;  // told beforehand
  EXPECT_LT(nearestExposures(options), kNanosecondsPerMillisecond);
}

TEST(AravisCamera, AsksAgainForLostPackets) {
  Stage stage;
  DeviceOptions options = stage.options();
  options.packet_bytes = 1000;
  Client client(stage, options);
  CameraFaults faults;
  faults.loss = 0.01;
  stage.device().setFaults(faults);
  Frame frame;
  ASSERT_TRUE(client.next(frame));
  const std::uint64_t first = frame.sequence;
  int whole = 0;
  for (; whole < 200; ++whole) ASSERT_TRUE(client.next(frame));
  EXPECT_LE(frame.sequence - first, 204U) << "of 200 frames some never became whole";
  EXPECT_GT(stage.device().counts().resent, 0U);
}

// Cable out and in, rebooted, taken by another host: each way it comes back with its settings.
class AravisCameraComesBack : public testing::TestWithParam<const char*> {};

TEST_P(AravisCameraComesBack, WithItsSettings) {
  const std::string what = GetParam();
  Stage stage;
  DeviceOptions options = stage.options();
  options.exposure_us = 4000.0;
  Client client(stage, options);
  ASSERT_TRUE(client.until([&] { return client.frames > 10; }));
  CameraFaults faults;
  if (what == "mute") faults.mute = true;
  if (what == "taken") faults.taken = true;
  if (what == "restart") stage.stop();
  if (what == "reboot")
    stage.device().reboot(0.5);
  else if (what != "restart")
    stage.device().setFaults(faults);
  const TimeNs began = monotonicNow();
  ASSERT_TRUE(client.until([&] { return !client.streams() || client.link->returns > 0U; }))
      << "the loss was not noticed";
  RecordProperty("noticed_ms", static_cast<int>((monotonicNow() - began) / kNanosecondsPerMillisecond));
  if (what == "taken") {
    ASSERT_TRUE(client.until([&] { return client.link->state == LinkState::kTaken; }));
  }
  const TimeNs lost = monotonicNow();
  ASSERT_TRUE(client.until([&] { return monotonicNow() > lost + 700 * kNanosecondsPerMillisecond; }));
  if (what == "restart") stage.start();
  if (what == "mute" || what == "taken") stage.device().setFaults({});
  const TimeNs reachable = monotonicNow();
  ASSERT_TRUE(client.until([&] { return client.streams() && client.link->returns == 1U; }));
  RecordProperty("back_ms", static_cast<int>((monotonicNow() - reachable) / kNanosecondsPerMillisecond));
  Frame frame;
  ASSERT_TRUE(client.next(frame));
  EXPECT_EQ(frame.image.row(50)[50], 100) << "the exposure time is not what it was set to";
}

INSTANTIATE_TEST_SUITE_P(All, AravisCameraComesBack, testing::Values("mute", "taken", "restart", "reboot"));

std::size_t entries(const char* folder) {
  return static_cast<std::size_t>(
      std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

long residentPages() {
  long size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident;
}

TEST(AravisCamera, LeaksNothingOverFiftyRestarts) {
  Stage stage;
  const auto restart = [&](int times) {
    for (int i = 0; i < times; ++i) {
      Client client(stage, stage.options());
      Frame frame;
      ASSERT_TRUE(client.next(frame));
    }
  };
  restart(10);  // what Aravis and the allocator keep for good
  const std::size_t descriptors = entries("/proc/self/fd"), threads = entries("/proc/self/task");
  const long pages = residentPages();
  restart(50);
  EXPECT_EQ(entries("/proc/self/fd"), descriptors);
  EXPECT_EQ(entries("/proc/self/task"), threads);
  // The buffers of one stream alone are 50 pages.
  EXPECT_LT(residentPages() - pages, 25 * 50);
}

TEST(AravisCamera, SaysWhatIsWrong) {
  Stage stage;
  const auto open = [&](const std::function<void(DeviceOptions&)>& change) {
    DeviceOptions options = stage.options();
    change(options);
    Client client(stage, options);
  };
  const Error format = errorOf([&] { open([](DeviceOptions& o) { o.format = "BayerRG12"; }); });
  EXPECT_EQ(format.kind(), ErrorKind::kInput);
  EXPECT_NE(format.cure().find("BayerRG8"), std::string::npos) << format.what();
  const Error rate = errorOf([&] { open([](DeviceOptions& o) { o.rate_hz = 500.0; }); });
  EXPECT_EQ(rate.kind(), ErrorKind::kInput);
  EXPECT_NE(rate.cure().find("240"), std::string::npos) << rate.what();
  const Error region = errorOf([&] { open([](DeviceOptions& o) { o.offset_x = 2; }); });
  EXPECT_EQ(region.kind(), ErrorKind::kInput);
  EXPECT_NE(region.cure().find("128"), std::string::npos) << region.what();

  Stage silent;
  silent.stop();
  const Error absent = errorOf([&] { Client client(silent, silent.options()); });
  EXPECT_EQ(absent.kind(), ErrorKind::kDevice);
  EXPECT_NE(std::string(absent.what()).find(silent.address()), std::string::npos);
}

}  // namespace
}  // namespace helical
