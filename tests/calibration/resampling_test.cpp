#include "engine/calibration/resampling.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/base/random.h"
#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/exponential.h"
#include "engine/calibration/particle_cloud.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

std::vector<double> randomWeights(Random& random, std::size_t count) {
  std::vector<double> weights(count);
  for (double& w : weights) w = std::pow(random.uniform(), 4.0);
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w /= sum;
  return weights;
}

TEST(SystematicResample, GivesEveryParticleItsShareRoundedUpOrDown) {
  Random random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const auto weights = randomWeights(random, 50);
    std::vector<int> parents(50), children(50, 0);
    systematicResample(weights, random.uniform(), parents);
    for (std::size_t i = 0; i < 50; ++i) {
      EXPECT_GE(parents[i], i > 0 ? parents[i - 1] : 0);
      ++children[static_cast<std::size_t>(parents[i])];
    }
    for (std::size_t i = 0; i < 50; ++i) {
      EXPECT_GE(children[i], std::floor(50 * weights[i] - 1e-9));
      EXPECT_LE(children[i], std::ceil(50 * weights[i] + 1e-9));
    }
  }
}

TEST(SystematicResample, KeepsEqualWeightsAndFollowsASingleOne) {
  std::vector<double> weights(8, 0.125);
  std::vector<int> parents(8);
  systematicResample(weights, 0.5, parents);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(parents[static_cast<std::size_t>(i)], i);
  weights.assign(8, 0.0);
  weights[5] = 1.0;
  systematicResample(weights, 0.0, parents);
  for (const int parent : parents) EXPECT_EQ(parent, 5);
}

TEST(LogWeights, AreNormalisedWithoutOverflowAndNonsenseBecomesEqual) {
  std::vector<double> weights(3);
  normaliseLogWeights(std::vector<double>{-5000.0, -5000.0 + std::log(2.0), -9000.0}, weights);
  EXPECT_NEAR(weights[0], 1.0 / 3.0, 1e-10);
  EXPECT_NEAR(weights[1], 2.0 / 3.0, 1e-10);
  EXPECT_EQ(weights[2], 0.0);
  EXPECT_NEAR(effectiveSampleSize(weights), 1.8, 1e-9);
  const double nothing = -std::numeric_limits<double>::infinity();
  normaliseLogWeights(std::vector<double>{nothing, nothing, nothing}, weights);
  EXPECT_DOUBLE_EQ(weights[1], 1.0 / 3.0);
}

TEST(Exponential, IsExactToTenDigitsAndVanishesFarOut) {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const double x = -std::pow(random.uniform(), 3.0) * 699.0;
    EXPECT_NEAR(expOfNegative(x) / std::exp(x), 1.0, 1e-10) << x;
  }
  EXPECT_EQ(expOfNegative(0.0), 1.0);
  EXPECT_EQ(expOfNegative(-701.0), 0.0);
  EXPECT_EQ(expOfNegative(-std::numeric_limits<double>::infinity()), 0.0);
}

Matrix6d someCovariance(Random& random) {
  Matrix6d root;
  for (double& x : root.reshaped()) x = 0.03 * random.normal();
  return root * root.transpose() + 1e-4 * Matrix6d::Identity();
}

RigidTransform somePose() {
  return {expSO3(Eigen::Vector3d(0.4, -1.1, 0.3)), Eigen::Vector3d(0.2, -0.1, 2.5)};
}

double largestDifference(const Matrix6d& a, const Matrix6d& b) {
  const Vector6d scale = b.diagonal().cwiseSqrt();
  return ((a - b).array() / (scale * scale.transpose()).array()).abs().maxCoeff();
}

TEST(ParticleCloud, IsSeededWithTheMomentsAskedFor) {
  Random random(3);
  const Matrix6d covariance = someCovariance(random);
  ParticleCloud cloud(20000);
  cloud.seed(somePose(), covariance, random);
  const Vector6d off = cameraPerturbation(somePose(), cloud.mean());
  EXPECT_LT(off.dot(covariance.ldlt().solve(off)), 30.0 / 20000.0);
  EXPECT_LT(largestDifference(cloud.moments().covariance, covariance), 0.05);
  EXPECT_NEAR(cloud.effectiveSampleSize(), 20000.0, 1e-6);
}

/// The kernel of Liu and West adds noise and shrinks by what the noise adds.
TEST(ParticleCloud, ResamplingKeepsMeanAndCovariance) {
  Random random(4);
  const int count = 20000;
  for (const double kernel : {0.0, 0.2, 0.5, 0.9}) {
    ParticleCloud cloud(count);
    cloud.seed(somePose(), someCovariance(random), random);
    std::vector<double> log_likelihoods(count);
    for (int i = 0; i < count; ++i) {
      const auto& pose = cloud.poses()[static_cast<std::size_t>(i)].camera_from_world;
      log_likelihoods[static_cast<std::size_t>(i)] =
          8.0 * (pose.inverseTranslation().x() + pose.rotation.x());
    }
    cloud.reweigh(log_likelihoods, 1.0);
    EXPECT_LT(cloud.effectiveSampleSize(), 0.99 * count);
    const RigidTransform mean = cloud.mean();
    const Matrix6d covariance = cloud.moments().covariance;
    cloud.resample(kernel, random);
    const Vector6d off = cameraPerturbation(mean, cloud.mean());
    EXPECT_LT(off.dot(covariance.ldlt().solve(off)), 60.0 / count) << kernel;
    EXPECT_LT(largestDifference(cloud.moments().covariance, covariance), 0.08) << kernel;
    EXPECT_NEAR(cloud.effectiveSampleSize(), count, 1e-6);
  }
}

TEST(ParticleCloud, WeightsSumToOneAndPosesCarryThem) {
  Random random(5);
  ParticleCloud cloud(100);
  cloud.seed(somePose(), someCovariance(random), random);
  std::vector<double> log_likelihoods(100);
  for (double& l : log_likelihoods) l = -10.0 * random.uniform();
  const double expected = cloud.effectiveSampleSizeAfter(log_likelihoods, 0.5);
  cloud.reweigh(log_likelihoods, 0.5);
  EXPECT_DOUBLE_EQ(cloud.effectiveSampleSize(), expected);
  double sum = 0.0;
  for (const WeightedPose& pose : cloud.poses()) sum += pose.weight;
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

}  // namespace
}  // namespace helical
