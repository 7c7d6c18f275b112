#include "engine/simulator/disturbances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr CameraId kCamera = cameraId(1);
const RigidTransform kPose{expSO3({1.9, 0.4, -0.2}), {0.1, 0.2, 2.8}};

CameraDisturbances disturbed(const SimulationOptions& options, std::uint64_t seed = 1) {
  return {kCamera, options, kPose, Random(seed)};
}

TEST(CameraDisturbances, LeaveAQuietCameraAlone) {
  SimulationOptions options;
  options.occlusions = {{cameraId(0), 1.0, 5.0}};
  options.bumps = {{cameraId(2), 1.0, 0.5, 0.1}};
  const CameraDisturbances quiet = disturbed(options);
  for (double t = 0.0; t < 6.0; t += 0.1) {
    EXPECT_EQ(quiet.boardCover(t), 0.0);
    EXPECT_EQ(quiet.cameraFromWorld(t).translation, kPose.translation);
  }
}

TEST(CameraDisturbances, BoardSlidesInAndOut) {
  SimulationOptions options;
  options.occlusions = {{kCamera, 2.0, 4.0}};
  const CameraDisturbances covered = disturbed(options);
  EXPECT_EQ(covered.boardCover(1.99), 0.0);
  EXPECT_NEAR(covered.boardCover(2.125), 0.5, 1e-9);
  EXPECT_EQ(covered.boardCover(2.25), 1.0);
  EXPECT_EQ(covered.boardCover(4.0), 1.0);
  EXPECT_NEAR(covered.boardCover(4.125), 0.5, 1e-9);
  EXPECT_EQ(covered.boardCover(4.26), 0.0);
  for (double t = 1.0; t < 5.0; t += 0.01)
    EXPECT_LE(std::abs(covered.boardCover(t + 0.01) - covered.boardCover(t)), 0.04 + 1e-9) << "it slides";
}

TEST(CameraDisturbances, SeveralBoardsCoverLikeTheWidest) {
  SimulationOptions options;
  options.occlusions = {{kCamera, 2.0, 4.0}, {kCamera, 3.9, 6.0}};
  const CameraDisturbances covered = disturbed(options);
  EXPECT_EQ(covered.boardCover(3.0), 1.0);
  EXPECT_EQ(covered.boardCover(5.0), 1.0);
  EXPECT_GT(covered.boardCover(4.1), 0.5);
}

TEST(CameraDisturbances, KnockTurnsAndShiftsByWhatWasAskedFor) {
  SimulationOptions options;
  options.bumps = {{kCamera, 7.0, 0.1, 0.02}, {kCamera, 3.0, 0.2, 0.05}};
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const CameraDisturbances knocked = disturbed(options, seed);
    const RigidTransform before = knocked.cameraFromWorld(2.999), once = knocked.cameraFromWorld(3.0),
                         same = knocked.cameraFromWorld(6.999), twice = knocked.cameraFromWorld(7.0);
    EXPECT_EQ(before.translation, kPose.translation);
    EXPECT_NEAR(before.rotation.angularDistance(once.rotation), 0.2, 1e-9);
    EXPECT_NEAR((before.inverseTranslation() - once.inverseTranslation()).norm(), 0.05, 1e-9);
    EXPECT_EQ(same.translation, once.translation);
    EXPECT_NEAR(once.rotation.angularDistance(twice.rotation), 0.1, 1e-9);
    EXPECT_NEAR((once.inverseTranslation() - twice.inverseTranslation()).norm(), 0.02, 1e-9);
  }
}

TEST(CameraDisturbances, KnockAcrossTurnsTheLineOfSight) {
  SimulationOptions options;
  options.bumps = {{kCamera, 3.0, 0.2, 0.0, true}};
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const CameraDisturbances knocked = disturbed(options, seed);
    const Eigen::Quaterniond before = knocked.cameraFromWorld(2.9).rotation,
                             after = knocked.cameraFromWorld(3.0).rotation;
    const Eigen::Vector3d sight = before.conjugate() * Eigen::Vector3d::UnitZ();
    EXPECT_NEAR((after * sight).dot(Eigen::Vector3d::UnitZ()), std::cos(0.2), 1e-9);
  }
}

TEST(CameraDisturbances, EverySeedKnocksAnotherWay) {
  SimulationOptions options;
  options.bumps = {{kCamera, 3.0, 0.2, 0.05}};
  EXPECT_EQ(disturbed(options, 4).cameraFromWorld(4.0).translation,
            disturbed(options, 4).cameraFromWorld(4.0).translation);
  EXPECT_NE(disturbed(options, 4).cameraFromWorld(4.0).translation,
            disturbed(options, 5).cameraFromWorld(4.0).translation);
}

}  // namespace
}  // namespace helical
