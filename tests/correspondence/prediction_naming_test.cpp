#include "engine/correspondence/prediction_naming.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "engine/base/random.h"

namespace helical {
namespace {

using Eigen::Vector2d;

constexpr double kGate = 18.0;
constexpr double kRadius = 4.0;
constexpr double kDisc = 3.14159 * kRadius * kRadius;

MarkerPrediction at(const Vector2d& pixel, double sigma = 1.0) {
  return {true, pixel, sigma * sigma * Eigen::Matrix2d::Identity(), kRadius};
}

void add(Observation& observation, const Vector2d& pixel, double area = kDisc) {
  Centroid& centroid = observation.centroids[static_cast<std::size_t>(observation.count++)];
  centroid.pixel = pixel;
  centroid.area_px = area;
}

/// Four balls of a helicopter some 30 px apart, somewhere in the image.
std::vector<MarkerPrediction> fourBalls(Random& random) {
  const Vector2d centre(random.uniform(100, 540), random.uniform(100, 380));
  std::vector<MarkerPrediction> predictions;
  for (const Vector2d& corner : {Vector2d(30, 22), Vector2d(-26, 31), Vector2d(-33, -20), Vector2d(22, -33)})
    predictions.push_back(at(centre + corner));
  return predictions;
}

TEST(NameByPrediction, GivesEveryMarkerItsOwnCentroidUnderNoise) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto predictions = fourBalls(random);
    std::array<int, 4> order{0, 1, 2, 3};
    for (std::size_t i = 3; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i) + 1.0))]);
    Observation observation;
    for (const int marker : order)
      add(observation, predictions[static_cast<std::size_t>(marker)].pixel +
                           0.7 * Vector2d(random.normal(), random.normal()));
    const Names names = nameByPrediction(predictions, observation, kGate);
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_EQ(names[static_cast<std::size_t>(order[c])], static_cast<int>(c));
  }
}

/// With clutter everywhere: one to one, inside the gate, and nobody left out who could still be named.
TEST(NameByPrediction, IsOneToOneInsideTheGateAndLeavesNoFreePair) {
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    std::vector<MarkerPrediction> predictions;
    for (int m = 0; m < 8; ++m)
      predictions.push_back(at({random.uniform(0, 60), random.uniform(0, 60)}, random.uniform(0.5, 3.0)));
    for (auto& prediction : predictions) prediction.radius_px = 0.1;
    predictions[3].visible = false;
    Observation observation;
    for (int c = 0; c < 20; ++c) add(observation, {random.uniform(0, 60), random.uniform(0, 60)}, 0.01);
    const Names names = nameByPrediction(predictions, observation, kGate);
    EXPECT_EQ(names[3], -1) << "what cannot be seen has no centroid";
    std::set<int> used;
    for (std::size_t m = 0; m < names.size(); ++m)
      if (names[m] >= 0) {
        EXPECT_TRUE(used.insert(names[m]).second);
      }
    const auto distance2 = [&](std::size_t m, int c) {
      const Vector2d d = observation.centroids[static_cast<std::size_t>(c)].pixel - predictions[m].pixel;
      return d.dot(predictions[m].covariance.inverse() * d);
    };
    for (std::size_t m = 0; m < predictions.size(); ++m) {
      if (names[m] >= 0) {
        EXPECT_LT(distance2(m, names[m]), kGate);
      }
      if (names[m] >= 0 || !predictions[m].visible) continue;
      for (int c = 0; c < observation.count; ++c)
        if (used.count(c) == 0) {
          EXPECT_GE(distance2(m, c), kGate);
        }
    }
  }
}

TEST(NameByPrediction, ClosestPairComesFirst) {
  const std::vector<MarkerPrediction> predictions{at({100, 100}), at({103, 100})};
  Observation observation;
  add(observation, {102, 100});
  const Names names = nameByPrediction(predictions, observation, kGate);
  EXPECT_EQ(names[0], -1);
  EXPECT_EQ(names[1], 0);
}

TEST(NameByPrediction, MeasuresDistanceInTheCovariance) {
  MarkerPrediction prediction = at({100, 100});
  prediction.covariance = Vector2d(25.0, 0.25).asDiagonal();
  Observation along, across;
  add(along, {115, 100});
  add(across, {100, 103});
  EXPECT_EQ(nameByPrediction({&prediction, 1}, along, kGate)[0], 0);
  EXPECT_EQ(nameByPrediction({&prediction, 1}, across, kGate)[0], -1);
}

TEST(NameByPrediction, OutsideTheGateIsNobody) {
  const MarkerPrediction prediction = at({100, 100});
  Observation inside, outside;
  add(inside, {100 + std::sqrt(kGate) - 0.01, 100});
  add(outside, {100 + std::sqrt(kGate) + 0.01, 100});
  EXPECT_EQ(nameByPrediction({&prediction, 1}, inside, kGate)[0], 0);
  EXPECT_EQ(nameByPrediction({&prediction, 1}, outside, kGate)[0], -1);
}

TEST(NameByPrediction, RegionOfTwoBallsNamesNobody) {
  const std::vector<MarkerPrediction> predictions{at({100, 100}, 3.0), at({107, 100}, 3.0)};
  Observation merged;
  add(merged, {103, 100}, 2.0 * kDisc);
  const Names names = nameByPrediction(predictions, merged, kGate);
  EXPECT_EQ(names[0], -1);
  EXPECT_EQ(names[1], -1);
}

TEST(NameByPrediction, LargeRegionOfABallThatStandsAloneIsNamed) {
  const std::vector<MarkerPrediction> predictions{at({100, 100}), at({140, 100})};
  Observation observation;
  add(observation, {100, 100}, 2.0 * kDisc);
  EXPECT_EQ(nameByPrediction(predictions, observation, kGate)[0], 0);
}

TEST(NameByPrediction, TouchingBallsThatAreSeenApartKeepTheirNames) {
  const std::vector<MarkerPrediction> predictions{at({100, 100}), at({109, 100})};
  Observation observation;
  add(observation, {109.2, 100});
  add(observation, {99.8, 100});
  const Names names = nameByPrediction(predictions, observation, kGate);
  EXPECT_EQ(names[0], 1);
  EXPECT_EQ(names[1], 0);
}

TEST(NameByPrediction, OrderOfTheCentroidsDoesNotMatter) {
  Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const auto predictions = fourBalls(random);
    Observation observation;
    for (int c = 0; c < 12; ++c)
      add(observation,
          predictions[static_cast<std::size_t>(c % 4)].pixel +
              4.0 * Vector2d(random.normal(), random.normal()),
          kDisc * random.uniform(0.5, 2.0));
    std::array<std::size_t, 12> order;
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = 11; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(i) + 1.0))]);
    Observation permuted;
    for (const std::size_t c : order)
      add(permuted, observation.centroids[c].pixel, observation.centroids[c].area_px);
    const Names names = nameByPrediction(predictions, observation, kGate);
    const Names other = nameByPrediction(predictions, permuted, kGate);
    for (std::size_t m = 0; m < 4; ++m) {
      ASSERT_EQ(names[m] < 0, other[m] < 0);
      if (names[m] >= 0) {
        EXPECT_EQ(names[m], static_cast<int>(order[static_cast<std::size_t>(other[m])]));
      }
    }
  }
}

TEST(NameByPrediction, WithNothingSeenNobodyHasAName) {
  Random random(4);
  const Names names = nameByPrediction(fourBalls(random), Observation{}, kGate);
  EXPECT_TRUE(std::all_of(names.begin(), names.end(), [](int name) { return name == -1; }));
}

}  // namespace
}  // namespace helical
