#include "engine/calibration/rig_bundle.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/looking_camera.h"

namespace helical {
namespace {

constexpr double kSigmaPx = 0.1;
constexpr int kCameras = 3, kMoments = 60;

/// Three cameras, the helicopter on its pad in some moments and waved about in the others.
struct Scene {
  explicit Scene(std::uint64_t seed, double marker_error_m = 0.0, double focal_error = 0.0) : random(seed) {
    for (int c = 0; c < kCameras; ++c) {
      truth.push_back(lookingFrom(2.1 * c - 0.5, 0.65 + 0.1 * c, 2.5 + 0.2 * c, 0.3));
      const double f = 567.6;
      models.emplace_back(640, 480, f, f, 319.5, 239.5);
      real.emplace_back(640, 480, f * (1.0 + focal_error), f * (1.0 + focal_error), 319.5, 239.5);
    }
    for (const Eigen::Vector3d& ball : layout.all()) balls.push_back(ball + marker_error_m * normal3());
    for (int i = 0; i < kMoments; ++i) addMoment(i < 8);
    for (int c = 0; c < kCameras; ++c) {
      BundleCamera camera;
      camera.used = true;
      Vector6d off;
      off << 0.05 * normal3(), 0.1 * normal3();
      camera.camera_from_world = perturbCamera(truth[static_cast<std::size_t>(c)], off);
      cameras.push_back(camera);
    }
  }

  Eigen::Vector3d normal3() { return {random.normal(), random.normal(), random.normal()}; }

  void addMoment(bool on_pad) {
    RigMoment& moment = moments.emplace_back();
    RigidTransform pose;
    pose.translation = {0.0, 0.0, 0.06};
    if (!on_pad) {
      pose.translation += Eigen::Vector3d(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(0.1, 0.8));
      pose.rotation = expSO3(0.2 * normal3());
    }
    moment.pose_is_given = on_pad;
    moment.world_from_body = pose;
    if (!on_pad) moment.world_from_body.translation += 0.03 * normal3();
    for (std::size_t c = 0; c < kCameras; ++c) {
      moment.views[c].variance = static_cast<float>(kSigmaPx * kSigmaPx);
      for (std::size_t m = 0; m < balls.size(); ++m) {
        const auto pixel = real[c].project(truth[c] * (pose * balls[m]));
        if (!pixel || !real[c].contains(*pixel)) continue;
        moment.views[c].seen.set(m);
        moment.views[c].pixels[m] =
            (*pixel + kSigmaPx * Eigen::Vector2d(random.normal(), random.normal())).cast<float>();
      }
    }
  }

  Vector6d error(const RigBundle& bundle, std::size_t camera) const {
    return cameraPerturbation(truth[camera], bundle.cameras()[camera].camera_from_world);
  }

  Random random;
  MarkerLayout layout = MarkerLayout::paper();
  std::vector<Eigen::Vector3d> balls;
  std::vector<CameraModel> models, real;
  std::vector<RigidTransform> truth;
  std::vector<RigMoment> moments;
  std::vector<BundleCamera> cameras;
};

void solve(RigBundle& bundle, Scene& scene, const RigBundleOptions& options = {}, int slice = 1000000) {
  bundle.start(scene.moments, scene.cameras, options);
  while (!bundle.advance(slice)) {
  }
}

TEST(RigBundle, FindsAllCamerasAndItsCovarianceIsThatOfItsErrors) {
  double nees = 0.0;
  constexpr int kRuns = 40;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    Scene scene(seed);
    RigBundle bundle(scene.models, scene.layout, kMoments);
    solve(bundle, scene);
    ASSERT_TRUE(bundle.succeeded());
    for (std::size_t c = 0; c < kCameras; ++c) {
      const Vector6d error = scene.error(bundle, c);
      EXPECT_LT(error.tail<3>().norm(), 0.01) << "seed " << seed;
      nees += error.dot(bundle.cameras()[c].covariance.ldlt().solve(error)) / (kRuns * kCameras);
    }
  }
  // Cameras of one run are correlated: wider than for independent ones.
  EXPECT_GT(nees, 4.5);
  EXPECT_LT(nees, 7.5);
}

TEST(RigBundle, InSlicesItIsTheSameToTheLastBit) {
  Scene one(3), other(3);
  RigBundle at_once(one.models, one.layout, kMoments), sliced(other.models, other.layout, kMoments);
  solve(at_once, one);
  solve(sliced, other, {}, 1);
  for (std::size_t c = 0; c < kCameras; ++c)
    EXPECT_EQ(at_once.cameras()[c].camera_from_world.translation, sliced.cameras()[c].camera_from_world.translation);
}

TEST(RigBundle, ABallThatIsNotWhereTheLayoutSaysIsFound) {
  double with = 0.0, without = 0.0, balls = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scene scene(seed, 1e-3);
    for (RigMoment& moment : scene.moments) moment.pose_is_given = false;
    for (std::size_t c = 0; c < 2; ++c) {
      scene.cameras[c].given = true;
      scene.cameras[c].camera_from_world = scene.truth[c];
    }
    const std::vector<RigMoment> moments = scene.moments;
    RigBundle bundle(scene.models, scene.layout, kMoments);
    solve(bundle, scene);
    without += scene.error(bundle, 2).tail<3>().squaredNorm();
    scene.moments = moments;
    RigBundleOptions options;
    options.marker_sigma_m = 2e-3;
    solve(bundle, scene, options);
    ASSERT_TRUE(bundle.succeeded());
    with += scene.error(bundle, 2).tail<3>().squaredNorm();
    // Where all of them are together is the helicopter's pose: compare distances between balls.
    for (std::size_t a = 1; a < scene.balls.size(); ++a)
      balls += std::pow((bundle.markers().all()[a] - bundle.markers().all()[0]).norm() -
                            (scene.balls[a] - scene.balls[0]).norm(),
                        2);
  }
  EXPECT_LT(with, 0.25 * without);
  EXPECT_LT(std::sqrt(balls / 30.0), 3e-4);
}

TEST(RigBundle, AFocalLengthThatIsOffIsFound) {
  Scene scene(4, 0.0, 0.01);
  RigBundle bundle(scene.models, scene.layout, kMoments);
  RigBundleOptions options;
  options.focal_sigma = 0.05;
  solve(bundle, scene, options);
  ASSERT_TRUE(bundle.succeeded());
  for (std::size_t c = 0; c < kCameras; ++c) {
    EXPECT_NEAR(bundle.cameras()[c].focal_scale, 1.01, 5.0 * bundle.cameras()[c].focal_sigma + 1e-4);
    EXPECT_LT(scene.error(bundle, c).tail<3>().norm(), 0.03);
  }
}

TEST(RigBundle, ACameraThatSawSomethingElseStandsOut) {
  Scene scene(5);
  for (RigMoment& moment : scene.moments)
    for (auto& pixel : moment.views[1].pixels)
      pixel += Eigen::Vector2f(static_cast<float>(scene.random.uniform(-30.0, 30.0)),
                               static_cast<float>(scene.random.uniform(-30.0, 30.0)));
  RigBundle bundle(scene.models, scene.layout, kMoments);
  solve(bundle, scene);
  ASSERT_TRUE(bundle.succeeded());
  const auto share = [&](std::size_t c) {
    return static_cast<double>(bundle.cameras()[c].inliers) / bundle.cameras()[c].balls;
  };
  EXPECT_LT(share(1), 0.5);
  EXPECT_GT(share(0), 0.9);
  EXPECT_GT(share(2), 0.9);
  EXPECT_LT(scene.error(bundle, 0).tail<3>().norm(), 0.02);
}

TEST(RigBundle, WithoutAWorldThereIsNoAnswer) {
  Scene scene(6);
  for (RigMoment& moment : scene.moments) moment.pose_is_given = false;
  RigBundle bundle(scene.models, scene.layout, kMoments);
  solve(bundle, scene);
  if (!bundle.succeeded()) return;
  for (std::size_t c = 0; c < kCameras; ++c)
    EXPECT_GT(bundle.cameras()[c].covariance.diagonal().tail<3>().sum(), 1.0) << "as unsure as can be";
}

TEST(RigBundle, RefusesOptionsOutOfRange) {
  RigBundleOptions options;
  options.focal_sigma = -1.0;
  EXPECT_THROW(validate(options), Error);
  options = {};
  options.iterations = 0;
  EXPECT_THROW(validate(options), Error);
}

}  // namespace
}  // namespace helical
