#include "engine/correspondence/nested_polygons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <vector>

#include "tests/correspondence/random_views.h"

namespace helical {
namespace {

using Eigen::Vector2d;
using testing::ElementsAre;

using Points = std::vector<Vector2d>;

Points randomPoints(Random& random, int count) {
  Points points;
  for (int i = 0; i < count; ++i) points.emplace_back(random.uniform(0, 640), random.uniform(0, 480));
  return points;
}

std::vector<int> sizesOf(const ConvexLayers& layers) {
  return {layers.size.begin(), layers.size.begin() + layers.count};
}

std::vector<Labelling> allOf(NestedLabellings labellings) {
  std::vector<Labelling> all;
  Labelling labelling;
  while (labellings.next(labelling)) all.push_back(labelling);
  return all;
}

bool contains(const std::vector<Labelling>& all, const Labelling& wanted) {
  return std::find(all.begin(), all.end(), wanted) != all.end();
}

TEST(ConvexLayers, PeelsASquareInASquareAndAPairInside) {
  const Points points{{4, 5}, {0, 0}, {10, 0}, {10, 10}, {0, 10}, {2, 2}, {8, 2}, {8, 8}, {2, 8}, {5, 6}};
  const ConvexLayers layers = peelConvexLayers(points);
  EXPECT_THAT(sizesOf(layers), ElementsAre(4, 4, 2));
  EXPECT_THAT(std::vector<int>(layers.index.begin(), layers.index.begin() + 8),
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
}

TEST(ConvexLayers, HoldEveryPointOnceAndOnlyTheLastIsBelowThree) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const int count = 1 + static_cast<int>(random.uniform(0.0, kMaxMarkers));
    const ConvexLayers layers = peelConvexLayers(randomPoints(random, count));
    EXPECT_EQ(layers.points, count);
    const auto sizes = sizesOf(layers);
    EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), 0), count);
    for (std::size_t b = 0; b + 1 < sizes.size(); ++b) EXPECT_GE(sizes[b], 3);
    EXPECT_EQ(std::set<int>(layers.index.begin(), layers.index.begin() + count).size(),
              static_cast<std::size_t>(count));
  }
}

TEST(ConvexLayers, OfPointsOnALineAreItsEndsAgainAndAgain) {
  EXPECT_THAT(sizesOf(peelConvexLayers(Points{{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}})),
              ElementsAre(2, 2, 1));
  EXPECT_THAT(sizesOf(peelConvexLayers(Points{{3, 3}, {3, 3}, {3, 3}})), ElementsAre(1, 1, 1));
}

TEST(NestedLabellings, AreTheProductOfTheLayersWithoutDuplicatesWithinTheoremOne) {
  Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const int count = 3 + trial % (kMaxMarkers - 2);
    const ConvexLayers layers = peelConvexLayers(randomPoints(random, count));
    const auto all = allOf(NestedLabellings(layers, layers, ViewSide::kAbove));
    std::size_t product = 1;
    for (const int size : sizesOf(layers)) product *= static_cast<std::size_t>(size);
    EXPECT_EQ(all.size(), product);
    EXPECT_EQ(NestedLabellings(layers, layers, ViewSide::kAbove).count(), product);
    EXPECT_LE(static_cast<double>(product), theoremOneBound(count) * (1.0 + 1e-12));
    std::set<std::vector<int>> distinct;
    for (const auto& labelling : all) {
      const std::vector<int> markers(labelling.marker.begin(), labelling.marker.begin() + labelling.count);
      EXPECT_TRUE(distinct.insert(markers).second);
      EXPECT_EQ(std::set<int>(markers.begin(), markers.end()).size(), static_cast<std::size_t>(count));
    }
  }
}

TEST(NestedLabellings, HaveBothOrdersOfALeftOverPair) {
  const Points points{{0, 0}, {10, 0}, {5, 9}, {4, 3}, {6, 3}};
  const ConvexLayers layers = peelConvexLayers(points);
  ASSERT_THAT(sizesOf(layers), ElementsAre(3, 2));
  EXPECT_EQ(allOf(NestedLabellings(layers, layers, ViewSide::kBelow)).size(), 6u);
}

TEST(NestedLabellings, HoldTheTrueOneSeenFromAboveWithoutNoise) {
  Random random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const RandomView view = randomView(random, 3 + trial % (kMaxMarkers - 2), 0.0);
    const ConvexLayers layout = peelConvexLayers(view.in_plane), image = peelConvexLayers(view.pixels);
    ASSERT_TRUE(sameShape(layout, image));
    EXPECT_TRUE(contains(allOf(NestedLabellings(layout, image, ViewSide::kAbove)), view.truth)) << trial;
    EXPECT_FALSE(contains(allOf(NestedLabellings(layout, image, ViewSide::kBelow)), view.truth)) << trial;
    const NestedLabellings either(layout, image, ViewSide::kEither);
    const auto both = allOf(either);
    EXPECT_EQ(both.size(), either.count());
    EXPECT_TRUE(contains(both, view.truth));
  }
}

TEST(NestedLabellings, HoldTheTrueOneSeenFromBelow) {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    RandomView view = randomView(random, 3 + trial % (kMaxMarkers - 2), 0.0);
    // A mirror in the image is what the other side of the plane shows.
    for (auto& pixel : view.pixels) pixel.x() = 639.0 - pixel.x();
    const ConvexLayers layout = peelConvexLayers(view.in_plane), image = peelConvexLayers(view.pixels);
    EXPECT_TRUE(contains(allOf(NestedLabellings(layout, image, ViewSide::kBelow)), view.truth)) << trial;
    EXPECT_TRUE(contains(allOf(NestedLabellings(layout, image, ViewSide::kEither)), view.truth)) << trial;
  }
}

TEST(NestedLabellings, AreNoneForLayersOfDifferentShape) {
  const ConvexLayers triangle = peelConvexLayers(Points{{0, 0}, {10, 0}, {5, 9}, {5, 3}});
  const ConvexLayers square = peelConvexLayers(Points{{0, 0}, {10, 0}, {10, 9}, {0, 9}});
  NestedLabellings labellings(triangle, square, ViewSide::kEither);
  Labelling labelling;
  EXPECT_EQ(labellings.count(), 0u);
  EXPECT_FALSE(labellings.next(labelling));
}

TEST(NestedLabellings, CountsOfFullSearchAndBound) {
  EXPECT_DOUBLE_EQ(fullSearchCount(4), 24.0);
  EXPECT_DOUBLE_EQ(fullSearchCount(15), 1307674368000.0);
  EXPECT_DOUBLE_EQ(theoremOneBound(3), 3.0);
  EXPECT_NEAR(theoremOneBound(15), 243.0, 1e-9);
}

}  // namespace
}  // namespace helical
