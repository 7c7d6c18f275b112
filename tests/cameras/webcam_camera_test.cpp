// A webcam's loss, return, stamps and settings, with a stand-in for the video library: no machine of ours has a webcam.

#include "engine/cameras/webcam/webcam_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>

#include "engine/base/error.h"
#include "engine/base/monotonic.h"
#include "engine/cameras/webcam/webcam_settings.h"

namespace helical {
namespace {

using Property = VideoCapture::Property;

constexpr int kWidth = 32, kHeight = 24;
constexpr TimeNs kMs = kNanosecondsPerMillisecond;
constexpr TimeNs kPatience = 20 * kNanosecondsPerSecond;

/// What is plugged in, whoever opens it. Any thread.
struct Webcam {
  std::atomic<bool> plugged{true};
  std::atomic<bool> hangs{false};  ///< the driver waits, as OpenCV lets it for a second
  std::atomic<bool> stamps{true};
  std::atomic<int> opened{0};
  std::atomic<int> frames{0};
  double highest_rate = 60.0;
  bool manual_exposure = true;
  double gain = 0.0;
};

class FakeCapture final : public VideoCapture {
 public:
  explicit FakeCapture(std::shared_ptr<Webcam> webcam) : webcam_(std::move(webcam)), pixels_(3U * kWidth * kHeight) {}

  bool openFile(const std::string&) override { return false; }
  bool openDevice(const std::string&) override {
    open_ = webcam_->plugged;
    webcam_->opened += open_ ? 1 : 0;
    return open_;
  }
  bool set(Property property, double value) override {
    order.push_back(property);
    if (property == Property::kExposure || property == Property::kAutoExposure) {
      values_[property] = value;
      return webcam_->manual_exposure;
    }
    if (property == Property::kRate) value = std::min(value, webcam_->highest_rate);
    if (property == Property::kFourCc && value != toFourCc("MJPG") && value != toFourCc("YUYV")) return false;
    if (property == Property::kWidth && value > 2 * kWidth) value = 2 * kWidth;
    values_[property] = value;
    return true;
  }
  double get(Property property) const override {
    if (property == Property::kGain) return webcam_->gain;
    if (property == Property::kTimeMs) return webcam_->stamps ? 1e-6 * static_cast<double>(stamp_) : 0.0;
    const auto found = values_.find(property);
    return found == values_.end() ? 0.0 : found->second;
  }
  bool read(ImageView& bgr) override {
    for (TimeNs began = monotonicNow(); webcam_->hangs && monotonicNow() < began + 1000 * kMs;)
      sleepUntilMonotonic(monotonicNow() + 5 * kMs);
    sleepUntilMonotonic(monotonicNow() + 10 * kMs);
    if (!open_ || !webcam_->plugged || webcam_->hangs) return false;
    stamp_ = monotonicNow() - 3 * kMs;  // decoding takes time
    std::fill(pixels_.begin(), pixels_.end(), static_cast<std::uint8_t>(++webcam_->frames));
    bgr = {pixels_.data(), kWidth, kHeight, 3 * kWidth, PixelFormat::kBgr8};
    return true;
  }

  std::vector<Property> order;

 private:
  std::shared_ptr<Webcam> webcam_;
  std::vector<std::uint8_t> pixels_;
  std::map<Property, double> values_;
  TimeNs stamp_ = 0;
  bool open_ = false;
};

struct Client {
  explicit Client(const DeviceOptions& options = {}) {
    // A node that is always there: what comes and goes is the stand-in.
    camera = std::make_unique<WebcamCamera>(cameraId(0), "/dev/null", options, kWidth, kHeight, clock, link,
                                            [webcam = webcam] { return std::make_unique<FakeCapture>(webcam); });
  }
  bool next(Frame& frame) {
    for (const TimeNs end = clock->now() + kPatience; clock->now() < end;) {
      camera->wait(clock->now() + 20 * kMs);
      if (camera->poll(frame)) return true;
    }
    return false;
  }
  bool until(const std::function<bool()>& condition) {
    Frame frame;
    for (const TimeNs end = clock->now() + kPatience; clock->now() < end;) {
      if (condition()) return true;
      camera->wait(clock->now() + 5 * kMs);
      while (camera->poll(frame)) {
      }
    }
    return false;
  }
  std::shared_ptr<Webcam> webcam = std::make_shared<Webcam>();
  std::shared_ptr<MonotonicClock> clock = std::make_shared<MonotonicClock>();
  std::shared_ptr<CameraLink> link = std::make_shared<CameraLink>();
  std::unique_ptr<WebcamCamera> camera;
};

TEST(WebcamCamera, GivesFramesInOrderStampedByTheDriver) {
  DeviceOptions options;
  options.readout_ms = 20.0;
  Client client(options);
  Frame frame;
  std::uint64_t last = 0;
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(client.next(frame));
    EXPECT_GT(frame.sequence, last);
    last = frame.sequence;
    EXPECT_EQ(frame.image.row(kHeight - 1)[3 * kWidth - 1], static_cast<std::uint8_t>(frame.sequence));
    EXPECT_GE(frame.arrival - frame.exposure, 23 * kMs - kMs / 10) << "three for decoding, twenty by the rig";
  }
}

TEST(WebcamCamera, StampsItselfWhatTheDriverDoesNot) {
  Client client;
  client.webcam->stamps = false;
  Frame frame;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(client.next(frame));  // some were on their way
  EXPECT_EQ(frame.arrival - frame.exposure, 8 * kMs);
}

TEST(WebcamCamera, ComesBackWhenItIsPluggedInAgain) {
  Client client;
  Frame frame;
  ASSERT_TRUE(client.next(frame));
  client.webcam->plugged = false;
  // The node stays in this test, so that somebody else seems to have it.
  ASSERT_TRUE(client.until([&] { return client.link->state == LinkState::kTaken; }));
  const int opened = client.webcam->opened;
  client.webcam->plugged = true;
  ASSERT_TRUE(client.until([&] { return client.link->state == LinkState::kStreaming; }));
  EXPECT_EQ(client.webcam->opened, opened + 1);
  EXPECT_EQ(client.link->returns, 1U);
  EXPECT_TRUE(client.next(frame));
}

TEST(WebcamCamera, TellsThatItIsSilentWhileTheDriverHangs) {
  DeviceOptions options;
  options.silence_ms = 100.0;
  Client client(options);
  Frame frame;
  ASSERT_TRUE(client.next(frame));
  client.webcam->hangs = true;
  ASSERT_TRUE(client.until([&] { return client.link->state != LinkState::kStreaming; }));
  client.webcam->hangs = false;
  ASSERT_TRUE(client.until([&] { return client.link->state == LinkState::kStreaming; }));
  EXPECT_GE(client.link->returns, 1U);
  EXPECT_TRUE(client.next(frame));
}

TEST(WebcamCamera, IsMissedAtTheStart) {
  const auto absent = [] {
    const auto clock = std::make_shared<MonotonicClock>();
    WebcamCamera camera(cameraId(0), "/dev/no-such-webcam", {}, kWidth, kHeight, clock,
                        std::make_shared<CameraLink>(), [] {
                          auto webcam = std::make_shared<Webcam>();
                          webcam->plugged = false;
                          return std::make_unique<FakeCapture>(webcam);
                        });
  };
  try {
    absent();
    FAIL() << "no Error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kDevice);
    EXPECT_NE(std::string(error.what()).find("/dev/no-such-webcam"), std::string::npos);
  }
}

class WebcamSettings : public testing::Test {
 protected:
  std::string refusal(const DeviceOptions& options, int width = kWidth) {
    try {
      applyWebcamSettings(capture, options, width, kHeight, "webcam:test");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.problem() + "|" + error.cure();
    }
    return "";
  }
  std::shared_ptr<Webcam> webcam = std::make_shared<Webcam>();
  FakeCapture capture{webcam};
};

TEST_F(WebcamSettings, ComeInTheOrderThatDriversNeed) {
  DeviceOptions options;
  options.exposure_us = 5000.0;
  EXPECT_EQ(refusal(options), "");
  EXPECT_EQ(capture.order, (std::vector{Property::kFourCc, Property::kWidth, Property::kHeight, Property::kRate,
                                        Property::kAutoExposure, Property::kExposure}));
  EXPECT_EQ(nameOfFourCc(capture.get(Property::kFourCc)), "MJPG");
  EXPECT_EQ(capture.get(Property::kExposure), 50.0);  // V4L2 counts hundreds of microseconds
  EXPECT_EQ(capture.get(Property::kAutoExposure), 1.0);
}

TEST_F(WebcamSettings, AreReadBack) {
  DeviceOptions options;
  EXPECT_EQ(refusal(options), "");
  EXPECT_EQ(lightOf(capture, options).exposure_us, 0.0) << "it times its exposure by itself";
  EXPECT_TRUE(std::isnan(lightOf(capture, options).gain));
  options.exposure_us = 5040.0;
  webcam->gain = 24.0;
  EXPECT_EQ(refusal(options), "");
  const LightSetting light = lightOf(capture, options);
  EXPECT_EQ(light.exposure_us, 5000.0) << "in steps of a hundred";
  EXPECT_EQ(light.gain, 24.0);
  EXPECT_FALSE(light.gain_in_db);
}

TEST_F(WebcamSettings, SayWhatTheCameraGivesInstead) {
  DeviceOptions options;
  EXPECT_EQ(refusal(options), "");
  EXPECT_NE(refusal(options, 4 * kWidth).find("it gives 64x24"), std::string::npos);
  options.rate_hz = 100.0;
  EXPECT_NE(refusal(options).find("it gives 60"), std::string::npos);
  options.rate_hz = 30.0;
  options.format = "H264";
  EXPECT_NE(refusal(options).find("it gives MJPG"), std::string::npos);
  options.format = "YUYV";
  EXPECT_EQ(refusal(options), "");
  options.ptp = true;
  EXPECT_NE(refusal(options).find("ptp"), std::string::npos);
  options.ptp = false;
  options.exposure_us = 5000.0;
  webcam->manual_exposure = false;
  EXPECT_NE(refusal(options).find("exposure_us"), std::string::npos);
}

}  // namespace
}  // namespace helical
