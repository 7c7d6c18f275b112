// Balls that moved while the shutter was open: thrown ones, mostly.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"
#include "engine/markers/extractor.h"
#include "tests/markers/scenes.h"

namespace helical {
namespace {

constexpr int kSide = 90;
constexpr int kMoments = 25;  // of the exposure

struct Smear {
  Eigen::Vector2d middle;
  Eigen::Vector2d along;  ///< direction
  double length = 0.0;    ///< px
  double radius = 0.0;
};

test::Picture drawSmear(const Smear& smear, double noise, Random& random) {
  constexpr std::array<double, 3> kWall{120, 122, 118}, kBall{45, 190, 50};
  test::Picture picture(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      double covered = 0.0;
      for (int k = 0; k < kMoments; ++k) {
        const Eigen::Vector2d centre =
            smear.middle + ((k + 0.5) / kMoments - 0.5) * smear.length * smear.along;
        covered +=
            std::clamp(smear.radius - (Eigen::Vector2d(x, y) - centre).norm() + 0.5, 0.0, 1.0) / kMoments;
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = covered * kBall[c] + (1.0 - covered) * kWall[c] + noise * random.normal();
        picture.pixel(x, y)[c] = static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
      }
    }
  return picture;
}

struct SmearErrors {
  double along_rms = 0.0, across_rms = 0.0;      ///< px
  double along_sigma = 0.0, across_sigma = 0.0;  ///< px, as the extractor believes
  double nees = 0.0;                             ///< per axis
};

SmearErrors measureSmears(double radius, double length, int runs) {
  Random random(7);
  Extractor extractor{MarkerOptions()};
  extractor.disableBackground();
  SmearErrors errors;
  for (int run = 0; run < runs; ++run) {
    const double angle = random.uniform(0.0, kPi);
    const Smear smear{{45.0 + random.uniform(-0.5, 0.5), 45.0 + random.uniform(-0.5, 0.5)},
                      {std::cos(angle), std::sin(angle)},
                      length,
                      radius};
    const test::Picture picture = drawSmear(smear, 2.0, random);
    Observation observation;
    extractor.extract(picture.view(), observation);
    if (observation.count != 1) {
      ADD_FAILURE() << observation.count << " balls";
      return errors;
    }
    const Centroid& found = observation.centroids[0];
    const Eigen::Vector2d error = found.pixel - smear.middle, across(-smear.along.y(), smear.along.x());
    errors.along_rms += std::pow(error.dot(smear.along), 2) / runs;
    errors.across_rms += std::pow(error.dot(across), 2) / runs;
    errors.along_sigma += smear.along.dot(found.covariance * smear.along) / runs;
    errors.across_sigma += across.dot(found.covariance * across) / runs;
    errors.nees += 0.5 * error.dot(found.covariance.inverse() * error) / runs;
  }
  for (double* value : {&errors.along_rms, &errors.across_rms, &errors.along_sigma, &errors.across_sigma})
    *value = std::sqrt(*value);
  return errors;
}

TEST(SmearedBall, StaysInTheMiddleOfItsWayAndIsLessSureAlongIt) {
  for (const double radius : {4.0, 7.0, 12.0})
    for (const double lengths : {2.0, 3.0}) {
      SCOPED_TRACE(testing::Message() << "radius " << radius << ", smeared over " << lengths << " radii");
      const SmearErrors errors = measureSmears(radius, lengths * radius, 40);
      EXPECT_LT(errors.across_rms, 0.2);
      EXPECT_LT(errors.along_rms, 0.3);
      EXPECT_GT(errors.along_sigma, 2.0 * errors.across_sigma);
      EXPECT_LT(errors.nees, 3.0);
    }
}

TEST(SmearedBall, AsLongAsItsRadiusItIsNotTakenForAHiddenOne) {
  for (const double radius : {4.0, 7.0, 12.0}) {
    SCOPED_TRACE(testing::Message() << "radius " << radius);
    const SmearErrors errors = measureSmears(radius, radius, 40);
    EXPECT_LT(errors.across_rms, 0.25);  // a half-hidden disc would be a pixel and more beside it
    EXPECT_LT(errors.along_rms, 0.25);
    EXPECT_LT(errors.nees, 4.0);
  }
}

TEST(SmearedBall, AtRestIsFittedAsADisc) {
  const SmearErrors errors = measureSmears(7.0, 0.0, 40);
  EXPECT_LT(errors.along_rms, 0.03);
  EXPECT_LT(errors.along_sigma, 0.05);
}

}  // namespace
}  // namespace helical
