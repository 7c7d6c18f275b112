#include "engine/calibration/marginal_resection.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <vector>

#include "engine/calibration/camera_perturbation.h"
#include "engine/calibration/pose_modes.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/training_flight.h"

namespace helical {
namespace {

using test::flyForTraining;
using test::TrainingFlight;

FrameStore storeOf(const TrainingFlight& flight, int capacity) {
  FrameStore store(capacity);
  for (const auto& frame : flight.frames) store.add(frame.view());
  return store;
}

TEST(Perturbation, UndoesItselfAndHasTheJacobianItClaims) {
  const TrainingFlight flight = flyForTraining(1, {.duration_s = 0.1});
  const RigidTransform& camera = flight.camera_from_world;
  const RigidTransform& body = flight.frames[0].true_world_from_body;
  const Eigen::Vector3d marker = flight.markers.inBody(markerId(2));
  Vector6d change;
  change << 0.1, -0.2, 0.05, 0.3, 0.1, -0.4;
  EXPECT_LT((cameraPerturbation(camera, perturbCamera(camera, change)) - change).norm(), 1e-12);

  const auto at = [&](const Vector6d& of_camera, const Vector6d& of_pose) {
    const RigidTransform moved{body.rotation * expSO3(of_pose.tail<3>()),
                               body.translation + of_pose.head<3>()};
    return projectMarker(flight.camera, perturbCamera(camera, of_camera), moved, marker)->pixel;
  };
  const auto projection = projectMarker(flight.camera, camera, body, marker);
  ASSERT_TRUE(projection.has_value());
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = 1e-6 * Vector6d::Unit(i);
    const Vector6d zero = Vector6d::Zero();
    EXPECT_LT(((at(step, zero) - at(-step, zero)) / 2e-6 - projection->d_camera.col(i)).norm(), 1e-3);
    EXPECT_LT(((at(zero, step) - at(zero, -step)) / 2e-6 - projection->d_pose.col(i)).norm(), 1e-3);
  }
}

TEST(Resect, FindsTheCameraFromCleanPixelsExactly) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TrainingFlight flight = flyForTraining(seed, {.duration_s = 4.0,
                                                        .sigma_px = 1e-3,
                                                        .drop_outs = 0.1,
                                                        .outliers = 0.0,
                                                        .pose_position_sigma_m = 0.0,
                                                        .pose_rotation_sigma_rad = 0.0});
    const FrameStore store = storeOf(flight, 40);
    const MarginalResection solution =
        resect(flight.camera, flight.markers, store.frames(), flight.guess, {.iterations = 60});
    ASSERT_TRUE(solution.ok);
    EXPECT_LT(test::positionError(solution.camera_from_world, flight.camera_from_world), 1e-4);
  }
}

/// Normalised squared errors over many flights: the information is true, also about the helicopter's pose.
TEST(Resect, KnowsHowGoodItIs) {
  double sum = 0.0;
  constexpr int kFlights = 60;
  for (std::uint64_t seed = 0; seed < kFlights; ++seed) {
    const TrainingFlight flight =
        flyForTraining(seed, {.duration_s = 5.0, .outliers = 0.0, .pose_position_sigma_m = 0.003});
    const FrameStore store = storeOf(flight, 60);
    const MarginalResection solution =
        resect(flight.camera, flight.markers, store.frames(), flight.camera_from_world, {.iterations = 30});
    const Vector6d error = cameraPerturbation(flight.camera_from_world, solution.camera_from_world);
    sum += error.dot(solution.information * error) / 6.0;
  }
  // 360 squared normal deviates: 0.75 to 1.25 is 3.3 standard deviations, the robust weight costs some more.
  EXPECT_GT(sum / kFlights, 0.7);
  EXPECT_LT(sum / kFlights, 1.35);
}

TEST(Resect, IsNotOkWithoutEnoughToGoOn) {
  const TrainingFlight flight = flyForTraining(2, {.duration_s = 0.1, .drop_outs = 0.0});
  EXPECT_FALSE(resect(flight.camera, flight.markers, {}, flight.guess, {}).ok);
  StoredFrame two = stored(flight.frames[0].view());
  two.count = 2;
  const std::array<const StoredFrame*, 1> frames{&two};
  EXPECT_FALSE(resect(flight.camera, flight.markers, frames, flight.guess, {}).ok);
}

TEST(MirroredPose, IsItsOwnInverseAndProjectsAlmostAlike) {
  const TrainingFlight flight = flyForTraining(3, {.duration_s = 0.1});
  const RigidTransform& body = flight.frames[0].true_world_from_body;
  const RigidTransform mirrored = mirroredPose(flight.camera_from_world, body, flight.markers);
  EXPECT_GT(test::orientationError(mirrored, flight.camera_from_world), toRadians(20.0));
  const RigidTransform again = mirroredPose(mirrored, body, flight.markers);
  EXPECT_LT(test::positionError(again, flight.camera_from_world), 1e-9);
  EXPECT_LT(test::orientationError(again, flight.camera_from_world), 1e-7);
}

ModeChoice searched(ModeSearch& search, const FrameStore& store, const RigidTransform& in_use,
                    const RigidTransform& guess, int frames_at_a_time) {
  search.start(store.frames(), in_use, guess);
  while (search.running()) {
    int budget = frames_at_a_time;
    search.advance(in_use, budget);
    EXPECT_GE(budget, 0);
  }
  return search.choice();
}

TEST(ModeSearch, LeavesTheMirrorImageForTheCamera) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TrainingFlight flight = flyForTraining(seed, {.duration_s = 4.0});
    const FrameStore store = storeOf(flight, static_cast<int>(kModeFrames));
    const RigidTransform mirrored =
        mirroredPose(flight.camera_from_world, flight.frames.back().true_world_from_body, flight.markers);
    ModeSearch search(flight.camera, flight.markers);
    const ModeChoice choice = searched(search, store, mirrored, mirrored, 1000);
    EXPECT_TRUE(choice.other_mode);
    EXPECT_LT(test::positionError(choice.best.camera_from_world, flight.camera_from_world), 0.03);
    EXPECT_FALSE(searched(search, store, choice.best.camera_from_world, flight.guess, 1000).other_mode);
  }
}

TEST(ModeSearch, InSlicesFindsTheSameBits) {
  const TrainingFlight flight = flyForTraining(5, {.duration_s = 2.0});
  const FrameStore store = storeOf(flight, static_cast<int>(kModeFrames));
  ModeSearch search(flight.camera, flight.markers);
  const ModeChoice whole = searched(search, store, flight.guess, flight.guess, 1'000'000);
  for (const int slice : {1, 7, 24, 100}) {
    const ModeChoice sliced = searched(search, store, flight.guess, flight.guess, slice);
    EXPECT_EQ(sliced.best.camera_from_world.translation, whole.best.camera_from_world.translation);
    EXPECT_EQ(sliced.best.information, whole.best.information);
    EXPECT_EQ(sliced.best.cost, whole.best.cost);
  }
}

TEST(FrameStore, MakesRoomWhereNothingMoves) {
  FrameStore store(20);
  CalibrationFrame frame;
  for (int k = 0; k < 1000; ++k) {  // a long stand, then a climb of ten frames
    frame.exposure = k;
    frame.world_from_body.translation.z() = k < 990 ? 1e-4 * (k % 3) : 0.1 * (k - 989);
    store.add(frame);
  }
  const auto frames = store.frames();
  ASSERT_EQ(frames.size(), 20u);
  int climbing = 0;
  for (const StoredFrame* kept : frames) climbing += kept->world_from_body.translation.z() > 0.05 ? 1 : 0;
  EXPECT_EQ(climbing, 10);
  EXPECT_DOUBLE_EQ(frames.back()->world_from_body.translation.z(), 1.0);
}

TEST(FrameStore, SpreadsASelectionOverAllFramesWithTheNewest) {
  FrameStore store(50);
  CalibrationFrame frame;
  for (int k = 0; k < 50; ++k) {
    frame.world_from_body.translation.x() = k;
    store.add(frame);
  }
  std::array<const StoredFrame*, 5> room;
  const auto selection = store.spread(room);
  ASSERT_EQ(selection.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_DOUBLE_EQ(selection[i]->world_from_body.translation.x(), 10.0 * static_cast<double>(i) + 9.0);
  store.clear();
  EXPECT_TRUE(store.spread(room).empty());
}

}  // namespace
}  // namespace helical
