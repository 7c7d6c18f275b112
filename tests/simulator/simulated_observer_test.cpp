#include "engine/simulator/simulated_observer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/geometry/rotation.h"

namespace helical {
namespace {

using Eigen::Vector2d;

CameraModel model() {
  return {640, 480, 567.6, 567.6, 319.5, 239.5, {-0.05, 0.01, 0.0004, -0.0003, 0.0}};
}

/// Towards the pad from 2.7 m, 40 degrees above the floor.
RigidTransform cameraPose() {
  const Eigen::Vector3d back(-std::cos(toRadians(40.0)), 0, std::sin(toRadians(40.0)));
  const Eigen::Vector3d z = -back, x = z.cross(Eigen::Vector3d::UnitZ()).normalized(), y = z.cross(x);
  Eigen::Matrix3d rotation;
  rotation << x.transpose(), y.transpose(), z.transpose();
  const Eigen::Quaterniond q(rotation);
  return {q, -(q * (2.7 * back))};
}

SimulationOptions noiseless() {
  SimulationOptions options;
  options.gust_factor = 0.0;
  options.noise = {.sigma_px = 0.0,
                   .bias_px = 0.0,
                   .bias_time_s = 1.0,
                   .dropout = 0.0,
                   .false_markers = 0.0,
                   .outliers = 0.0};
  return options;
}

/// A camera that looks at the helicopter standing on the pad, polled every 5 ms.
struct Watch {
  SimulationOptions options;
  MarkerLayout markers;
  std::shared_ptr<World> world;
  std::shared_ptr<ManualClock> clock = std::make_shared<ManualClock>();
  SimulatedObserver observer;

  explicit Watch(const SimulationOptions& o, const MarkerLayout& layout = MarkerLayout::paper())
      : options(o),
        markers(layout),
        world(std::make_shared<World>(o, HelicopterParameters::xrb())),
        observer(cameraId(0), model(), cameraPose(), layout, MarkerOptions{}, o, world, clock) {}

  std::vector<Observation> until(double seconds) {
    std::vector<Observation> observations;
    Observation observation;
    for (; clock->now() < fromSeconds(seconds); clock->set(clock->now() + 5 * kNanosecondsPerMillisecond))
      while (observer.poll(observation)) observations.push_back(observation);
    return observations;
  }
  Vector2d truth(int marker, TimeNs time) const {
    return *model().project(cameraPose() *
                            (world->at(time)->state.world_from_body * markers.inBody(markerId(marker))));
  }
};

TEST(SimulatedObserver, WithoutNoiseSeesTheProjections) {
  Watch watch(noiseless());
  watch.until(0.5);
  Observation observation;
  for (int i = 0; i < 60; ++i) {
    watch.clock->set(watch.clock->now() + fromSeconds(1.0 / 59.0));
    if (!watch.observer.poll(observation)) continue;
    ASSERT_EQ(observation.count, 4);
    for (int m = 0; m < 4; ++m) {
      const Centroid& centroid = observation.centroids[static_cast<std::size_t>(m)];
      EXPECT_LT((centroid.pixel - watch.truth(m, observation.exposure)).norm(), 1e-9);
      EXPECT_NEAR(centroid.radius_px, 567.6 * 0.018 / 2.7, 0.4);
      EXPECT_NEAR(centroid.area_px, kPi * centroid.radius_px * centroid.radius_px, 1e-9);
    }
  }
}

TEST(SimulatedObserver, SeesNothingInTheEmptyField) {
  Watch watch(noiseless());
  const auto observations = watch.until(1.0);
  ASSERT_GT(observations.size(), 50u);
  for (const auto& observation : observations)
    EXPECT_EQ(observation.count, observation.exposure < fromSeconds(0.25) ? 0 : 4);
}

TEST(SimulatedObserver, FramesComeInOrderAndOnlyOnceTheyHaveArrived) {
  Watch watch(noiseless());
  Observation observation, before;
  int frames = 0;
  for (; watch.clock->now() < fromSeconds(1.0);
       watch.clock->set(watch.clock->now() + kNanosecondsPerMillisecond)) {
    if (!watch.observer.poll(observation)) continue;
    EXPECT_LE(observation.arrival, watch.clock->now());
    EXPECT_LT(observation.exposure, observation.arrival);
    EXPECT_EQ(observation.camera, cameraId(0));
    if (frames++ > 0) {
      EXPECT_EQ(observation.sequence, before.sequence + 1);
    }
    before = observation;
  }
  EXPECT_NEAR(frames, 59, 2);
}

TEST(SimulatedObserver, CentroidsScatterAsAskedFor) {
  SimulationOptions options = noiseless();
  options.noise.sigma_px = 0.2;
  options.noise.bias_px = 0.3;
  options.noise.bias_time_s = 0.5;
  Watch watch(options);
  watch.until(0.4);
  // On the pad it does not move: what changes is noise.
  const auto observations = watch.until(120.0);
  double squares = 0.0, steps = 0.0;
  int count = 0;
  for (std::size_t i = 1; i < observations.size(); ++i)
    for (int m = 0; m < 4; ++m) {
      const Vector2d error = observations[i].centroids[static_cast<std::size_t>(m)].pixel -
                             watch.truth(m, observations.back().exposure);
      const Vector2d step = observations[i].centroids[static_cast<std::size_t>(m)].pixel -
                            observations[i - 1].centroids[static_cast<std::size_t>(m)].pixel;
      squares += 0.5 * error.squaredNorm();
      steps += 0.5 * step.squaredNorm();
      ++count;
    }
  EXPECT_NEAR(std::sqrt(squares / count), std::hypot(0.2, 0.3), 0.03);
  const double keep = std::exp(-1.0 / 60.0 / 0.5);
  EXPECT_NEAR(steps / count, 2.0 * 0.2 * 0.2 + 2.0 * 0.3 * 0.3 * (1.0 - keep), 0.008);
}

TEST(SimulatedObserver, DropsThrowsAndInventsAtTheAskedRates) {
  SimulationOptions options = noiseless();
  options.noise.dropout = 0.1;
  Watch dropping(options);
  dropping.until(0.4);
  double seen = 0.0;
  auto observations = dropping.until(60.0);
  for (const auto& observation : observations) seen += observation.count;
  EXPECT_NEAR(seen / (4.0 * static_cast<double>(observations.size())), 0.9, 0.01);

  options = noiseless();
  options.noise.false_markers = 0.2;
  Watch inventing(options);
  inventing.until(0.4);
  double invented = 0.0;
  observations = inventing.until(60.0);
  for (const auto& observation : observations) invented += observation.count - 4;
  EXPECT_NEAR(invented / static_cast<double>(observations.size()), 0.2, 0.03);

  options = noiseless();
  options.noise.outliers = 0.1;
  Watch throwing(options);
  throwing.until(0.4);
  double thrown = 0.0, all = 0.0;
  observations = throwing.until(60.0);
  for (const auto& observation : observations)
    for (int c = 0; c < observation.count; ++c, ++all) {
      double nearest = 1e9;
      for (int m = 0; m < 4; ++m)
        nearest = std::min(nearest, (observation.centroids[static_cast<std::size_t>(c)].pixel -
                                     throwing.truth(m, observations.back().exposure))
                                        .norm());
      thrown += nearest > 2.0 ? 1.0 : 0.0;
    }
  EXPECT_NEAR(thrown / all, 0.1, 0.015);
}

TEST(SimulatedObserver, TouchingBallsMerge) {
  const std::array<Eigen::Vector3d, 4> balls{
      {{0.1, 0.0, 0.0}, {-0.1, 0.0, 0.0}, {-0.1, 0.03, 0.0}, {0.0, -0.15, 0.0}}};
  Watch watch(noiseless(), MarkerLayout(balls, 0.018));
  const auto observations = watch.until(0.5);
  const Observation& seen = observations.back();
  ASSERT_EQ(seen.count, 3);
  const Vector2d middle = 0.5 * (watch.truth(1, seen.exposure) + watch.truth(2, seen.exposure));
  EXPECT_LT((seen.centroids[1].pixel - middle).norm(), 0.1);
  EXPECT_NEAR(seen.centroids[1].area_px, 2.0 * seen.centroids[0].area_px, 0.3 * seen.centroids[0].area_px);
}

TEST(SimulatedObserver, BoardHidesFromTheLeft) {
  SimulationOptions options = noiseless();
  options.occlusions = {{cameraId(0), 1.0, 2.0}};
  Watch watch(options);
  watch.until(0.9);
  int in_part = 0;
  for (const auto& observation : watch.until(2.4)) {
    const double t = toSeconds(observation.exposure);
    const double edge = 640.0 * std::clamp(std::min((t - 1.0) / 0.25, (2.25 - t) / 0.25), 0.0, 1.0);
    for (int c = 0; c < observation.count; ++c)
      EXPECT_GE(observation.centroids[static_cast<std::size_t>(c)].pixel.x(), edge - 1e-6);
    if (edge >= 640.0) {
      EXPECT_EQ(observation.count, 0);
    }
    if (edge <= 0.0) {
      EXPECT_EQ(observation.count, 4);
    }
    in_part += observation.count > 0 && observation.count < 4 ? 1 : 0;
  }
  EXPECT_GT(in_part, 0);
}

TEST(SimulatedObserver, KnockedCameraSeesFromItsNewPlace) {
  SimulationOptions options = noiseless();
  options.bumps = {{cameraId(0), 1.0, toRadians(2.0), 0.0}};
  Watch watch(options);
  const auto before = watch.until(1.0).back();
  const auto after = watch.until(1.3).back();
  ASSERT_EQ(after.count, 4);
  const double moved = (after.centroids[0].pixel - before.centroids[0].pixel).norm();
  EXPECT_GT(moved, 1.0);
  EXPECT_LT(moved, 2.0 * 567.6 * toRadians(2.0));
}

TEST(SimulatedObserver, RepeatsForASeed) {
  SimulationOptions options;
  options.noise.dropout = 0.05;
  Watch a(options), b(options);
  const auto of_a = a.until(2.0), of_b = b.until(2.0);
  ASSERT_EQ(of_a.size(), of_b.size());
  options.seed = 2;
  const auto of_other = Watch(options).until(2.0);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    ASSERT_EQ(of_a[i].count, of_b[i].count);
    EXPECT_EQ(of_a[i].exposure, of_b[i].exposure);
    EXPECT_NE(of_a[i].exposure, of_other[i].exposure);
    for (int c = 0; c < of_a[i].count; ++c)
      EXPECT_EQ(of_a[i].centroids[static_cast<std::size_t>(c)].pixel,
                of_b[i].centroids[static_cast<std::size_t>(c)].pixel);
  }
}

}  // namespace
}  // namespace helical
