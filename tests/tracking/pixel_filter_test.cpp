#include "engine/tracking/pixel_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/geometry/rotation.h"
#include "engine/helicopter/helicopter_parameters.h"
#include "tests/tracking/field.h"

namespace helical {
namespace {

using Eigen::Vector3d;

constexpr double kCameraPeriod = 1.0 / 60.0;
constexpr double kBias = 0.07;  // px, what TrackerOptions expects

/// A smooth random flight: sums of sines for place and heading, tilted as its acceleration needs.
class Motion {
 public:
  explicit Motion(std::uint64_t seed) {
    Random random(seed);
    for (auto& axis : waves_)
      for (auto& wave : axis)
        wave = {random.uniform(0.02, 0.06), random.uniform(0.5, 2.0), random.uniform(0.0, 2.0 * kPi)};
  }
  /// Stands on the pad until 0.5 s, and moves in from there.
  RigidTransform at(double t) const {
    const double in = std::clamp((t - 0.5) / 1.5, 0.0, 1.0), share = in * in * (3.0 - 2.0 * in);
    const Vector3d acceleration = share * place(t, 2);
    RigidTransform pose;
    pose.translation = share * place(t, 0) + Vector3d(0, 0, kStandingHeight + 0.4 * share);
    const Eigen::Quaterniond tilt = Eigen::Quaterniond::FromTwoVectors(
        Vector3d::UnitZ(), Vector3d(acceleration.x(), acceleration.y(), kGravity));
    pose.rotation = (tilt * expSO3({0, 0, 0.2 + 4.0 * share * sum(3, t, 0)})).normalized();
    return pose;
  }

 private:
  struct Wave {
    double size, rate, phase;
  };
  double sum(std::size_t axis, double t, int derivative) const {
    double result = 0.0;
    for (const Wave& w : waves_[axis])
      result +=
          w.size * std::pow(w.rate, derivative) * std::sin(w.rate * t + w.phase + derivative * kPi / 2.0);
    return result;
  }
  Vector3d place(double t, int derivative) const {
    return {sum(0, t, derivative), sum(1, t, derivative), sum(2, t, derivative)};
  }
  std::array<std::array<Wave, 3>, 4> waves_;
};

/// A tracker that sees a moving helicopter by free-running cameras, some milliseconds apart and sometimes out
/// of order. `spoil` may change every observation before the tracker gets it.
struct Flight {
  Field field;
  Motion motion;
  Random random;
  PixelFilter tracker;
  std::function<RigidTransform(double)> truth;
  std::function<void(Observation&)> spoil;
  std::array<double, 3> next{0.0, 0.004, 0.011};
  std::array<std::array<Eigen::Vector2d, 4>, 3> bias;
  double now = 0.0;

  explicit Flight(std::uint64_t seed = 1, const TrackerOptions& options = {})
      : motion(seed),
        random(seed + 1000),
        tracker(options, field.markers, field.models, kStandingHeight),
        truth([this](double t) { return motion.at(t); }) {
    for (auto& camera : bias)
      for (auto& offset : camera) offset = kBias * Eigen::Vector2d(random.normal(), random.normal());
  }
  Flight(const Flight&) = delete;

  bool airborne() const { return now > 0.5; }

  /// One camera's next frame.
  void observe() {
    const auto camera = static_cast<std::size_t>(std::min_element(next.begin(), next.end()) - next.begin());
    // Read-outs differ: an exposure may be some milliseconds older than the last.
    const double exposure = next[camera] - (camera == 1 ? 0.005 : 0.0);
    now = std::max(now, exposure);
    next[camera] += kCameraPeriod;
    Observation seen =
        field.observe(static_cast<int>(camera), fromSeconds(exposure), truth(exposure), 0.08, random);
    for (int c = 0; c < seen.count && seen.count == 4; ++c)
      seen.centroids[static_cast<std::size_t>(c)].pixel += bias[camera][static_cast<std::size_t>(c)];
    if (spoil) spoil(seen);
    tracker.update(seen, field.estimates, field.usableCameras(), airborne());
  }
  void runUntil(double time) {
    while (now < time) observe();
  }
  TrackedState estimate() const { return tracker.predict(fromSeconds(now), airborne()); }
  double positionError() const { return distanceBetween(estimate().state.world_from_body, truth(now)); }
  double angleError() const { return angleBetween(estimate().state.world_from_body, truth(now)); }
  double nees() const {
    const TrackedState tracked = estimate();
    const RigidTransform pose = truth(now);
    Vector6d error;
    error << tracked.state.world_from_body.translation - pose.translation,
        logSO3(pose.rotation.conjugate() * tracked.state.world_from_body.rotation);
    return error.dot(tracked.pose_covariance.ldlt().solve(error));
  }
  /// Largest errors while it flies until `time`.
  std::pair<double, double> worstUntil(double time) {
    double metres = 0.0, radians = 0.0;
    while (now < time) {
      observe();
      metres = std::max(metres, positionError());
      radians = std::max(radians, angleError());
    }
    return {metres, radians};
  }
};

TEST(PixelFilter, KnowsNothingBeforeItSawAnything) {
  const Flight flight;
  EXPECT_FALSE(flight.tracker.acquired());
}

TEST(PixelFilter, FollowsASmoothFlightWithUnsynchronisedCameras) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Flight flight(seed);
    flight.runUntil(0.3);
    ASSERT_TRUE(flight.tracker.acquired());
    const auto [metres, radians] = flight.worstUntil(8.0);
    EXPECT_LT(metres, 0.006) << "seed " << seed;
    EXPECT_LT(radians, 0.04) << "seed " << seed;
    EXPECT_LT(toSeconds(fromSeconds(flight.now) - flight.tracker.lastUpdate()), 0.02);
  }
}

TEST(PixelFilter, ErrorsAreAsLargeAsTheCovarianceSays) {
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Flight flight(seed);
    flight.runUntil(2.5);
    for (double t = 2.6; t < 6.0; t += 0.1) {
      flight.runUntil(t);
      sum += flight.nees();
      ++count;
    }
  }
  // Six degrees of freedom; a model that suits a helicopter better than these sines leaves it on the safe
  // side.
  EXPECT_GT(sum / count, 1.5);
  EXPECT_LT(sum / count, 9.0);
}

TEST(PixelFilter, PredictsAheadAndBack) {
  Flight flight;
  flight.runUntil(4.0);
  for (const double ahead : {-0.01, 0.0, 0.02, 0.05}) {
    const TrackedState predicted = flight.tracker.predict(fromSeconds(flight.now + ahead), true);
    EXPECT_LT(distanceBetween(predicted.state.world_from_body, flight.truth(flight.now + ahead)), 0.01);
  }
  const double near = flight.tracker.predict(fromSeconds(flight.now + 0.01), true).pose_covariance.trace();
  const double far = flight.tracker.predict(fromSeconds(flight.now + 0.2), true).pose_covariance.trace();
  EXPECT_GT(far, 2.0 * near);
}

TEST(PixelFilter, RejectsOutliersAndDoesNotSelectThem) {
  Flight flight;
  flight.runUntil(3.0);
  int seen = 0, selected = 0;
  flight.spoil = [&](Observation& o) {
    if (o.camera == cameraId(0)) o.centroids[2].pixel += Eigen::Vector2d(25, -15);
  };
  while (flight.now < 5.0) {
    flight.observe();
    const CameraTrack& track = flight.tracker.track(cameraId(0));
    ++seen;
    selected += track.markers[2].selected ? 1 : 0;
    EXPECT_LT(flight.positionError(), 0.006);
  }
  EXPECT_LE(selected, 3) << "at most the frame from before";
  flight.spoil = nullptr;
  flight.runUntil(5.2);
  EXPECT_TRUE(flight.tracker.track(cameraId(0)).markers[2].selected) << "and lets it back in";
}

TEST(PixelFilter, BearsSwappedFalseAndMergedCentroids) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Flight flight(seed);
    Random luck(seed);
    flight.runUntil(1.0);
    flight.spoil = [&](Observation& o) {
      if (o.count == 4)
        std::swap(o.centroids[0], o.centroids[static_cast<std::size_t>(luck.uniform(0.0, 4.0))]);
      if (luck.uniform() < 0.2) addCentroid(o, {luck.uniform(0, 640), luck.uniform(0, 480)}, 50.0);
      if (luck.uniform() < 0.1) {
        // Two balls become one region in the middle.
        o.centroids[0].pixel = 0.5 * (o.centroids[0].pixel + o.centroids[1].pixel);
        o.centroids[0].area_px *= 2.0;
        o.centroids[1] = o.centroids[static_cast<std::size_t>(--o.count)];
      }
    };
    const auto [metres, radians] = flight.worstUntil(6.0);
    EXPECT_LT(metres, 0.01);
    EXPECT_LT(radians, 0.06);
  }
}

/// Half of a ball is hidden and its centre of gravity lies aside: the pose should hardly notice.
TEST(PixelFilter, PartlyHiddenBallHasLittleWeight) {
  const auto errorWith = [](double area) {
    Flight flight(3);
    flight.runUntil(3.0);
    flight.spoil = [&](Observation& o) {
      if (o.camera != cameraId(0)) return;
      o.centroids[1].pixel += Eigen::Vector2d(0.5, 0.0);
      o.centroids[1].area_px *= area;
      o.centroids[1].radius_px *= std::sqrt(area);
    };
    double sum = 0.0;
    Flight clean(3);
    clean.runUntil(3.0);
    while (flight.now < 5.0) {
      flight.observe();
      clean.observe();
      sum += distanceBetween(flight.estimate().state.world_from_body, clean.estimate().state.world_from_body);
    }
    return sum;
  };
  EXPECT_LT(errorWith(0.5), 0.5 * errorWith(1.0));
}

TEST(PixelFilter, FliesOnOneCameraForAWhile) {
  Flight flight;
  flight.runUntil(2.5);
  flight.field.usable[1] = flight.field.usable[2] = false;
  const auto [metres, radians] = flight.worstUntil(5.0);
  EXPECT_LT(metres, 0.03);
  EXPECT_LT(radians, 0.15);
}

TEST(PixelFilter, FliesOnTwoMarkersPerCamera) {
  Flight flight;
  flight.runUntil(2.5);
  flight.spoil = [](Observation& o) {
    if (o.camera == cameraId(1)) std::swap(o.centroids[0], o.centroids[3]);
    o.count = std::min(o.count, 2);
  };
  const auto [metres, radians] = flight.worstUntil(5.0);
  EXPECT_LT(metres, 0.02);
  EXPECT_LT(radians, 0.12);
}

TEST(PixelFilter, SingleCentroidIsNoPose) {
  Flight flight;
  flight.runUntil(2.5);
  flight.spoil = [](Observation& o) { o.count = std::min(o.count, 1); };
  const TimeNs last = flight.tracker.lastUpdate();
  flight.runUntil(2.6);
  EXPECT_LE(toSeconds(flight.tracker.lastUpdate() - last), 0.02) << "anything green may be one ball";
}

TEST(PixelFilter, FindsItselfAgainAfterAGap) {
  for (const double gap : {0.06, 0.3, 0.8}) {
    Flight flight(4);
    flight.runUntil(3.0);
    flight.spoil = [](Observation& o) { o.count = 0; };
    flight.runUntil(3.0 + gap);
    EXPECT_GT(toSeconds(fromSeconds(flight.now) - flight.tracker.lastUpdate()), gap - 0.03);
    flight.spoil = nullptr;
    flight.runUntil(3.0 + gap + 0.5);
    const auto [metres, radians] = flight.worstUntil(6.0);
    EXPECT_LT(metres, 0.01) << "gap of " << gap << " s";
    EXPECT_LT(radians, 0.06);
  }
}

/// Blind, nobody keeps it from turning and falling: what is seen after a gap is followed at once all the same.
TEST(PixelFilter, FollowsWhatTurnsAndFallsAfterAGap) {
  for (const double turning : {-4.0, 4.0}) {
    Flight flight(4);
    flight.runUntil(3.0);
    flight.spoil = [](Observation& o) { o.count = 0; };
    flight.runUntil(5.0);
    flight.spoil = nullptr;
    const RigidTransform there = flight.motion.at(3.0);
    flight.truth = [&](double t) {
      return RigidTransform{there.rotation * expSO3({0, 0, turning * (t - 5.0)}),
                            there.translation + Vector3d(0.05, 0.0, 0.1 - 0.5 * (t - 5.0))};
    };
    flight.runUntil(5.1);
    const auto [metres, radians] = flight.worstUntil(5.4);
    EXPECT_LT(metres, 0.02) << turning;
    EXPECT_LT(radians, 0.15) << turning;
    EXPECT_LT(toSeconds(fromSeconds(flight.now) - flight.tracker.lastUpdate()), 0.02) << turning;
  }
}

/// A pose that is wrong by a quarter turn explains an almost square layout in part only: it is left.
TEST(PixelFilter, LeavesAPoseThatExplainsTooLittle) {
  Flight flight(5);
  flight.runUntil(3.0);
  const RigidTransform before = flight.motion.at(3.0);
  flight.truth = [&](double) {
    return RigidTransform{before.rotation * expSO3({0, 0, 0.5 * kPi}), before.translation};
  };
  flight.runUntil(5.0);
  EXPECT_LT(flight.positionError(), 0.01);
  EXPECT_LT(flight.angleError(), 0.05);
}

TEST(PixelFilter, LeavesAWrongHeightAndTiltToo) {
  Flight flight(6);
  flight.runUntil(3.0);
  const RigidTransform before = flight.motion.at(3.0);
  flight.truth = [&](double) {
    return RigidTransform{before.rotation, before.translation + Vector3d(0.2, -0.15, 0.1)};
  };
  flight.runUntil(4.5);
  EXPECT_LT(flight.positionError(), 0.01);
}

TEST(PixelFilter, UncertainCameraCountsLess) {
  const auto pulled = [](double sigma) {
    Flight flight(7), clean(7);
    for (Flight* one : {&flight, &clean}) {
      one->runUntil(2.5);
      one->field.estimates[2].covariance = sigma * sigma * Matrix6d::Identity();
    }
    // As if it were not quite where it is believed to be.
    flight.spoil = [](Observation& o) {
      if (o.camera != cameraId(2)) return;
      for (int c = 0; c < o.count; ++c) o.centroids[static_cast<std::size_t>(c)].pixel.x() += 0.25;
    };
    double sum = 0.0;
    while (flight.now < 4.0) {
      flight.observe();
      clean.observe();
      sum += distanceBetween(flight.estimate().state.world_from_body, clean.estimate().state.world_from_body);
    }
    return sum;
  };
  EXPECT_LT(pulled(0.01), 0.2 * pulled(0.0));
}

TEST(PixelFilter, UncertainCamerasMakeAnUncertainPose) {
  const auto trace = [](double sigma) {
    Flight flight(8);
    for (auto& estimate : flight.field.estimates) estimate.covariance = sigma * sigma * Matrix6d::Identity();
    flight.runUntil(3.0);
    return flight.estimate().pose_covariance.topLeftCorner<3, 3>().trace();
  };
  EXPECT_GT(trace(0.01), 1.5 * trace(0.0));
}

TEST(PixelFilter, ReportsWhatEachCameraSaw) {
  Flight flight;
  flight.runUntil(3.0);
  for (int c = 0; c < 3; ++c) {
    const CameraTrack& track = flight.tracker.track(cameraId(c));
    EXPECT_NEAR(toSeconds(track.exposure), 3.0, 0.03);
    EXPECT_EQ(track.selected_count, 4);
    EXPECT_GT(track.residual_px, 0.0);
    EXPECT_LT(track.residual_px, 0.4);
    for (int m = 0; m < 4; ++m) {
      const MarkerTrack& marker = track.markers[static_cast<std::size_t>(m)];
      EXPECT_TRUE(marker.observed && marker.selected && marker.predicted);
      EXPECT_LT((marker.pixel - marker.reprojected).norm(), 1.0);
    }
    EXPECT_FALSE(track.markers[4].predicted) << "there is no fifth marker";
  }
}

TEST(PixelFilter, DoesNotLookAtUnusableCameras) {
  Flight flight;
  flight.field.usable[1] = false;
  // Its pose is nonsense, as of a camera that nobody has calibrated.
  flight.field.estimates[1].camera_from_world = {};
  flight.spoil = [](Observation& o) {
    if (o.camera == cameraId(1)) o.count = 0;
  };
  flight.truth = [&](double t) { return flight.motion.at(t); };
  flight.runUntil(1.0);
  const auto [metres, radians] = flight.worstUntil(5.0);
  EXPECT_LT(metres, 0.008);
  EXPECT_LT(radians, 0.05);
  const CameraTrack& track = flight.tracker.track(cameraId(1));
  EXPECT_EQ(track.selected_count, 0);
  EXPECT_FALSE(track.markers[0].observed);
  EXPECT_GT(track.exposure, 0) << "but it says when the camera last looked";
}

TEST(PixelFilter, DoesNotStartOnAHelicopterPutDownTheWrongWay) {
  Flight flight;
  flight.truth = [](double) {
    return RigidTransform{expSO3({0, 0, 0.5 * kPi}), {0.0, 0.0, kStandingHeight}};
  };
  flight.runUntil(0.4);
  EXPECT_FALSE(flight.tracker.acquired());
}

}  // namespace
}  // namespace helical
