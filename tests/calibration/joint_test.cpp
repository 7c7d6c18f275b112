#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/calibration/cramer_rao.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/training_flight.h"

namespace helical {
namespace {

using test::flyForTraining;
using test::TrainingFlight;

MarkerLayout layout(const std::array<Eigen::Vector2d, 4>& places) {
  std::array<Eigen::Vector3d, 4> balls;
  for (std::size_t i = 0; i < 4; ++i) balls[i] = {places[i].x(), places[i].y(), -0.05};
  return MarkerLayout(balls, 0.018);
}

MarkerLayout asymmetric() {
  return layout({{{0.18, 0.12}, {-0.15, 0.08}, {-0.12, -0.16}, {0.05, -0.10}}});
}

MarkerLayout square() {
  return layout({{{0.14, 0.14}, {-0.14, 0.14}, {-0.14, -0.14}, {0.14, -0.14}}});
}

/// The flights' noise is white, and the method is told so.
CalibratorOptions whiteNoise() {
  CalibratorOptions options;
  options.joint.lasting.sigma_px = 0.0;
  return options;
}

struct Study {
  double over_bound = 0.0;  ///< root of squared position errors over squared bounds
  double nees = 0.0;
};

Study study(const char* method, const test::TrainingFlightOptions& options, int seeds) {
  Study result;
  double errors = 0.0, bounds = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    const TrainingFlight flight = flyForTraining(1000 + static_cast<std::uint64_t>(seed), options);
    const auto calibrator = makeCalibrator(method, whiteNoise(), flight.camera, flight.markers, 1);
    calibrator->restart(flight.guess);
    CramerRaoBound bound;
    for (const auto& frame : flight.frames) {
      calibrator->step(frame.view());
      std::vector<MarkerId> seen;
      for (const auto& pixel : frame.pixels) seen.push_back(pixel.marker);
      const Matrix6d known = frame.pose_covariance.diagonal().cwiseInverse().asDiagonal();
      bound.add(flight.camera, flight.camera_from_world, flight.markers, seen, frame.true_world_from_body,
                known, 0.5);
    }
    const CameraEstimate estimate = calibrator->estimate();
    const Vector6d error = cameraPerturbation(estimate.camera_from_world, flight.camera_from_world);
    errors += error.tail<3>().squaredNorm();
    bounds += std::pow(bound.bound()->position_m, 2);
    result.nees += error.dot(estimate.covariance.ldlt().solve(error)) / seeds;
  }
  result.over_bound = std::sqrt(errors / bounds);
  return result;
}

TEST(Joint, ReachesTheBoundWithATrueCovariance) {
  const Study joint = study("joint", {.duration_s = 5.0, .markers = asymmetric()}, 60);
  EXPECT_LT(joint.over_bound, 1.15);
  EXPECT_NEAR(joint.nees, 6.0, 2.6 * std::sqrt(12.0 / 60.0));
}

TEST(Joint, NeedsNoGuessNorAnAsymmetricLayout) {
  for (const MarkerLayout& markers : {asymmetric(), square()}) {
    const Study joint = study(
        "joint", {.duration_s = 13.0, .guess_rotation_rad = 3.1, .guess_position_m = 3.0, .markers = markers},
        20);
    EXPECT_LT(joint.over_bound, 1.5);
  }
}

TEST(Joint, StandsThreeFalsePixelsInTen) {
  const Study joint = study("joint", {.duration_s = 13.0, .outliers = 0.3, .markers = asymmetric()}, 20);
  EXPECT_LT(joint.over_bound, 1.7);
}

TEST(Joint, ASymmetricSquareAtRestDecidesNothing) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TrainingFlight flight = flyForTraining(3000 + seed, {.duration_s = 0.95, .markers = square()});
    const auto calibrator = makeCalibrator("joint", {}, flight.camera, flight.markers, 1);
    calibrator->restart(flight.guess);
    for (const auto& frame : flight.frames) {
      calibrator->step(frame.view());
      ASSERT_TRUE(calibrator->named().empty()) << "seed " << seed;
    }
  }
}

/// As the crash had it: balls a millimetre off, and the camera of a square mirrored at their plane fits by chance.
TEST(Joint, NoCameraSeesBallsThroughThePad) {
  int decided = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    std::array<Eigen::Vector3d, 4> balls;
    const MarkerLayout said = square();
    for (int m = 0; m < said.count(); ++m) {
      const Eigen::Vector3d off(random.normal(), random.normal(), random.normal());
      balls[static_cast<std::size_t>(m)] = said.inBody(markerId(m)) + 1e-3 * off;
    }
    const TrainingFlight flight =
        flyForTraining(9000 + seed, {.duration_s = 3.0, .sigma_px = 0.1, .markers = MarkerLayout(balls, 0.018)});
    const auto calibrator = makeCalibrator("joint", {}, flight.camera, said, 1);
    calibrator->restart(flight.guess);
    for (std::size_t f = 0; f < flight.frames.size(); ++f) {
      calibrator->step(flight.frames[f].view());
      // At first a place may be there twice.
      if (f >= 60) {
        ASSERT_LE(calibrator->labellings().count, 4) << "a square is turned four ways, not mirrored; seed " << seed;
      }
      if (!calibrator->knowsItsPlace()) continue;
      ASSERT_GT(calibrator->estimate().camera_from_world.inverseTranslation().z(), 0.0) << "seed " << seed;
    }
    decided += calibrator->knowsItsPlace();
  }
  EXPECT_GT(decided, 6);
}

/// A layout of six, of which one is never seen, or of which one has a lamp of their colour beside it for good.
MarkerLayout six() {
  std::array<Eigen::Vector3d, 6> balls;
  const std::array<Eigen::Vector2d, 6> places{
      {{0.18, 0.12}, {-0.15, 0.08}, {-0.12, -0.16}, {0.05, -0.10}, {0.02, 0.15}, {0.15, -0.04}}};
  for (std::size_t i = 0; i < 6; ++i) balls[i] = {places[i].x(), places[i].y(), -0.05};
  return MarkerLayout(balls, 0.018);
}

double errorAfter(const TrainingFlight& flight) {
  const auto calibrator = makeCalibrator("joint", whiteNoise(), flight.camera, flight.markers, 1);
  calibrator->restart(flight.guess);
  for (const auto& frame : flight.frames) calibrator->step(frame.view());
  return test::positionError(calibrator->estimate().camera_from_world, flight.camera_from_world);
}

/// What is claimed before that is the guess, however well frames that look alike fix one of the places.
TEST(Joint, ClaimsNoMoreThanTheGuessUntilItHasDecided) {
  test::TrainingFlightOptions options;
  options.markers = square();
  const TrainingFlight flight = flyForTraining(7, options);
  const auto calibrator = makeCalibrator("joint", whiteNoise(), flight.camera, flight.markers, 1);
  calibrator->restart(flight.guess);
  const double guessed = calibrator->estimate().covariance.trace();
  int undecided = 0;
  for (const auto& frame : flight.frames) {
    calibrator->step(frame.view());
    if (calibrator->knowsItsPlace()) break;
    ++undecided;
    EXPECT_GE(calibrator->estimate().covariance.trace(), guessed);
  }
  EXPECT_GT(undecided, 10);
  EXPECT_TRUE(calibrator->knowsItsPlace());
  EXPECT_LT(calibrator->estimate().covariance.trace(), 0.1 * guessed);
}

TEST(Joint, FindsItsPlaceBesideALampThatLooksLikeABall) {
  for (const MarkerLayout& markers : {asymmetric(), six()})
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      TrainingFlight flight = flyForTraining(5000 + seed, {.duration_s = 13.0, .drop_outs = 0.0, .markers = markers});
      for (auto& frame : flight.frames) {
        Centroid& lamp = frame.observation.centroids[static_cast<std::size_t>(frame.observation.count++)];
        lamp.pixel = {80.0 + 100.0 * static_cast<double>(seed), 60.0};
        lamp.covariance = 0.25 * Eigen::Matrix2d::Identity();
      }
      EXPECT_LT(errorAfter(flight), 0.02) << markers.count() << " balls, seed " << seed;
    }
}

TEST(Joint, FindsItsPlaceThoughABallIsNeverSeen) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    TrainingFlight flight = flyForTraining(6000 + seed, {.duration_s = 13.0, .markers = six()});
    const auto hidden = markerId(static_cast<int>(seed));
    for (auto& frame : flight.frames) {
      Observation seen = frame.observation;
      seen.count = 0;
      for (const LabelledPixel& pixel : frame.pixels)
        if (pixel.marker != hidden) {
          Centroid& centroid = seen.centroids[static_cast<std::size_t>(seen.count++)];
          centroid.pixel = pixel.pixel;
          centroid.covariance = pixel.covariance;
        }
      frame.observation = seen;
    }
    EXPECT_LT(errorAfter(flight), 0.02) << "seed " << seed;
  }
}

TEST(Joint, LearnsOnFromWhatOthersFound) {
  constexpr int kFlights = 40;
  Random random(8);
  double nees = 0.0, alone = 0.0, together = 0.0;
  for (std::uint64_t seed = 0; seed < kFlights; ++seed) {
    const TrainingFlight flight = flyForTraining(7000 + seed, {.duration_s = 8.0, .markers = asymmetric()});
    const auto calibrator = makeCalibrator("joint", whiteNoise(), flight.camera, flight.markers, 1);
    const auto other = makeCalibrator("joint", whiteNoise(), flight.camera, flight.markers, 1);
    EXPECT_FALSE(calibrator->goOnFrom(calibrator->estimate())) << "it does not know its place";
    calibrator->restart(flight.guess);
    other->restart(flight.guess);
    CameraEstimate found;
    found.covariance.diagonal() << Eigen::Vector3d::Constant(1e-7), Eigen::Vector3d::Constant(1e-6);
    Vector6d off;
    for (int i = 0; i < 6; ++i) off[i] = std::sqrt(found.covariance(i, i)) * random.normal();
    found.camera_from_world = perturbCamera(flight.camera_from_world, off);
    for (std::size_t f = 0; f < flight.frames.size(); ++f) {
      if (f == 300) {
        ASSERT_TRUE(calibrator->goOnFrom(found));
        EXPECT_EQ(calibrator->estimate().camera_from_world.translation, found.camera_from_world.translation);
      }
      calibrator->step(flight.frames[f].view());
      other->step(flight.frames[f].view());
    }
    const CameraEstimate estimate = calibrator->estimate();
    const Vector6d error = cameraPerturbation(estimate.camera_from_world, flight.camera_from_world);
    nees += error.dot(estimate.covariance.ldlt().solve(error)) / kFlights;
    together += error.tail<3>().squaredNorm();
    alone += off.tail<3>().squaredNorm();
    const double before_m2 = found.covariance.diagonal().tail(3).sum();
    EXPECT_LT(estimate.covariance.diagonal().tail(3).sum(), before_m2);
  }
  EXPECT_NEAR(nees, 6.0, 2.6 * std::sqrt(12.0 / kFlights));
  EXPECT_LT(together, 0.8 * alone);
}

TEST(Joint, TellsWhatItWeighsUp) {
  const TrainingFlight flight = flyForTraining(3000, {.duration_s = 6.0, .markers = square()});
  const auto calibrator = makeCalibrator("joint", whiteNoise(), flight.camera, flight.markers, 1);
  calibrator->restart(flight.guess);
  EXPECT_EQ(calibrator->labellings().count, 0);
  int most = 0;
  for (const auto& frame : flight.frames) {
    calibrator->step(frame.view());
    most = std::max(most, calibrator->labellings().count);
  }
  EXPECT_GE(most, 4) << "a square can be turned four ways";
  ASSERT_TRUE(calibrator->knowsItsPlace());
  const TriedLabellings decided = calibrator->labellings();
  EXPECT_TRUE(decided.by_misfit);
  ASSERT_EQ(decided.count, 1);
  EXPECT_NEAR(decided.all[0].value, 1.0F, 0.5F);
  EXPECT_GE(decided.all[0].count, 3);
  calibrator->restart(flight.guess);
  EXPECT_EQ(calibrator->labellings().count, 0);
}

TEST(Joint, SearchesAnewWhenTheCameraIsSomewhereElse) {
  const TrainingFlight before = flyForTraining(1, {.duration_s = 4.0, .markers = asymmetric()});
  const TrainingFlight after = flyForTraining(2, {.duration_s = 8.0, .markers = asymmetric()});
  const auto calibrator = makeCalibrator("joint", whiteNoise(), before.camera, before.markers, 1);
  calibrator->restart(before.guess);
  for (const auto& frame : before.frames) calibrator->step(frame.view());
  for (const auto& frame : after.frames) calibrator->step(frame.view());
  EXPECT_LT(test::positionError(calibrator->estimate().camera_from_world, after.camera_from_world), 0.02);
}

TEST(Joint, ForgettingOldFramesCostsNothing) {
  CalibratorOptions few = whiteNoise(), all = whiteNoise();
  few.joint.smoother.kept_frames = 64;
  all.joint.smoother.kept_frames = 1000;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const TrainingFlight flight = flyForTraining(4000 + seed, {.duration_s = 10.0, .markers = asymmetric()});
    const auto a = makeCalibrator("joint", few, flight.camera, flight.markers, 1);
    const auto b = makeCalibrator("joint", all, flight.camera, flight.markers, 1);
    for (const auto& frame : flight.frames) {
      a->step(frame.view());
      b->step(frame.view());
    }
    EXPECT_LT(test::positionError(a->estimate().camera_from_world, b->estimate().camera_from_world), 1e-3);
  }
}

TEST(Ekf, ComesNearTheBoundFromAFairGuess) {
  EXPECT_LT(study("ekf", {.duration_s = 13.0, .markers = asymmetric()}, 20).over_bound, 1.6);
}

TEST(Joint, RefusesOptionsOutOfRange) {
  const TrainingFlight flight = flyForTraining(1, {.duration_s = 0.1});
  const auto refuses = [&](auto change) {
    CalibratorOptions options;
    change(options);
    EXPECT_THROW(makeCalibrator("joint", options, flight.camera, flight.markers, 1), Error);
  };
  refuses([](auto& options) { options.joint.frame_units = 0; });
  refuses([](auto& options) { options.joint.search.lock_inliers = 0.0; });
  refuses([](auto& options) { options.joint.search.lock_median = std::nan(""); });
  refuses([](auto& options) { options.joint.smoother.kept_frames = 1; });
  refuses([](auto& options) { options.joint.lasting.time_s = 0.0; });
  refuses([](auto& options) { options.ekf.iterations = 0; });
}

}  // namespace
}  // namespace helical
