#include "engine/markers/disc_fit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/markers/cell_kernels.h"
#include "engine/markers/reference_extractor.h"
#include "tests/markers/ball_picture.h"

namespace helical {
namespace {

using test::BallPicture;

struct Errors {
  double rms = 0.0;  ///< px per axis
  double binary_rms = 0.0;
  double nees = 0.0;  ///< per axis
  double seen_share = 0.0;
  int failed = 0;
};

Errors measure(BallPicture ball, double noise, int runs) {
  Random random(11);
  DiscFit fit;
  Errors errors;
  int fitted = 0;
  for (int run = 0; run < runs; ++run) {
    ball.x = 20.0 + random.uniform(-0.5, 0.5);
    ball.y = 20.0 + random.uniform(-0.5, 0.5);
    const test::Picture picture = test::drawBall(ball, noise, random);
    const auto regions = referenceRegions(picture.view(), nullptr, {}, {});
    const auto largest = std::max_element(regions.begin(), regions.end(),
                                          [](const Region& a, const Region& b) { return a.area < b.area; });
    if (largest == regions.end()) return {};
    const Eigen::Vector2d truth(ball.x, ball.y);
    const auto area = static_cast<double>(largest->area);
    const Eigen::Vector2d binary(static_cast<double>(largest->sum_x) / area,
                                 static_cast<double>(largest->sum_y) / area);
    const auto disc = fit.fit(CellGrid(picture.view()), *largest);
    if (!disc) {
      ++errors.failed;
      continue;
    }
    const Eigen::Vector2d error = disc->centre - truth;
    errors.rms += 0.5 * error.squaredNorm();
    errors.binary_rms += 0.5 * (binary - truth).squaredNorm();
    errors.nees += 0.5 * error.dot(disc->covariance.inverse() * error);
    errors.seen_share += disc->seen_share;
    ++fitted;
  }
  errors.rms = std::sqrt(errors.rms / fitted);
  errors.binary_rms = std::sqrt(errors.binary_rms / fitted);
  errors.nees /= fitted;
  errors.seen_share /= fitted;
  return errors;
}

TEST(DiscFit, IsManyTimesAsAccurateAsACentreOfGravity) {
  for (const double radius : {3.0, 5.0, 8.0})
    for (const double shading : {0.0, 0.5}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", shading " << shading);
      const Errors errors = measure({0, 0, radius, shading}, 2.0, 150);
      EXPECT_LE(errors.failed, 1);  // of 150, given back to the centre of gravity
      EXPECT_LT(errors.rms, 0.15 * errors.binary_rms);
      // White noise alone: per axis at best sigma / contrast / sqrt(pi radius / 2).
      EXPECT_LT(errors.rms, 3.0 * 2.0 / 120.0 / std::sqrt(0.5 * 3.14159 * radius));
    }
}

TEST(DiscFit, KnowsHowAccurateItIs) {
  for (const double radius : {3.0, 5.0, 8.0})
    for (const double noise : {2.0, 5.0}) {
      const Errors errors = measure({0, 0, radius, 0.5}, noise, 150);
      EXPECT_GT(errors.nees, 0.6) << radius << " " << noise;
      EXPECT_LT(errors.nees, 1.7) << radius << " " << noise;
      EXPECT_GT(errors.seen_share, 0.95);
    }
}

TEST(DiscFit, StandsAQuarterHidden) {
  for (const double radius : {5.0, 8.0}) {
    BallPicture ball{0, 0, radius, 0.5};
    ball.hidden_from = 0.404 * radius;  // a quarter of its area
    const Errors errors = measure(ball, 2.0, 150);
    EXPECT_LE(errors.failed, 1);  // of 150, given back to the centre of gravity
    EXPECT_LT(errors.rms, 0.05) << radius;
    EXPECT_GT(errors.binary_rms, 0.5) << radius;
    EXPECT_NEAR(errors.seen_share, 0.75, 0.06) << radius;
    EXPECT_LT(errors.nees, 2.5) << radius;
  }
}

TEST(DiscFit, StandsAPartOfASmallBallHiddenFromAnySide) {
  for (const double side : {0.0, 0.5, 1.4, 2.6, 4.0, 5.5})
    for (const double from : {0.7, 0.404}) {
      SCOPED_TRACE(testing::Message() << "hidden from " << from << " radii on, towards " << side);
      BallPicture ball{0, 0, 3.0, 0.5};
      ball.hidden_from = from * ball.radius;
      ball.hidden_side = side;
      const Errors errors = measure(ball, 2.0, 60);
      EXPECT_EQ(errors.failed, 0);
      EXPECT_LT(errors.rms, 0.06);  // of circles that cover what is seen, one in ten is 0.7 px beside it
      EXPECT_GT(errors.binary_rms, 0.1);
      EXPECT_NEAR(errors.seen_share, from > 0.5 ? 0.905 : 0.75, 0.07);
    }
}

TEST(DiscFit, RepeatsBitForBitInEveryInstructionSet) {
  std::vector<Disc> expected;
  for (const std::string& name : instructionSets()) {
    useInstructionSet(name);
    Random same(5);
    DiscFit fit;
    std::vector<Disc> found;
    for (int i = 0; i < 20; ++i) {
      BallPicture ball{20.0 + same.uniform(-0.5, 0.5), 20.0 + same.uniform(-0.5, 0.5), same.uniform(2.5, 9.0),
                       0.5};
      if (i % 2 == 1) ball.hidden_from = 0.4 * ball.radius;
      if (i % 4 == 2) ball.way_x = ball.radius, ball.way_y = 0.5 * ball.radius;
      const test::Picture picture = test::drawBall(ball, 3.0, same);
      for (const Region& region : referenceRegions(picture.view(), nullptr, {}, {}))
        if (const auto disc = fit.fit(CellGrid(picture.view()), region)) found.push_back(*disc);
    }
    if (expected.empty()) expected = found;
    ASSERT_EQ(found.size(), expected.size()) << name;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].centre, expected[i].centre) << name;
      EXPECT_EQ(found[i].covariance, expected[i].covariance) << name;
      EXPECT_EQ(found[i].radius, expected[i].radius) << name;
    }
  }
  useInstructionSet({});
  EXPECT_GE(expected.size(), 18U);
}

TEST(DiscFit, RefusesWhatIsNoBall) {
  test::Picture picture(200, 60);
  picture.fill(120, 120, 120);
  for (int x = 40; x < 160; ++x)
    for (int y = 28; y < 33; ++y) {
      std::uint8_t* p = picture.pixel(x, y);
      p[0] = 45, p[1] = 190, p[2] = 50;
    }
  DiscFit fit;
  const auto regions = referenceRegions(picture.view(), nullptr, {}, {});
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_FALSE(fit.fit(CellGrid(picture.view()), regions[0]).has_value());
}

TEST(DiscFit, RefusesABallWithAPattern) {
  Random random(9);
  test::Picture picture = test::drawBall({20.0, 20.0, 12.0, 0.2}, 2.0, random);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      std::uint8_t* p = picture.pixel(x, y);
      if (p[1] > p[2] + 40 && (x / 4 + y / 4) % 2 == 0) p[1] = static_cast<std::uint8_t>(p[1] - 50);
    }
  DiscFit fit;
  const auto regions = referenceRegions(picture.view(), nullptr, {}, {});
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_FALSE(fit.fit(CellGrid(picture.view()), regions[0]).has_value());
}

}  // namespace
}  // namespace helical
