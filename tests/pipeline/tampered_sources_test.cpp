#include "engine/pipeline/tampered_sources.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace helical {
namespace {

constexpr int kWidth = 64, kHeight = 48;

/// Grey frames, one a poll, up to `count` of them.
class GreyCamera final : public CameraSource {
 public:
  explicit GreyCamera(int count, std::uint8_t grey = 100)
      : left_(count), pixels_(3 * kWidth * kHeight, grey) {}
  CameraId camera() const override { return cameraId(0); }
  bool poll(Frame& frame) override {
    if (left_-- <= 0) return false;
    frame = {camera(), sequence_++, 5, 7, {pixels_.data(), kWidth, kHeight, 3 * kWidth, PixelFormat::kBgr8}};
    return true;
  }
  void wait(TimeNs) override {}

 private:
  int left_;
  std::uint64_t sequence_ = 0;
  std::vector<std::uint8_t> pixels_;
};

class OneCentroid final : public ObservationSource {
 public:
  explicit OneCentroid(int count) : left_(count) {}
  CameraId camera() const override { return cameraId(1); }
  bool poll(Observation& observation) override {
    if (left_-- <= 0) return false;
    observation.sequence = sequence_++;
    observation.count = 1;
    observation.centroids[0].pixel = {50.0, 60.0};
    return true;
  }
  void wait(TimeNs) override {}

 private:
  int left_;
  std::uint64_t sequence_ = 0;
};

std::shared_ptr<TamperingChannel> channelWith(const Tampering& tampering) {
  auto channel = std::make_shared<TamperingChannel>();
  channel->back() = tampering;
  channel->publish();
  return channel;
}

TEST(TamperedCamera, LosesItsShareOfTheFramesAsGapsInTheSequence) {
  Tampering tampering;
  tampering.lost_share = 0.3;
  TamperedCamera camera(std::make_unique<GreyCamera>(10'000), channelWith(tampering));
  Frame frame;
  int arrived = 0, gaps = 0;
  std::uint64_t last = 0;
  while (camera.poll(frame)) {
    if (arrived++ > 0) gaps += frame.sequence != last + 1;
    last = frame.sequence;
  }
  EXPECT_NEAR(arrived, 7000, 5 * std::sqrt(10'000 * 0.3 * 0.7));
  EXPECT_GT(gaps, 1500);
}

TEST(TamperedCamera, AllLostIsSilence) {
  Tampering tampering;
  tampering.lost_share = 1.0;
  TamperedCamera camera(std::make_unique<GreyCamera>(100), channelWith(tampering));
  Frame frame;
  EXPECT_FALSE(camera.poll(frame));
}

TEST(TamperedCamera, NoiseHasItsStandardDeviationAndNoPattern) {
  Tampering tampering;
  tampering.noise_grey = 12.0;
  TamperedCamera camera(std::make_unique<GreyCamera>(2), channelWith(tampering));
  Frame frame;
  ASSERT_TRUE(camera.poll(frame));
  double sum = 0.0, squares = 0.0, below = 0.0;
  const int bytes = 3 * kWidth;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < bytes; ++x) {
      const double value = frame.image.row(y)[x] - 100.0;
      sum += value;
      squares += value * value;
      if (y > 0) below += value * (frame.image.row(y - 1)[x] - 100.0);
    }
  const double count = bytes * kHeight;
  EXPECT_NEAR(sum / count, 0.0, 1.0);
  EXPECT_NEAR(std::sqrt(squares / count), 12.0, 0.6);
  EXPECT_LT(std::abs(below / count), 0.15 * 144.0) << "rows do not repeat";
  const std::vector<std::uint8_t> first(frame.image.row(0), frame.image.row(0) + bytes);
  ASSERT_TRUE(camera.poll(frame));
  EXPECT_NE(first, std::vector<std::uint8_t>(frame.image.row(0), frame.image.row(0) + bytes));
}

TEST(TamperedCamera, BrightNoiseDoesNotWrapToBlack) {
  Tampering tampering;
  tampering.noise_grey = 30.0;
  TamperedCamera camera(std::make_unique<GreyCamera>(1, 250), channelWith(tampering));
  Frame frame;
  ASSERT_TRUE(camera.poll(frame));
  for (int x = 0; x < 3 * kWidth; ++x) EXPECT_GT(frame.image.row(5)[x], 90);
}

TEST(TamperedObserver, LosesFramesAndMovesCentroids) {
  Tampering tampering;
  tampering.lost_share = 0.5;
  tampering.noise_px = 1.5;
  TamperedObserver observer(std::make_unique<OneCentroid>(4000), channelWith(tampering));
  Observation observation;
  int arrived = 0;
  double squares = 0.0;
  for (; observer.poll(observation); ++arrived)
    squares += (observation.centroids[0].pixel - Eigen::Vector2d(50.0, 60.0)).squaredNorm();
  EXPECT_NEAR(arrived, 2000, 160);
  EXPECT_NEAR(std::sqrt(squares / (2.0 * arrived)), 1.5, 0.1);
}

TEST(TamperedObserver, WithoutOrdersItPassesEverything) {
  TamperedObserver observer(std::make_unique<OneCentroid>(50), std::make_shared<TamperingChannel>());
  Observation observation;
  for (int i = 0; i < 50; ++i) {
    ASSERT_TRUE(observer.poll(observation));
    EXPECT_EQ(observation.centroids[0].pixel, Eigen::Vector2d(50.0, 60.0));
  }
}

}  // namespace
}  // namespace helical
