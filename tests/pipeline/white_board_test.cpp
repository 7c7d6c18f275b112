#include "engine/pipeline/white_board.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/pipeline/tampered_sources.h"

namespace helical {
namespace {

constexpr int kWidth = 40, kHeight = 30;

WhiteBoard board(std::initializer_list<Eigen::Vector2d> corners) {
  WhiteBoard result;
  for (const auto& corner : corners) result.corners[static_cast<std::size_t>(result.count++)] = corner;
  return result;
}

WhiteBoards rectangle(double left, double top, double right, double bottom) {
  WhiteBoards boards;
  boards.count = 1;
  boards.boards[0] = board({{left, top}, {right, top}, {right, bottom}, {left, bottom}});
  return boards;
}

/// Grey frames of one camera, one a poll.
class GreyCamera final : public CameraSource {
 public:
  explicit GreyCamera(PixelFormat format) : format_(format) {
    pixels_.assign(static_cast<std::size_t>(kHeight * stride()), 100);
  }
  CameraId camera() const override { return cameraId(2); }
  bool poll(Frame& frame) override {
    frame = {camera(), sequence_++, 5, 7, {pixels_.data(), kWidth, kHeight, stride(), format_}};
    return true;
  }
  void wait(TimeNs) override {}
  bool untouched() const {
    for (const auto pixel : pixels_)
      if (pixel != 100) return false;
    return true;
  }

 private:
  int stride() const { return kWidth * (format_ == PixelFormat::kMono8 ? 1 : 3) + 5; }
  PixelFormat format_;
  std::uint64_t sequence_ = 0;
  std::vector<std::uint8_t> pixels_;
};

class FourCentroids final : public ObservationSource {
 public:
  CameraId camera() const override { return cameraId(1); }
  bool poll(Observation& observation) override {
    observation.count = 4;
    for (int i = 0; i < 4; ++i) observation.centroids[static_cast<std::size_t>(i)].pixel = {10.0 * i, 10.0};
    return true;
  }
  void wait(TimeNs) override {}
};

TEST(WhiteBoard, CoversWhatIsInsideOfAnyPolygon) {
  const WhiteBoard notched = board({{0, 0}, {20, 0}, {20, 20}, {10, 5}, {0, 20}});
  EXPECT_TRUE(notched.covers({3, 10}));
  EXPECT_TRUE(notched.covers({17, 10}));
  EXPECT_FALSE(notched.covers({10, 12})) << "in the notch";
  EXPECT_FALSE(notched.covers({25, 10}));
  EXPECT_FALSE(WhiteBoard{}.covers({0, 0}));
}

TEST(WhiteBoard, FramesShowItAndTheSourceKeepsItsPixels) {
  for (const PixelFormat format : {PixelFormat::kMono8, PixelFormat::kBgr8}) {
    auto source = std::make_unique<GreyCamera>(format);
    const GreyCamera& grey = *source;
    auto channel = std::make_shared<TamperingChannel>();
    TamperedCamera camera(std::move(source), channel);
    Frame frame;
    ASSERT_TRUE(camera.poll(frame));
    EXPECT_EQ(frame.image.row(10)[0], 100);

    channel->back().boards = rectangle(4.5, 5.5, 9.5, 100.0);
    channel->publish();
    ASSERT_TRUE(camera.poll(frame));
    EXPECT_EQ(frame.sequence, 1U);
    const int bytes = format == PixelFormat::kMono8 ? 1 : 3;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const bool covered = y >= 6 && x >= 5 && x <= 9;
        EXPECT_EQ(frame.image.row(y)[bytes * x + bytes - 1] > 200, covered) << x << ", " << y;
      }
    EXPECT_TRUE(grey.untouched());

    channel->back().boards = {};
    channel->publish();
    ASSERT_TRUE(camera.poll(frame));
    EXPECT_EQ(frame.image.row(10)[bytes * 7], 100);
  }
}

TEST(WhiteBoard, OutsideOfTheImageItTouchesNothing) {
  auto channel = std::make_shared<TamperingChannel>();
  channel->back().boards = rectangle(-500.0, -500.0, 1e4, 1e4);
  channel->publish();
  TamperedCamera camera(std::make_unique<GreyCamera>(PixelFormat::kBgr8), channel);
  Frame frame;
  ASSERT_TRUE(camera.poll(frame));
  EXPECT_GT(frame.image.row(kHeight - 1)[3 * kWidth - 1], 200);
  EXPECT_EQ(frame.image.row(0)[3 * kWidth], 100) << "the padding of a row";
}

TEST(WhiteBoard, CentroidsBehindItAreNotSeen) {
  auto channel = std::make_shared<TamperingChannel>();
  TamperedObserver observer(std::make_unique<FourCentroids>(), channel);
  Observation observation;
  ASSERT_TRUE(observer.poll(observation));
  EXPECT_EQ(observation.count, 4);
  channel->back().boards = rectangle(5.0, 0.0, 22.0, 20.0);
  channel->publish();
  ASSERT_TRUE(observer.poll(observation));
  ASSERT_EQ(observation.count, 2);
  EXPECT_EQ(observation.centroids[0].pixel.x(), 0.0);
  EXPECT_EQ(observation.centroids[1].pixel.x(), 30.0);
}

}  // namespace
}  // namespace helical
