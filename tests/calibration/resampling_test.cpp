#include "engine/calibration/resampling.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "engine/base/random.h"
#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/particle_cloud.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

std::vector<float> randomWeights(Random& random, std::size_t count) {
  std::vector<float> weights(count);
  for (float& w : weights) w = static_cast<float>(std::pow(random.uniform(), 4.0));
  const float sum = std::accumulate(weights.begin(), weights.end(), 0.0F);
  for (float& w : weights) w /= sum;
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
      EXPECT_GE(children[i], std::floor(50 * weights[i] - 1e-5F));
      EXPECT_LE(children[i], std::ceil(50 * weights[i] + 1e-5F));
    }
  }
}

TEST(SystematicResample, KeepsEqualWeightsAndFollowsASingleOne) {
  std::vector<float> weights(8, 0.125F);
  std::vector<int> parents(8);
  systematicResample(weights, 0.5, parents);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(parents[static_cast<std::size_t>(i)], i);
  weights.assign(8, 0.0F);
  weights[5] = 1.0F;
  systematicResample(weights, 0.0, parents);
  for (const int parent : parents) EXPECT_EQ(parent, 5);
}

TEST(LogWeights, AreNormalisedWithoutOverflowAndNonsenseBecomesEqual) {
  std::vector<float> weights(3);
  EXPECT_EQ(normaliseLogWeights(std::vector<float>{-500.0F, -500.0F + std::log(2.0F), -9000.0F}, weights),
            -500.0F + std::log(2.0F));
  EXPECT_NEAR(weights[0], 1.0 / 3.0, 1e-5);
  EXPECT_NEAR(weights[1], 2.0 / 3.0, 1e-5);
  EXPECT_EQ(weights[2], 0.0F);
  EXPECT_NEAR(effectiveSampleSize(weights), 1.8, 1e-4);
  const float nothing = -std::numeric_limits<float>::infinity();
  EXPECT_EQ(normaliseLogWeights(std::vector<float>{nothing, nothing, nothing}, weights), 0.0F);
  EXPECT_FLOAT_EQ(weights[1], 1.0F / 3.0F);
}

TEST(LogWeights, OfAnyNumberOfParticlesSumToOne) {
  Random random(6);
  for (std::size_t count = 2; count < 70; ++count) {
    std::vector<float> log_weights(count), weights(count);
    for (float& w : log_weights) w = static_cast<float>(random.uniform(-20.0, -5.0));
    log_weights.back() = -1.0F;
    EXPECT_EQ(normaliseLogWeights(log_weights, weights), -1.0F);
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1.0, 1e-6);
    double squares = 0.0;
    for (const float w : weights) squares += static_cast<double>(w) * static_cast<double>(w);
    EXPECT_NEAR(effectiveSampleSize(weights) * squares, 1.0, 1e-6);
  }
}

Matrix6d someCovariance(Random& random) {
  Matrix6d root;
  for (double& x : root.reshaped()) x = 0.03 * random.normal();
  return root * root.transpose() + 1e-4 * Matrix6d::Identity();
}

RigidTransform somePose() {
  return {expSO3(Eigen::Vector3d(0.4, -1.1, 0.3)), Eigen::Vector3d(0.2, -0.1, 2.5)};
}

RigidTransform meanOf(const ParticleCloud& cloud) {
  return cloud.pose(cloud.moments().mean);
}

double largestDifference(const Matrix6d& a, const Matrix6d& b) {
  const Vector6d scale = b.diagonal().cwiseSqrt();
  return ((a - b).array() / (scale * scale.transpose()).array()).abs().maxCoeff();
}

TEST(ParticleCloud, IsSeededWithTheMomentsAskedFor) {
  Random random(3);
  const Matrix6d covariance = someCovariance(random);
  ParticleCloud cloud(20000, 3);
  cloud.seed(somePose(), covariance);
  const Vector6d off = cameraPerturbation(somePose(), meanOf(cloud));
  EXPECT_LT(off.dot(covariance.ldlt().solve(off)), 30.0 / 20000.0);
  EXPECT_LT(largestDifference(cloud.moments().covariance, covariance), 0.05);
  EXPECT_NEAR(cloud.effectiveSampleSize(), 20000.0, 1e-6);
}

/// The kernel of Liu and West adds noise and shrinks by what the noise adds.
TEST(ParticleCloud, ResamplingKeepsMeanAndCovariance) {
  Random random(4);
  const int count = 20000;
  for (const double kernel : {0.0, 0.2, 0.5, 0.9}) {
    ParticleCloud cloud(count, 4);
    cloud.seed(somePose(), someCovariance(random));
    std::vector<float> log_likelihoods(count);
    const auto poses = cloud.poses();
    for (int i = 0; i < count; ++i) {
      const auto& pose = poses[static_cast<std::size_t>(i)].camera_from_world;
      log_likelihoods[static_cast<std::size_t>(i)] =
          static_cast<float>(8.0 * (pose.inverseTranslation().x() + pose.rotation.x()));
    }
    cloud.reweigh(log_likelihoods, 1.0);
    EXPECT_LT(cloud.effectiveSampleSize(), 0.99 * count);
    const RigidTransform mean = meanOf(cloud);
    const Matrix6d covariance = cloud.moments().covariance;
    cloud.resample(kernel);
    const Vector6d off = cameraPerturbation(mean, meanOf(cloud));
    EXPECT_LT(off.dot(covariance.ldlt().solve(off)), 60.0 / count) << kernel;
    EXPECT_LT(largestDifference(cloud.moments().covariance, covariance), 0.08) << kernel;
    EXPECT_NEAR(cloud.effectiveSampleSize(), count, 1e-6);
  }
}

TEST(ParticleCloud, WeightsSumToOneAndPosesCarryThem) {
  Random random(5);
  ParticleCloud cloud(100, 5);
  cloud.seed(somePose(), someCovariance(random));
  std::vector<float> log_likelihoods(100);
  for (float& l : log_likelihoods) l = static_cast<float>(-10.0 * random.uniform());
  const double expected = cloud.effectiveSampleSizeAfter(log_likelihoods, 0.5);
  cloud.reweigh(log_likelihoods, 0.5);
  EXPECT_DOUBLE_EQ(cloud.effectiveSampleSize(), expected);
  double sum = 0.0;
  for (const WeightedPose& pose : cloud.poses()) sum += pose.weight;
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

}  // namespace
}  // namespace helical
