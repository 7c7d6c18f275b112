#include "engine/calibration/step_detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kFocalPx = 567.6, kDistanceM = 2.7, kRateHz = 60.0;
constexpr int kBalls = 4;
constexpr double kNear = 0.02;  // of false centroids

/// Cameras in a ring around a helicopter that moves like one: positions by three slow oscillations, image offsets
/// that change slowly, white noise, outliers. Cameras take their frames one after the other.
class Scene {
 public:
  explicit Scene(int cameras, std::uint64_t seed, double sigma_px = 0.08) : random_(seed), sigma_px_(sigma_px) {
    for (int c = 0; c < cameras; ++c) {
      const double azimuth = toRadians(-65.0 + 125.0 * c), elevation = toRadians(40.0);
      const Eigen::Vector3d z(-std::cos(azimuth) * std::cos(elevation), -std::sin(azimuth) * std::cos(elevation),
                              -std::sin(elevation));
      const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
      Eigen::Matrix<double, 2, 3> d_world;
      d_world << x.transpose(), z.cross(x).transpose();
      d_world_.push_back(kFocalPx / kDistanceM * d_world);
    }
    offsets_.assign(static_cast<std::size_t>(cameras * kBalls), Eigen::Vector2d::Zero());
    steps_.assign(static_cast<std::size_t>(cameras), Eigen::Vector2d::Zero());
    for (Eigen::Vector3d& phase : phases_) phase = {random_.uniform(0, 6), random_.uniform(0, 6), random_.uniform(0, 6)};
  }

  /// All cameras' next frames. The camera that is found knocked, or -1.
  int next(double outliers = 0.0) {
    ++frame_;
    int found = -1;
    for (std::size_t c = 0; c < d_world_.size(); ++c) {
      const double time = (static_cast<double>(frame_) + static_cast<double>(c % 3) / 3.0) / kRateHz;
      NamedBalls balls;
      balls.exposure = fromSeconds(time);
      balls.variance = static_cast<float>(sigma_px_ * sigma_px_);
      for (std::size_t m = 0; m < kBalls; ++m) {
        Eigen::Vector2d& offset = offsets_[kBalls * c + m];
        offset += -offset / kRateHz + 0.08 * std::sqrt(2.0 / kRateHz) * noise();
        Eigen::Vector2d pixel = d_world_[c] * place(time) + 40.0 * Eigen::Vector2d(m % 2, m / 2) + steps_[c] + offset +
                                unrest_ * sigma_px_ * noise();
        // Most false centroids lie nowhere near the ball: then it has none.
        const bool thrown = random_.uniform() < outliers, near = random_.uniform() < kNear;
        if (thrown && !near) continue;
        if (thrown) pixel += Eigen::Vector2d(random_.uniform(-5, 5), random_.uniform(-5, 5));
        balls.seen.set(m);
        balls.pixels[m] = (pixel + Eigen::Vector2d(300.0, 200.0)).cast<float>();
      }
      if (const int moved = detector_.add(cameraId(static_cast<int>(c)), balls, d_world_[c]); moved >= 0) found = moved;
    }
    return found;
  }

  void knock(std::size_t camera, double px, double direction) {
    steps_[camera] += px * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  }
  /// Standard deviation of the centroids over what they claim.
  void disturb(double unrest) { unrest_ = unrest; }
  /// Its speed changes at once, as when it touches down [m/s].
  void jolt(const Eigen::Vector3d& by) {
    jolt_ = by;
    jolted_at_s_ = static_cast<double>(frame_ + 1) / kRateHz;
  }

 private:
  Eigen::Vector2d noise() { return {random_.normal(), random_.normal()}; }
  Eigen::Vector3d place(double time) const {
    Eigen::Vector3d sum = std::max(0.0, time - jolted_at_s_) * jolt_;
    const std::array<double, 3> size{0.05, 0.01, 0.003}, speed{1.0, 3.0, 9.0};
    for (std::size_t k = 0; k < 3; ++k)
      sum += size[k] * (speed[k] * time * Eigen::Vector3d::Ones() + phases_[k]).array().sin().matrix();
    return sum;
  }

  Random random_;
  double sigma_px_, unrest_ = 1.0;
  StepDetector detector_;
  std::vector<Eigen::Matrix<double, 2, 3>> d_world_;
  std::vector<Eigen::Vector2d> offsets_, steps_;
  std::array<Eigen::Vector3d, 3> phases_;
  Eigen::Vector3d jolt_ = Eigen::Vector3d::Zero();
  double jolted_at_s_ = 0.0;
  long frame_ = 0;
};

TEST(StepDetector, NamesTheCameraThatMovedByHalfAPixel) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Scene scene(3, seed);
    for (int f = 0; f < 40; ++f) ASSERT_EQ(scene.next(), -1) << "seed " << seed;
    const std::size_t knocked = seed % 3;
    scene.knock(knocked, 0.5, 0.37 * static_cast<double>(seed));
    int named = -1;
    for (int f = 0; f < 12 && named < 0; ++f) named = scene.next();
    EXPECT_TRUE(named < 0 || named == static_cast<int>(knocked)) << "seed " << seed;
    found += named == static_cast<int>(knocked);
  }
  EXPECT_GE(found, 95);
}

TEST(StepDetector, FindsTwoPixelsInFourFrames) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Scene scene(3, seed);
    for (int f = 0; f < 40; ++f) scene.next();
    scene.knock(1, 2.0, static_cast<double>(seed));
    int named = -1;
    for (int f = 0; f < 4 && named < 0; ++f) named = scene.next();
    EXPECT_EQ(named, 1) << "seed " << seed;
  }
}

TEST(StepDetector, BearsOutliersAndMotionForFiveMinutes) {
  Scene scene(3, 7);
  for (long f = 0; f < 60L * 60L * 5L; ++f) ASSERT_EQ(scene.next(0.1), -1) << "frame " << f;
}

/// Before that is learnt. With the alarm of three calm cameras four are named.
TEST(StepDetector, BearsMomentsOfMoreNoiseWithEightCameras) {
  int named = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    Scene scene(8, seed);
    scene.disturb(1.15);
    for (int f = 0; f < 40; ++f) named += scene.next() >= 0;
  }
  EXPECT_LE(named, 1);
}

TEST(StepDetector, AJoltOfTheHelicopterIsNoKnock) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Scene scene(3, seed);
    Random random(seed);
    for (int f = 0; f < 40; ++f) scene.next();
    scene.jolt(0.2 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
    for (int f = 0; f < 40; ++f) EXPECT_EQ(scene.next(), -1) << "seed " << seed;
  }
}

TEST(StepDetector, OfTwoCamerasNoneIsNamed) {
  Scene scene(2, 3);
  for (int f = 0; f < 40; ++f) scene.next();
  scene.knock(0, 3.0, 1.0);
  for (int f = 0; f < 40; ++f) EXPECT_EQ(scene.next(), -1);
}

}  // namespace
}  // namespace helical
