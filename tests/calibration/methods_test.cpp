#include <gtest/gtest.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/calibration/cramer_rao.h"
#include "engine/geometry/rotation.h"
#include "tests/calibration/training_flight.h"

namespace helical {
namespace {

using test::flyForTraining;
using test::TrainingFlight;

constexpr int kSeeds = 20;
constexpr std::array<std::size_t, 3> kMarks{59, 299, 779};  // frames at 1, 5 and 13 s

double threadSeconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Runs {
  std::array<std::vector<double>, 3> position_m, orientation_rad;
  double step_us = 0.0;  ///< mean
  double slowest_us = 0.0;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

Runs fly(std::string_view method) {
  Runs runs;
  double seconds = 0.0;
  int steps = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const TrainingFlight flight = flyForTraining(1000 + static_cast<std::uint64_t>(seed));
    const auto calibrator = makeCalibrator(method, {}, flight.camera, flight.markers, 7);
    calibrator->restart(flight.guess);
    for (std::size_t k = 0, mark = 0; k < flight.frames.size(); ++k) {
      const double before = threadSeconds();
      calibrator->step(flight.frames[k].view());
      const double spent = threadSeconds() - before;
      seconds += spent;
      runs.slowest_us = std::max(runs.slowest_us, 1e6 * spent);
      ++steps;
      if (mark == kMarks.size() || k != kMarks[mark]) continue;
      const RigidTransform pose = calibrator->estimate().camera_from_world;
      runs.position_m[mark].push_back(test::positionError(pose, flight.camera_from_world));
      runs.orientation_rad[mark++].push_back(test::orientationError(pose, flight.camera_from_world));
    }
  }
  runs.step_us = 1e6 * seconds / steps;
  return runs;
}

void print(std::string_view method, const Runs& runs) {
  std::printf("%-24s", std::string(method).c_str());
  for (std::size_t mark = 0; mark < 3; ++mark)
    std::printf(" | %7.1f %7.1f mm %6.3f %6.3f deg", 1e3 * quantile(runs.position_m[mark], 0.5),
                1e3 * quantile(runs.position_m[mark], 0.9),
                toDegrees(quantile(runs.orientation_rad[mark], 0.5)),
                toDegrees(quantile(runs.orientation_rad[mark], 0.9)));
  std::printf(" | %6.1f us, slowest %6.0f us\n", runs.step_us, runs.slowest_us);
}

/// Every method over the same flights: one table.
class Methods : public testing::Test {
 protected:
  static const Runs& runs(const std::string& method) {
    static std::map<std::string, Runs> all;
    const auto found = all.find(method);
    if (found != all.end()) return found->second;
    const Runs& fresh = all.emplace(method, fly(method)).first->second;
    print(method, fresh);
    return fresh;
  }
};

TEST_F(Methods, GrowingGaussNewtonIsBelowACentimetreAfterThirteenSeconds) {
  const Runs& growing = runs("growing-gauss-newton");
  EXPECT_LT(quantile(growing.position_m[2], 0.5), 0.004);
  EXPECT_LT(quantile(growing.position_m[2], 0.9), 0.010);
  EXPECT_LT(quantile(growing.position_m[1], 0.9), 0.015);
}

TEST_F(Methods, ParticleFilterFindsTheCameraAndNoWrongMode) {
  const Runs& filter = runs("particle-filter");
  EXPECT_GE(std::count_if(filter.position_m[1].begin(), filter.position_m[1].end(),
                          [](double error) { return error < 0.03; }),
            18);
  EXPECT_LT(quantile(filter.position_m[2], 0.5), 0.010);
  EXPECT_LT(quantile(filter.position_m[2], 0.9), 0.020);
  EXPECT_LT(quantile(filter.orientation_rad[2], 0.9), toRadians(0.5));
}

TEST(Robustness, NeitherAGuessOnTheOtherSideNorManyOutliersMislead) {
  const test::TrainingFlightOptions opposite{
      .duration_s = 5.0, .guess_rotation_rad = 3.1, .guess_position_m = 3.0};
  const test::TrainingFlightOptions outliers{.duration_s = 5.0, .outliers = 0.3};
  for (const auto* method : {"particle-filter", "growing-gauss-newton"})
    for (const auto& options : {opposite, outliers})
      for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const TrainingFlight flight = flyForTraining(2000 + seed, options);
        const auto calibrator = makeCalibrator(method, {}, flight.camera, flight.markers, 7);
        calibrator->restart(flight.guess);
        for (const auto& frame : flight.frames) calibrator->step(frame.view());
        EXPECT_LT(test::positionError(calibrator->estimate().camera_from_world, flight.camera_from_world),
                  0.03)
            << method << " seed " << seed;
      }
}

/// One frame of a flat target at a time, and a filter whose particles never move, are no calibration: that is
/// the finding, so no limit on them, only that they stay finite and that the better methods are better.
TEST_F(Methods, OneFrameAtATimeIsWorseThanAllFrames) {
  const Runs& single = runs("gauss-newton");
  const Runs& literal = runs("particle-filter-literal");
  for (const Runs* method : {&single, &literal})
    for (const double error : method->position_m[2]) EXPECT_TRUE(std::isfinite(error));
  EXPECT_GT(quantile(single.position_m[2], 0.5), quantile(runs("particle-filter").position_m[2], 0.5));
  EXPECT_GT(quantile(literal.position_m[2], 0.5), quantile(runs("particle-filter").position_m[2], 0.5));
}

TEST(CramerRaoOfTheFlight, IsWhatAStudyFound) {
  std::array<double, 3> square{};
  for (int seed = 0; seed < kSeeds; ++seed) {
    const TrainingFlight flight = flyForTraining(1000 + static_cast<std::uint64_t>(seed));
    CramerRaoBound bound;
    const std::array<MarkerId, 4> all{markerId(0), markerId(1), markerId(2), markerId(3)};
    for (std::size_t k = 0, mark = 0; k < flight.frames.size(); ++k) {
      const auto& frame = flight.frames[k];
      bound.add(flight.camera, flight.camera_from_world, flight.markers, all, frame.true_world_from_body,
                frame.pose_information, 0.5);
      if (mark == 3 || k != kMarks[mark]) continue;
      ASSERT_TRUE(bound.bound().has_value());
      square[mark++] += std::pow(bound.bound()->position_m, 2) / kSeeds;
    }
  }
  std::printf("Cramer-Rao bound %.1f %.2f %.2f mm\n", 1e3 * std::sqrt(square[0]), 1e3 * std::sqrt(square[1]),
              1e3 * std::sqrt(square[2]));
  EXPECT_NEAR(std::sqrt(square[0]), 0.0105, 0.003);
  EXPECT_NEAR(std::sqrt(square[1]), 0.0023, 0.0008);
  EXPECT_NEAR(std::sqrt(square[2]), 0.0014, 0.0005);
}

TEST(MakeCalibrator, KnowsItsNamesAndListsThemForAnotherOne) {
  const TrainingFlight flight = flyForTraining(1, {.duration_s = 0.1});
  for (const auto& name : calibratorNames())
    EXPECT_EQ(makeCalibrator(name, {}, flight.camera, flight.markers, 1)->name(), name);
  try {
    makeCalibrator("kalman", {}, flight.camera, flight.markers, 1);
    FAIL() << "an unknown name was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_NE(error.problem().find("kalman"), std::string::npos);
    for (const auto& name : calibratorNames()) EXPECT_NE(error.cure().find(name), std::string::npos);
  }
}

TEST(MakeCalibrator, RejectsOptionsOutOfRange) {
  const TrainingFlight flight = flyForTraining(1, {.duration_s = 0.1});
  const auto accepts = [&](auto change) {
    CalibratorOptions options;
    change(options);
    try {
      makeCalibrator("particle-filter", options, flight.camera, flight.markers, 1);
      return true;
    } catch (const Error& error) {
      return error.kind() != ErrorKind::kInput;
    }
  };
  EXPECT_TRUE(accepts([](auto&) {}));
  EXPECT_FALSE(accepts([](auto& options) { options.guess.rotation_rad = 0.0; }));
  EXPECT_FALSE(accepts([](auto& options) { options.gauss_newton.iterations = 0; }));
  EXPECT_FALSE(accepts([](auto& options) { options.growing_gauss_newton.kept_frames = 2; }));
  EXPECT_FALSE(accepts([](auto& options) { options.particle_filter.particles = 0; }));
  EXPECT_FALSE(accepts([](auto& options) { options.particle_filter.kernel = 1.0; }));
  EXPECT_FALSE(accepts([](auto& options) { options.particle_filter.floor = std::nan(""); }));
}

class EveryMethod : public testing::TestWithParam<std::string_view> {};

TEST_P(EveryMethod, RepeatsBitForBitAlsoAfterARestart) {
  const TrainingFlight flight = flyForTraining(3, {.duration_s = 2.0});
  const auto first = makeCalibrator(GetParam(), {}, flight.camera, flight.markers, 5);
  const auto second = makeCalibrator(GetParam(), {}, flight.camera, flight.markers, 5);
  first->restart(flight.guess);
  for (const auto& frame : flight.frames) first->step(frame.view());
  second->restart(RigidTransform{});
  for (const auto& frame : flight.frames) second->step(frame.view());
  second->restart(flight.guess);
  for (const auto& frame : flight.frames) second->step(frame.view());
  const CameraEstimate a = first->estimate(), b = second->estimate();
  EXPECT_EQ(a.camera_from_world.rotation.coeffs(), b.camera_from_world.rotation.coeffs());
  EXPECT_EQ(a.camera_from_world.translation, b.camera_from_world.translation);
  EXPECT_EQ(a.covariance, b.covariance);
}

TEST_P(EveryMethod, StartsAtTheGuessAndStaysCalibratingWhateverItSees) {
  const TrainingFlight flight = flyForTraining(4, {.duration_s = 2.0, .outliers = 1.0});
  const auto calibrator = makeCalibrator(GetParam(), {}, flight.camera, flight.markers, 5);
  calibrator->restart(flight.guess);
  EXPECT_LT(test::positionError(calibrator->estimate().camera_from_world, flight.guess), 1e-9);
  EXPECT_GT(calibrator->estimate().covariance.diagonal().minCoeff(), 0.0);
  calibrator->step({});
  for (const auto& frame : flight.frames) {
    calibrator->step(frame.view());
    const CameraEstimate estimate = calibrator->estimate();
    ASSERT_TRUE(estimate.camera_from_world.translation.allFinite());
    ASSERT_TRUE(estimate.covariance.allFinite());
    ASSERT_EQ(estimate.status, CameraStatus::kCalibrating);
  }
}

INSTANTIATE_TEST_SUITE_P(Calibration, EveryMethod,
                         testing::ValuesIn(calibratorNames().begin(), calibratorNames().end()),
                         [](const auto& each) {
                           std::string name(each.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace helical
