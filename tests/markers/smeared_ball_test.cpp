// Balls that moved while the shutter was open: thrown ones, mostly.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"
#include "engine/markers/extractor.h"
#include "tests/markers/ball_picture.h"

namespace helical {
namespace {

constexpr int kSmearedBalls = 6;  ///< each with a direction of its own
constexpr int kPictures = 4;

struct Smear {
  double radius = 5.0;
  double lengths = 0.0;  ///< radii of its way
  double noise = 2.0;
  double shading = 0.5;
};

/// Along the motion, or across.
struct SmearErrors {
  double rms = 0.0;    ///< px
  double sigma = 0.0;  ///< px, as the extractor believes
  double nees = 0.0;
  double largest_nees = 0.0;
};

struct BothErrors {
  SmearErrors along, across;
};

void addError(double error, double variance, SmearErrors& errors) {
  constexpr double kShare = 1.0 / (kSmearedBalls * kPictures);
  const double nees = error * error / variance;
  errors.rms += kShare * error * error;
  errors.sigma += kShare * variance;
  errors.nees += kShare * nees;
  errors.largest_nees = std::max(errors.largest_nees, nees);
}

BothErrors measureSmears(const Smear& smear) {
  Random random(7);
  Extractor extractor{MarkerOptions()};
  extractor.disableBackground();
  BothErrors errors;
  for (int place = 0; place < kSmearedBalls; ++place) {
    const double angle = kPi * (place + random.uniform(0.0, 1.0)) / kSmearedBalls;
    const Eigen::Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
    test::BallPicture ball;
    ball.radius = smear.radius;
    ball.shading = smear.shading;
    ball.way_x = smear.lengths * smear.radius * along.x();
    ball.way_y = smear.lengths * smear.radius * along.y();
    ball.side = 2 * static_cast<int>(std::ceil((1.0 + 0.5 * smear.lengths) * smear.radius)) + 25;
    ball.x = ball.side / 2 + random.uniform(-0.5, 0.5);
    ball.y = ball.side / 2 + random.uniform(-0.5, 0.5);
    const std::vector<double> light = test::lightOf(ball);
    for (int k = 0; k < kPictures; ++k) {
      const test::Picture picture = test::exposed(light, ball.side, smear.noise, random);
      Observation found;
      extractor.extract(picture.view(), found);
      if (found.count != 1) {
        ADD_FAILURE() << found.count << " balls";
        return errors;
      }
      const Centroid& centroid = found.centroids[0];
      const Eigen::Vector2d error = centroid.pixel - Eigen::Vector2d(ball.x, ball.y);
      addError(error.dot(along), along.dot(centroid.covariance * along), errors.along);
      addError(error.dot(across), across.dot(centroid.covariance * across), errors.across);
    }
  }
  for (SmearErrors* part : {&errors.along, &errors.across}) {
    part->rms = std::sqrt(part->rms);
    part->sigma = std::sqrt(part->sigma);
  }
  return errors;
}

TEST(SmearedBall, KnowsHowAccurateItIsInEveryDirection) {
  for (const double radius : {3.0, 5.0, 8.0})
    for (const double noise : {2.0, 5.0})
      for (const double shading : {0.0, 0.5})
        for (const double lengths : {0.2, 0.5, 1.0, 2.0, 4.0}) {
          SCOPED_TRACE(testing::Message() << "radius " << radius << ", noise " << noise << ", shading "
                                          << shading << ", smeared over " << lengths << " radii");
          const BothErrors errors = measureSmears({radius, lengths, noise, shading});
          EXPECT_LT(errors.along.nees, 2.5);  // of 24 pictures
          EXPECT_LT(errors.across.nees, 2.5);
          // Not by claiming little: a ball that is not fitted on its way is some tenths of a pixel beside it.
          EXPECT_LT(errors.across.sigma, 0.02 + 0.012 * noise);
          EXPECT_LT(errors.along.sigma, 0.02 + (0.012 + 0.012 * lengths) * noise);
        }
}

TEST(SmearedBall, IsNotTakenForAHiddenOne) {
  for (const double radius : {4.0, 7.0})
    for (const double lengths : {0.35, 0.75, 1.0, 1.5}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", smeared over " << lengths << " radii");
      const BothErrors errors = measureSmears({radius, lengths, 2.0, 0.5});
      EXPECT_LT(errors.across.rms, 0.05);  // a half-hidden disc would be a pixel and more beside it
      EXPECT_LT(errors.along.rms, 0.08);
      EXPECT_LT(errors.along.largest_nees, 25.0);
      EXPECT_LT(errors.across.largest_nees, 25.0);
    }
}

TEST(SmearedBall, IsLessSureAlongItsMotion) {
  const BothErrors errors = measureSmears({8.0, 4.0, 5.0, 0.5});
  EXPECT_GT(errors.along.sigma, 2.0 * errors.across.sigma);
}

TEST(SmearedBall, HardlyMovingIsAsSureAsAtRest) {
  for (const double shading : {0.0, 0.5})
    for (const double radius : {3.0, 8.0}) {
      const BothErrors rest = measureSmears({radius, 0.0, 2.0, shading});
      const BothErrors moving = measureSmears({radius, 0.15, 2.0, shading});
      EXPECT_LT(rest.along.rms, 0.03);
      EXPECT_LT(moving.along.rms, 0.03);
      EXPECT_LT(moving.along.sigma, 1.2 * rest.along.sigma);
      EXPECT_LT(moving.across.sigma, 1.2 * rest.across.sigma);
    }
}

TEST(SmearedBall, LargeAndHalfHiddenKeepsItsCentreOfGravityWhichIsLessSure) {
  Random random(3);
  test::BallPicture ball;
  ball.radius = 20.0;
  ball.side = 101;
  ball.x = ball.y = 50.0;
  ball.way_x = 16.0;
  ball.hidden_from = 5.0;
  ball.hidden_side = 0.7;
  const test::Picture picture = test::drawBall(ball, 2.0, random);
  MarkerOptions options;
  std::array<Observation, 2> found;
  for (const CentroidEstimator estimator : {CentroidEstimator::kBinary, CentroidEstimator::kDisc}) {
    options.estimator = estimator;
    Extractor extractor(options);
    extractor.disableBackground();
    extractor.extract(picture.view(), found[estimator == CentroidEstimator::kDisc ? 1 : 0]);
  }
  ASSERT_EQ(found[1].count, 1);
  EXPECT_EQ(found[1].centroids[0].pixel, found[0].centroids[0].pixel);
  EXPECT_GT(found[1].centroids[0].covariance.trace(), 10.0 * found[0].centroids[0].covariance.trace());
}

}  // namespace
}  // namespace helical
