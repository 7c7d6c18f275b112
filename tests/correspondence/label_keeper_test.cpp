#include "engine/correspondence/label_keeper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "tests/calibration/training_flight.h"

namespace helical {
namespace {

using test::flyForTraining;
using test::TrainingFlight;

struct Seen {
  Observation observation;
  Names truth;
};

/// A frame's pixels as an extractor gives them: in any order, with clutter.
Seen shuffled(const TrainingFlight::Frame& frame, int clutter, Random& random) {
  Seen seen;
  seen.truth.fill(-1);
  seen.observation.exposure = frame.exposure;
  std::vector<Eigen::Vector2d> pixels;
  std::vector<int> markers;
  for (const auto& pixel : frame.pixels) {
    pixels.push_back(pixel.pixel);
    markers.push_back(pixel.marker.index());
  }
  for (int i = 0; i < clutter; ++i) {
    pixels.emplace_back(random.uniform(0, 640), random.uniform(0, 480));
    markers.push_back(-1);
  }
  std::vector<std::size_t> order(pixels.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i)))]);
  for (const std::size_t i : order) {
    const int place = seen.observation.count++;
    Centroid& centroid = seen.observation.centroids[static_cast<std::size_t>(place)];
    centroid.pixel = pixels[i];
    centroid.radius_px = 4.0;
    centroid.area_px = 50.0;
    if (markers[i] >= 0) seen.truth[static_cast<std::size_t>(markers[i])] = place;
  }
  return seen;
}

bool isOutlier(const TrainingFlight& flight, const TrainingFlight::Frame& frame, int marker,
               const Observation& seen, int name) {
  const auto pixel = flight.camera.project(
      flight.camera_from_world * (frame.true_world_from_body * flight.markers.inBody(markerId(marker))));
  return (seen.centroids[static_cast<std::size_t>(name)].pixel - *pixel).norm() > 3.0;
}

TEST(LabelKeeper, KeepsTheNamesThroughWholeFlights) {
  int right = 0, missed = 0, wrong = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TrainingFlight flight = flyForTraining(seed);
    Random random(seed);
    LabelKeeper keeper({}, 4);
    for (const auto& frame : flight.frames) {
      const Seen seen = shuffled(frame, 2, random);
      if (keeper.lost()) {
        if (frame.pixels.size() == 4) keeper.restart(seen.observation, seen.truth);
        continue;
      }
      const Names names = keeper.follow(seen.observation);
      for (int m = 0; m < 4; ++m) {
        const int name = names[static_cast<std::size_t>(m)], truth = seen.truth[static_cast<std::size_t>(m)];
        if (name >= 0 && name != truth) ++wrong;
        if (name >= 0 && name == truth) ++right;
        if (name < 0 && truth >= 0 && !isOutlier(flight, frame, m, seen.observation, truth)) ++missed;
      }
    }
    EXPECT_FALSE(keeper.lost());
  }
  EXPECT_LT(wrong, right / 1000);
  EXPECT_LT(missed, right / 100);
}

Seen still(double seconds, std::span<const Eigen::Vector2d> pixels) {
  Seen seen;
  seen.truth.fill(-1);
  seen.observation.exposure = fromSeconds(seconds);
  for (const auto& pixel : pixels) {
    seen.truth[static_cast<std::size_t>(seen.observation.count)] = seen.observation.count;
    seen.observation.centroids[static_cast<std::size_t>(seen.observation.count++)].pixel = pixel;
  }
  return seen;
}

TEST(LabelKeeper, IsLostAfterAGapAndStaysSoUntilANewLabelling) {
  const std::vector<Eigen::Vector2d> pixels{{100, 100}, {160, 100}, {160, 150}, {100, 150}};
  LabelKeeper keeper({}, 4);
  EXPECT_TRUE(keeper.lost());
  const Seen first = still(1.0, pixels);
  keeper.restart(first.observation, first.truth);
  EXPECT_FALSE(keeper.lost());
  EXPECT_EQ(keeper.follow(still(1.1, pixels).observation), first.truth);
  keeper.follow(still(1.2, {}).observation);
  EXPECT_FALSE(keeper.lost());
  keeper.follow(still(1.6, {}).observation);
  EXPECT_TRUE(keeper.lost());
  const Names nobody = keeper.follow(still(1.7, pixels).observation);
  EXPECT_TRUE(std::all_of(nobody.begin(), nobody.end(), [](int name) { return name < 0; }));
}

TEST(LabelKeeper, TwoNamesAreTooFewToStartFrom) {
  const std::vector<Eigen::Vector2d> pixels{{100, 100}, {160, 100}};
  LabelKeeper keeper({}, 4);
  const Seen first = still(1.0, pixels);
  keeper.restart(first.observation, first.truth);
  EXPECT_TRUE(keeper.lost());
}

TEST(LabelKeeper, CarriesAHiddenBallWithTheOthers) {
  LabelKeeper keeper({}, 4);
  const auto at = [](int k) {
    const Eigen::Vector2d move(4.0 * k, 1.0 * k);  // 240 px/s
    return std::vector<Eigen::Vector2d>{Eigen::Vector2d(100, 100) + move, Eigen::Vector2d(160, 100) + move,
                                        Eigen::Vector2d(160, 150) + move, Eigen::Vector2d(100, 150) + move};
  };
  const auto seconds = [](int k) { return 1.0 + k / 60.0; };
  const auto start = at(0);
  keeper.restart(still(seconds(0), start).observation, still(seconds(0), start).truth);
  for (int k = 1; k < 60; ++k) {
    auto pixels = at(k);
    if (k > 10 && k < 50) pixels.pop_back();
    const Seen seen = still(seconds(k), pixels);
    EXPECT_EQ(keeper.follow(seen.observation), seen.truth) << k;
  }
}

TEST(LabelKeeper, RejectsOptionsOutOfRange) {
  LabelKeeperOptions options;
  EXPECT_NO_THROW(validate(options));
  options.gate_px = 0.0;
  EXPECT_THROW(LabelKeeper(options, 4), Error);
}

}  // namespace
}  // namespace helical
