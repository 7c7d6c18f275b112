#include "engine/geometry/camera_resection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/error.h"
#include "engine/geometry/camera_perturbation.h"
#include "tests/geometry/random_geometry.h"

namespace helical {
namespace {

constexpr ResectionMethod kMethods[] = {ResectionMethod::kGaussNewton, ResectionMethod::kLevenbergMarquardt,
                                        ResectionMethod::kCeres};

CameraModel camera() {
  return CameraModel(640, 480, 567.6, 567.6, 319.5, 239.5, {-0.05, 0.01, 0.0004, -0.0003, 0.0});
}

/// Four balls in each of several poses of a helicopter, seen by a camera 2 to 3 m away.
struct Scene {
  RigidTransform camera_from_world;
  std::vector<WorldPoint> points;
};

Scene randomScene(Random& random, int poses, double sigma_px) {
  Scene scene;
  const double azimuth = random.uniform(-kPi, kPi);
  scene.camera_from_world.rotation =
      expSO3(randomVector(random, 0.2)) * expSO3({toRadians(-130.0), 0, 0}) * expSO3({0, 0, azimuth});
  scene.camera_from_world.translation = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1),
                                         random.uniform(2.0, 3.0)};
  for (int i = 0; i < poses; ++i) {
    const RigidTransform world_from_body{expSO3(randomVector(random, 0.3)), randomVector(random, 0.2)};
    for (const Eigen::Vector3d& marker :
         {Eigen::Vector3d(0.15, 0.12, -0.05), Eigen::Vector3d(-0.13, 0.15, -0.05),
          Eigen::Vector3d(-0.16, -0.11, -0.05), Eigen::Vector3d(0.11, -0.16, -0.05)}) {
      const Eigen::Vector3d in_world = world_from_body * marker;
      scene.points.push_back({in_world, *camera().project(scene.camera_from_world * in_world) +
                                            sigma_px * Eigen::Vector2d(random.normal(), random.normal())});
    }
  }
  return scene;
}

RigidTransform roughly(const RigidTransform& truth, double size, Random& random) {
  Vector6d error;
  error << randomVector(random, size), randomVector(random, size);
  return perturbCamera(truth, error);
}

TEST(CameraPerturbation, IsUndoneByItsInverse) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const RigidTransform from = randomTransform(random);
    Vector6d change;
    change << randomVector(random, 1.5), randomVector(random, 3.0);
    const RigidTransform to = perturbCamera(from, change);
    EXPECT_LT((cameraPerturbation(from, to) - change).norm(), 1e-9);
    EXPECT_LT((to.inverseTranslation() - from.inverseTranslation() - change.tail<3>()).norm(), 1e-12);
  }
}

TEST(CameraResection, HasTheJacobianOfDifferences) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Scene scene = randomScene(random, 1, 5.0);
    for (const auto& point : scene.points) {
      Eigen::Matrix<double, 2, 6> jacobian;
      ASSERT_TRUE(resectionResidual(camera(), point, scene.camera_from_world, &jacobian));
      const Eigen::MatrixXd numeric = numericJacobian(
          [&](const Eigen::VectorXd& change) -> Eigen::VectorXd {
            return *resectionResidual(camera(), point, perturbCamera(scene.camera_from_world, change));
          },
          Vector6d::Zero());
      EXPECT_LT((jacobian - numeric).norm(), 1e-5 * numeric.norm());
    }
  }
}

TEST(CameraResection, IsExactWithoutNoiseByEveryMethod) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Scene scene = randomScene(random, 3, 0.0);
    const RigidTransform guess = roughly(scene.camera_from_world, 0.05, random);
    for (const auto method : kMethods) {
      ResectionOptions options;
      options.method = method;
      const Resection found = resectCamera(camera(), scene.points, guess, options);
      EXPECT_EQ(found.status, ResectionStatus::kConverged);
      EXPECT_LT(cameraPerturbation(scene.camera_from_world, found.camera_from_world).norm(), 1e-6);
      EXPECT_LT(found.rms_px, 1e-4);
      EXPECT_EQ(found.inliers, 12);
    }
  }
}

TEST(CameraResection, MethodsAgreeUnderNoiseAndOutliers) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    Scene scene = randomScene(random, 5, 0.5);
    for (const double scale : {0.0, 4.0}) {
      if (scale > 0.0) scene.points[7].pixel += Eigen::Vector2d(60, -40);
      const RigidTransform guess = roughly(scene.camera_from_world, 0.005, random);
      ResectionOptions options;
      options.robust_scale_px = scale;
      options.method = ResectionMethod::kCeres;
      const Resection ceres = resectCamera(camera(), scene.points, guess, options);
      for (const auto method : {ResectionMethod::kGaussNewton, ResectionMethod::kLevenbergMarquardt}) {
        options.method = method;
        const Resection found = resectCamera(camera(), scene.points, guess, options);
        EXPECT_EQ(found.status, ResectionStatus::kConverged);
        EXPECT_NEAR(found.cost_px2, ceres.cost_px2, 1e-6 * ceres.cost_px2);
        EXPECT_LT(cameraPerturbation(ceres.camera_from_world, found.camera_from_world).norm(), 1e-5);
        EXPECT_LT((found.covariance - ceres.covariance).norm(), 1e-3 * ceres.covariance.norm());
        EXPECT_EQ(found.inliers, ceres.inliers);
      }
      if (scale > 0.0) {
        EXPECT_EQ(ceres.inliers, 19) << "the outlier is none of them";
      }
    }
  }
}

TEST(CameraResection, CovarianceIsThatOfTheErrors) {
  Random random(5);
  constexpr int kTrials = 1000;
  double sum = 0.0;
  for (int i = 0; i < kTrials; ++i) {
    const Scene scene = randomScene(random, 8, 0.5);
    const Resection found = resectCamera(camera(), scene.points, scene.camera_from_world);
    const Vector6d error = cameraPerturbation(found.camera_from_world, scene.camera_from_world);
    sum += error.dot(found.covariance.inverse() * error);
  }
  // Mean of chi^2 with 6 degrees of freedom, +-5 sigma of the mean.
  EXPECT_NEAR(sum / kTrials, 6.0, 5.0 * std::sqrt(12.0 / kTrials));
}

TEST(CameraResection, ConvergesFromAFarGuessOnSeveralFrames) {
  Random random(6);
  constexpr int kTrials = 200;
  int right = 0;
  for (int i = 0; i < kTrials; ++i) {
    const Scene scene = randomScene(random, 8, 0.5);
    const Resection found =
        resectCamera(camera(), scene.points, roughly(scene.camera_from_world, 0.2, random));
    right += cameraPerturbation(scene.camera_from_world, found.camera_from_world).norm() < 0.1;
  }
  EXPECT_GE(right, kTrials * 95 / 100);
}

TEST(CameraResection, SaysWhatItCannotDo) {
  Random random(7);
  const Scene scene = randomScene(random, 1, 0.0);
  for (const auto method : kMethods) {
    ResectionOptions options;
    options.method = method;
    const auto solve = [&](const std::vector<WorldPoint>& points, const RigidTransform& guess) {
      return resectCamera(camera(), points, guess, options).status;
    };
    const auto& points = scene.points;
    EXPECT_EQ(solve({points[0], points[1]}, scene.camera_from_world), ResectionStatus::kDegenerate);
    EXPECT_EQ(solve({points[0], points[0], points[0]}, scene.camera_from_world),
              ResectionStatus::kDegenerate);
    const RigidTransform away{expSO3({kPi, 0, 0}) * scene.camera_from_world.rotation,
                              expSO3({kPi, 0, 0}) * scene.camera_from_world.translation};
    EXPECT_EQ(solve(points, away), ResectionStatus::kDiverged) << "everything is behind the camera";
  }
}

TEST(CameraResection, RefusesOptionsOutOfRange) {
  ResectionOptions options;
  EXPECT_NO_THROW(validate(options));
  options.max_iterations = 0;
  EXPECT_THROW(validate(options), Error);
  options = {};
  options.robust_scale_px = -1.0;
  EXPECT_THROW(validate(options), Error);
  options = {};
  options.sigma_px = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(validate(options), Error);
}

}  // namespace
}  // namespace helical
