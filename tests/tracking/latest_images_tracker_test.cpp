#include "engine/tracking/latest_images_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/base/error.h"
#include "engine/geometry/rotation.h"
#include "tests/tracking/field.h"

namespace helical {
namespace {

constexpr double kCameraPeriod = 1.0 / 60.0;

/// Stands on the pad for half a second, then circles above it, slowly turning.
RigidTransform circling(double t) {
  const double share = std::clamp((t - 0.5) / 1.5, 0.0, 1.0);
  RigidTransform pose;
  pose.translation = {0.1 * share * std::sin(1.5 * t), 0.1 * share * std::cos(1.5 * t),
                      kStandingHeight + 0.4 * share};
  pose.rotation = Eigen::Quaterniond(expSO3({0.0, 0.0, 0.2 + 0.4 * share * std::sin(t)}));
  return pose;
}

/// The tracker behind three free-running cameras.
struct Watch {
  Field field;
  Random random{7};
  LatestImagesTracker tracker{field.markers, field.models, kStandingHeight};
  std::vector<CameraEstimate> believed = field.estimates;
  std::function<void(Observation&)> spoil;
  std::array<double, 3> next{0.0, 0.004, 0.011};
  double now = 0.0;

  void observe() {
    const auto camera = static_cast<std::size_t>(std::min_element(next.begin(), next.end()) - next.begin());
    now = next[camera];
    next[camera] += kCameraPeriod;
    Observation seen = field.observe(static_cast<int>(camera), fromSeconds(now), circling(now), 0.08, random);
    if (spoil) spoil(seen);
    tracker.update(seen, believed, field.usableCameras(), true);
  }
  double error() const {
    return distanceBetween(tracker.predict(fromSeconds(now), true).state.world_from_body, circling(now));
  }
  double worstUntil(double time) {
    double worst = 0.0;
    while (now < time) {
      observe();
      worst = std::max(worst, error());
    }
    return worst;
  }
};

TEST(LatestImagesTracker, KnowsNothingBeforeItSawAnything) {
  const Watch watch;
  EXPECT_FALSE(watch.tracker.acquired());
  EXPECT_EQ(watch.tracker.track(cameraId(0)).selected_count, 0);
}

TEST(LatestImagesTracker, FollowsASmoothFlight) {
  Watch watch;
  watch.worstUntil(0.5);
  ASSERT_TRUE(watch.tracker.acquired());
  EXPECT_LT(watch.worstUntil(8.0), 0.01);
  const TrackedState now = watch.tracker.predict(fromSeconds(watch.now), true);
  EXPECT_NEAR(now.state.velocity_in_world.norm(), 0.15, 0.08);
}

TEST(LatestImagesTracker, LeavesOutWhatJumpsInTheImage) {
  Watch watch;
  watch.worstUntil(3.0);
  Random random(3);
  watch.spoil = [&](Observation& seen) {
    for (int c = 0; c < seen.count; ++c)
      if (random.uniform() < 0.02) seen.centroids[static_cast<std::size_t>(c)].pixel.x() += 60.0;
  };
  EXPECT_LT(watch.worstUntil(8.0), 0.02);
}

TEST(LatestImagesTracker, IsPulledAlongByAWrongCamera) {
  Watch watch;
  watch.worstUntil(3.0);
  const double before = watch.error();
  watch.believed[2].camera_from_world.translation.x() += 0.3;
  watch.worstUntil(3.5);
  EXPECT_GT(watch.error(), 10.0 * before);
  EXPECT_EQ(watch.tracker.track(cameraId(2)).selected_count, 4);  // the image itself is in order
}

TEST(LatestImagesTracker, DoesNotLookAtUnusableCameras) {
  Watch watch;
  watch.field.usable[2] = false;
  watch.believed[2].camera_from_world.translation.x() += 0.3;
  EXPECT_LT(watch.worstUntil(4.0), 0.01);
  EXPECT_EQ(watch.tracker.track(cameraId(2)).selected_count, 0);
}

TEST(LatestImagesTracker, FindsItselfAgainAfterAGap) {
  Watch watch;
  watch.worstUntil(3.0);
  watch.spoil = [](Observation& seen) { seen.count = 0; };
  watch.worstUntil(3.6);
  EXPECT_LT(toSeconds(watch.tracker.lastUpdate()), 3.02);
  watch.spoil = nullptr;
  watch.worstUntil(4.0);
  EXPECT_LT(watch.worstUntil(6.0), 0.01);
}

TEST(LatestImagesTracker, TakesNoCorrectionForMotion) {
  Watch watch;
  watch.worstUntil(3.0);
  RigidTransform shift;
  shift.translation.z() = 0.05;
  for (CameraEstimate& camera : watch.believed) camera.camera_from_world = camera.camera_from_world * shift;
  watch.tracker.correct(watch.field.markers, watch.field.models);
  double fastest = 0.0;
  while (watch.now < 3.1) {
    watch.observe();
    const TrackedState now = watch.tracker.predict(fromSeconds(watch.now), true);
    fastest = std::max(fastest, now.state.velocity_in_world.norm());
  }
  EXPECT_NEAR(watch.error(), 0.05, 0.01);
  EXPECT_LT(fastest, 0.5);
}

TEST(LatestImagesTracker, PredictsForAShortWhileOnly) {
  Watch watch;
  watch.worstUntil(4.0);
  const TimeNs now = fromSeconds(watch.now);
  const auto at = [&](double ahead) {
    return watch.tracker.predict(now + fromSeconds(ahead), true).state.world_from_body.translation;
  };
  EXPECT_GT((at(0.05) - at(0.0)).norm(), 0.002);
  EXPECT_EQ(at(0.5), at(5.0));
}

TEST(TrackerFactory, NamesEveryTrackerAndRefusesOthers) {
  const Field field;
  for (const auto name : trackerNames())
    EXPECT_NE(makeTracker(name, {}, field.markers, field.models, kStandingHeight), nullptr);
  try {
    makeTracker("clairvoyant", {}, field.markers, field.models, kStandingHeight);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("clairvoyant"), std::string::npos);
  }
}

}  // namespace
}  // namespace helical
