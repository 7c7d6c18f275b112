#include "engine/pipeline/cable_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "engine/geometry/rotation.h"
#include "tests/tracking/field.h"

namespace helical {
namespace {

constexpr int kCameras = 3;
constexpr TimeNs kFrame = kNanosecondsPerSecond / 60;

/// A helicopter over the pad, tracked by cameras whose frames go through a CableWatch as they do in flight.
class WatchedFlight {
 public:
  WatchedFlight() : tracker_(makeTracker("helical", {}, field.markers, field.models, kStandingHeight)) {
    camera_of_stream = {0, 1, 2};
  }

  /// True when something was found in these frames.
  bool fly(int frames) {
    found = {};
    for (int i = 0; i < frames; ++i) {
      for (int stream = 0; stream < kCameras; ++stream) {
        const int camera = camera_of_stream[static_cast<std::size_t>(stream)];
        Observation observation = field.observe(camera, now_ + stream * kFrame / 4, pose(), kCentroidSigma, random_);
        if (hidden) observation.count = 0;
        observation.camera = watch.cameraOf(cameraId(stream));
        step(observation);
      }
      now_ += kFrame;
    }
    return found.finding != CableWatch::Finding::kNothing;
  }

  /// The camera does not stand there any more.
  void knock(int camera, double angle) {
    RigidTransform& place = field.estimates[static_cast<std::size_t>(camera)].camera_from_world;
    if (places_[static_cast<std::size_t>(camera)].status == CameraStatus::kUncalibrated) keepPlaces();
    place = RigidTransform{expSO3({angle, 0.3 * angle, 0.0}), {0.0, 0.1 * angle, 0.0}} * place;
  }
  void keepPlaces() {
    for (std::size_t i = 0; i < kCameras; ++i) places_[i] = field.estimates[i];
  }

  RigidTransform pose() const {
    const double t = toSeconds(now_);
    return {expSO3({0.0, 0.0, 0.1 * std::sin(t)}), {0.1 * std::sin(0.7 * t), 0.1 * std::cos(0.5 * t), 0.06 + 0.05 * t}};
  }
  double trackingError() const {
    return distanceBetween(tracker_->predict(now_, true).state.world_from_body, pose());
  }

  Field field;
  CableWatch watch{field.markers, field.models, kStandingHeight};
  std::array<int, kCameras> camera_of_stream;
  std::array<bool, kMaxCameras> usable = field.usable;
  bool hidden = false;
  CableWatch::Verdict found;

 private:
  void step(const Observation& observation) {
    std::array<CameraEstimate, kMaxCameras> known;
    CableWatch::Places places{};
    for (std::size_t i = 0; i < kCameras; ++i) {
      known[i] = places_[i].status == CameraStatus::kUncalibrated ? field.estimates[i] : places_[i];
      places[i] = &known[i];
    }
    const std::span<const bool> in_control(usable.data(), kCameras);
    tracker_->update(observation, {known.data(), kCameras}, in_control, true);
    const CableWatch::Verdict verdict = watch.add(observation, places, in_control, *tracker_, true);
    if (verdict.finding != CableWatch::Finding::kNothing) found = verdict;
  }

  std::unique_ptr<Tracker> tracker_;
  std::array<CameraEstimate, kMaxCameras> places_{};  ///< as they are thought to stand, once one was knocked
  Random random_{3};
  TimeNs now_ = 0;
};

TEST(CableWatch, TwoThatChangeCablesAreTakenForEachOtherAndBack) {
  WatchedFlight flight;
  EXPECT_FALSE(flight.fly(60));
  std::swap(flight.camera_of_stream[1], flight.camera_of_stream[2]);
  ASSERT_TRUE(flight.fly(12));
  EXPECT_EQ(flight.found.finding, CableWatch::Finding::kChanged);
  EXPECT_EQ(flight.watch.cameraOf(cameraId(1)), cameraId(2));
  EXPECT_EQ(flight.watch.cameraOf(cameraId(2)), cameraId(1));
  EXPECT_EQ(flight.watch.cameraOf(cameraId(0)), cameraId(0));
  EXPECT_FALSE(flight.fly(120));
  EXPECT_LT(flight.trackingError(), 0.02);
  std::swap(flight.camera_of_stream[1], flight.camera_of_stream[2]);
  ASSERT_TRUE(flight.fly(12));
  EXPECT_EQ(flight.watch.cameraOf(cameraId(1)), cameraId(1));
  EXPECT_EQ(flight.watch.changes(), 2u);
}

TEST(CableWatch, FindsWhatChangedWhileNothingWasSeen) {
  for (const int other : {1, 2}) {
    WatchedFlight flight;
    flight.fly(60);
    flight.hidden = true;
    EXPECT_FALSE(flight.fly(60));
    std::swap(flight.camera_of_stream[0], flight.camera_of_stream[static_cast<std::size_t>(other)]);
    flight.hidden = false;
    ASSERT_TRUE(flight.fly(20));
    EXPECT_EQ(flight.found.finding, CableWatch::Finding::kChanged);
    EXPECT_EQ(flight.watch.cameraOf(cameraId(0)), cameraId(other));
    flight.fly(10);
    EXPECT_LT(flight.trackingError(), 0.02);
  }
}

TEST(CableWatch, KnockedCamerasHaveChangedNoCables) {
  for (const double angle : {0.01, 0.1, -0.3})
    for (int knocked = 1; knocked <= kCameras; ++knocked) {
      WatchedFlight flight;
      flight.fly(30);
      for (int camera = 0; camera < knocked; ++camera) flight.knock(camera, angle * (1.0 + 0.4 * camera));
      EXPECT_FALSE(flight.fly(100)) << knocked << " by " << angle;
    }
}

TEST(CableWatch, ACameraThatWasSetAsideComesBackWhenItAgrees) {
  WatchedFlight flight;
  flight.usable[2] = false;
  ASSERT_TRUE(flight.fly(40));
  EXPECT_EQ(flight.found.finding, CableWatch::Finding::kAgreesAgain);
  EXPECT_EQ(flight.found.camera, cameraId(2));
}

TEST(CableWatch, OneThatWasSetAsideAndMovedStaysAside) {
  for (const double angle : {0.03, 0.1, -0.3}) {
    WatchedFlight flight;
    flight.usable[2] = false;
    flight.knock(2, angle);
    EXPECT_FALSE(flight.fly(200)) << angle;
  }
}

}  // namespace
}  // namespace helical
