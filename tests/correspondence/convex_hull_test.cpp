#include "engine/correspondence/convex_hull.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "engine/base/random.h"

namespace helical {
namespace {

using Eigen::Vector2d;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<int> hullOf(const std::vector<Vector2d>& points) {
  const HullOrder hull = convexHull(points);
  return {hull.index.begin(), hull.index.begin() + hull.count};
}

double cross(const Vector2d& o, const Vector2d& a, const Vector2d& b) {
  return (a - o).x() * (b - o).y() - (a - o).y() * (b - o).x();
}

/// A point is a strict vertex if no segment and no triangle of others holds it; for points in general
/// position that is: all others lie within less than half a turn around it.
bool isVertex(const std::vector<Vector2d>& points, std::size_t i) {
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (j == i) continue;
    bool all_left = true;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k != i && k != j && cross(points[i], points[j], points[k]) <= 0.0) all_left = false;
    if (all_left) return true;
  }
  return false;
}

std::vector<Vector2d> randomPoints(Random& random, int count) {
  std::vector<Vector2d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(random.uniform(-50, 700), random.uniform(-50, 500));
  return points;
}

TEST(ConvexHull, HoldsThePointsThatHaveAllOthersOnOneSide) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const auto points = randomPoints(random, 3 + static_cast<int>(random.uniform(0.0, 30.0)));
    std::set<int> expected;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (isVertex(points, i)) expected.insert(static_cast<int>(i));
    const auto hull = hullOf(points);
    EXPECT_EQ(std::set<int>(hull.begin(), hull.end()), expected);
    EXPECT_EQ(hull.size(), expected.size()) << "no vertex twice";
  }
}

TEST(ConvexHull, TurnsFromXToY) {
  Random random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const auto points = randomPoints(random, 12);
    const auto hull = hullOf(points);
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const auto at = [&](std::size_t i) { return points[static_cast<std::size_t>(hull[i % hull.size()])]; };
      EXPECT_GT(cross(at(k), at(k + 1), at(k + 2)), 0.0);
    }
  }
}

TEST(ConvexHull, LeavesOutPointsOnAnEdge) {
  EXPECT_THAT(hullOf({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}, {0, 1}}), ElementsAre(0, 2, 3, 5));
}

TEST(ConvexHull, OfCollinearPointsIsTheirEnds) {
  EXPECT_THAT(hullOf({{1, 1}, {3, 3}, {0, 0}, {2, 2}}), ElementsAre(2, 1));
  EXPECT_THAT(hullOf({{5, 3}, {5, 1}, {5, 2}}), ElementsAre(1, 0));
}

TEST(ConvexHull, CountsPointsOfOnePlaceOnce) {
  std::vector<Vector2d> square;
  for (int twice = 0; twice < 2; ++twice)
    for (const Vector2d& corner : {Vector2d(0, 0), Vector2d(4, 0), Vector2d(4, 3), Vector2d(0, 3)})
      square.push_back(corner);
  const auto hull = hullOf(square);
  ASSERT_EQ(hull.size(), 4u);
  std::set<int> corners;
  for (const int i : hull) corners.insert(i % 4);
  EXPECT_EQ(corners.size(), 4u);
  EXPECT_EQ(hullOf({{2, 5}, {2, 5}}).size(), 1u);
  EXPECT_EQ(hullOf({{2, 5}, {2, 5}, {2, 5}}).size(), 1u);
  EXPECT_EQ(hullOf({{2, 5}, {2, 5}, {1, 5}}).size(), 2u);
}

TEST(ConvexHull, OfNoneOneAndTwoPointsIsThey) {
  EXPECT_THAT(hullOf({}), IsEmpty());
  EXPECT_THAT(hullOf({{7, 8}}), ElementsAre(0));
  EXPECT_THAT(hullOf({{7, 8}, {1, 9}}), ElementsAre(1, 0));
}

TEST(ConvexHull, TakesAsManyPointsAsAFrameHasCentroids) {
  std::vector<Vector2d> circle;
  for (int i = 0; i < kMaxHullPoints; ++i)
    circle.emplace_back(std::cos(2.0 * 3.14159 * i / kMaxHullPoints),
                        std::sin(2.0 * 3.14159 * i / kMaxHullPoints));
  EXPECT_EQ(hullOf(circle).size(), circle.size());
}

}  // namespace
}  // namespace helical
