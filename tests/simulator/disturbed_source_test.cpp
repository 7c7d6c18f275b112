#include "engine/simulator/disturbed_source.h"

#include <gtest/gtest.h>

#include <cmath>

namespace helical {
namespace {

constexpr int kFrames = 5000;
constexpr int kBalls = 4;

/// Four balls that stand still in the middle of the image, one frame a poll.
class StillBalls final : public ObservationSource {
 public:
  CameraId camera() const override { return cameraId(1); }
  bool poll(Observation& observation) override {
    observation = {};
    observation.camera = camera();
    observation.sequence = frame_++;
    observation.count = kBalls;
    for (int c = 0; c < kBalls; ++c) {
      observation.centroids[static_cast<std::size_t>(c)].pixel = at(c);
      observation.centroids[static_cast<std::size_t>(c)].radius_px = 4.0;
    }
    return true;
  }
  void wait(TimeNs) override {}

  static Eigen::Vector2d at(int ball) { return {300.0 + 10.0 * ball, 240.0}; }

 private:
  std::uint64_t frame_ = 0;
};

struct Tally {
  int seen = 0;
  int thrown = 0;
  double farthest = 0.0;
};

Tally watch(double lost, double outliers) {
  SimulationOptions options;
  options.noise.lost_markers = lost;
  options.noise.outliers = outliers;
  DisturbedSource source(std::make_unique<StillBalls>(), CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5),
                         options);
  EXPECT_EQ(source.camera(), cameraId(1));
  Tally tally;
  Observation observation;
  for (int f = 0; f < kFrames; ++f) {
    EXPECT_TRUE(source.poll(observation));
    for (int c = 0; c < observation.count; ++c) {
      double nearest = 1e9;
      for (int ball = 0; ball < kBalls; ++ball)
        nearest = std::min(
            nearest,
            (observation.centroids[static_cast<std::size_t>(c)].pixel - StillBalls::at(ball)).norm());
      ++tally.seen;
      tally.thrown += nearest > 0.0;
      tally.farthest = std::max(tally.farthest, nearest);
    }
  }
  return tally;
}

TEST(DisturbedSource, ChangesNothingByDefault) {
  const Tally tally = watch(0.0, 0.0);
  EXPECT_EQ(tally.seen, kBalls * kFrames);
  EXPECT_EQ(tally.thrown, 0);
}

TEST(DisturbedSource, LosesAndThrowsTheGivenShares) {
  const Tally tally = watch(0.03, 0.01);
  const double balls = kBalls * kFrames;
  EXPECT_NEAR(tally.seen / balls, 0.97, 5.0 * std::sqrt(0.03 / balls));
  EXPECT_NEAR(tally.thrown / balls, 0.0097, 5.0 * std::sqrt(0.01 / balls));
  EXPECT_LE(tally.farthest, std::sqrt(2.0) * kOutlierReachPx);
}

TEST(DisturbedSource, RepeatsForASeed) {
  const Tally one = watch(0.1, 0.1), two = watch(0.1, 0.1);
  EXPECT_EQ(one.seen, two.seen);
  EXPECT_EQ(one.farthest, two.farthest);
}

}  // namespace
}  // namespace helical
