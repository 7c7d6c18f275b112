#include "engine/experiments/calibration_study.h"

#include <time.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/random.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/experiments/parallel_runs.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kGoodPosition = 0.01;
const double kGoodOrientation = toRadians(0.5);
constexpr double kMarkerErrorM = 1e-3;
constexpr double kTwoSided95 = 1.96;

double threadMicroseconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e6 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_nsec);
}

MarkerLayout layoutOf(const std::array<Eigen::Vector2d, 4>& places) {
  std::array<Eigen::Vector3d, 4> balls;
  for (std::size_t i = 0; i < 4; ++i) balls[i] = {places[i].x(), places[i].y(), -0.05};
  return MarkerLayout(balls, 0.018);
}

MarkerLayout asymmetricLayout() {
  return layoutOf({{{0.18, 0.12}, {-0.15, 0.08}, {-0.12, -0.16}, {0.05, -0.10}}});
}

MarkerLayout squareLayout() {
  return layoutOf({{{0.14, 0.14}, {-0.14, 0.14}, {-0.14, -0.14}, {0.14, -0.14}}});
}

CalibrationFieldOptions fieldWith(const MarkerLayout& markers) {
  CalibrationFieldOptions options;
  options.markers = markers;
  return options;
}

void displaceMarkers(CalibrationFieldOptions& options, std::uint64_t seed) {
  Random random = Random(seed).fork(6);
  for (const Eigen::Vector3d& ball : options.markers.all())
    options.true_markers.push_back(
        ball + kMarkerErrorM * Eigen::Vector3d(random.normal(), random.normal(), random.normal()));
}

/// The study's centroids have white noise only, and the method is told so.
CalibratorOptions methodOptions() {
  CalibratorOptions options;
  options.joint.lasting.sigma_px = 0.0;
  return options;
}

void note(const CameraEstimate& estimate, const CalibrationField& field, const CalibrationBound& bound,
          std::size_t mark, CalibrationRun& run) {
  const Vector6d error = cameraPerturbation(estimate.camera_from_world, field.camera_from_world);
  run.orientation[mark] = error.head<3>().norm();
  run.position_m[mark] = error.tail<3>().norm();
  run.bound_position_m[mark] = bound.position_m;
  run.bound_orientation[mark] = bound.orientation_rad;
  run.nees[mark] = error.dot(estimate.covariance.ldlt().solve(error));
}

CalibrationRun calibrateOnce(const CalibrationCondition& condition, std::uint64_t seed) {
  CalibrationFieldOptions options = condition.field;
  if (condition.marker_errors) displaceMarkers(options, seed);
  const CalibrationField field = simulateCalibrationField(seed, options);
  const auto calibrator =
      makeCalibrator(condition.calibrator, methodOptions(), field.camera, options.markers, seed);
  calibrator->restart(field.guess);
  CalibrationRun run;
  run.converged_s = std::numeric_limits<double>::infinity();
  std::size_t mark = 0;
  for (const CalibrationField::Frame& frame : field.frames) {
    const double begin = threadMicroseconds();
    if (frame.has_pose) calibrator->step(frame.view());
    const double spent = threadMicroseconds() - begin;
    run.step_us_sum += spent;
    run.slowest_steps.push_back(static_cast<float>(spent));
    ++run.steps;
    const CameraEstimate estimate = calibrator->estimate();
    const double now_s = toSeconds(frame.observation.exposure);
    const Vector6d error = cameraPerturbation(estimate.camera_from_world, field.camera_from_world);
    if (std::isinf(run.converged_s) && error.tail<3>().norm() < kGoodPosition &&
        error.head<3>().norm() < kGoodOrientation)
      run.converged_s = now_s;
    if (mark < kStudyMarksS.size() && now_s >= kStudyMarksS[mark] - 1e-6)
      note(estimate, field, frame.bound, mark++, run);
  }
  const auto kept = static_cast<std::ptrdiff_t>(run.slowest_steps.size() / 50);
  std::partial_sort(run.slowest_steps.begin(), run.slowest_steps.begin() + kept, run.slowest_steps.end(),
                    std::greater<>());
  run.slowest_steps.resize(static_cast<std::size_t>(kept));
  return run;
}

/// By linearisation: sum of squared errors minus ratio times squared bounds has mean zero.
RatioInterval rootRatio(const std::vector<CalibrationRun>& runs, std::array<double, 3> CalibrationRun::*error,
                        std::array<double, 3> CalibrationRun::*bound, std::size_t mark) {
  double errors = 0.0, bounds = 0.0;
  for (const auto& run : runs) {
    errors += std::pow((run.*error)[mark], 2);
    bounds += std::pow((run.*bound)[mark], 2);
  }
  const double ratio = errors / bounds;
  double spread = 0.0;
  for (const auto& run : runs)
    spread += std::pow(std::pow((run.*error)[mark], 2) - ratio * std::pow((run.*bound)[mark], 2), 2);
  const double half = kTwoSided95 * std::sqrt(spread) / bounds;
  return {std::sqrt(ratio), std::sqrt(std::max(0.0, ratio - half)), std::sqrt(ratio + half)};
}

}  // namespace

RatioInterval CalibrationResult::positionRatio(std::size_t mark) const {
  return rootRatio(runs, &CalibrationRun::position_m, &CalibrationRun::bound_position_m, mark);
}

RatioInterval CalibrationResult::orientationRatio(std::size_t mark) const {
  return rootRatio(runs, &CalibrationRun::orientation, &CalibrationRun::bound_orientation, mark);
}

Proportion CalibrationResult::success() const {
  const auto good = std::count_if(runs.begin(), runs.end(), [](const CalibrationRun& run) {
    return run.position_m.back() < kGoodPosition && run.orientation.back() < kGoodOrientation;
  });
  return proportion(static_cast<int>(good), static_cast<int>(runs.size()));
}

double CalibrationResult::convergedQuantile(double fraction) const {
  std::vector<double> values;
  for (const auto& run : runs) values.push_back(run.converged_s);
  return quantile(std::move(values), fraction);
}

double CalibrationResult::meanNees(std::size_t mark) const {
  double sum = 0.0;
  for (const auto& run : runs) sum += run.nees[mark];
  return sum / static_cast<double>(runs.size());
}

bool CalibrationResult::neesInBand() const {
  const double half = kTwoSided95 * std::sqrt(12.0 / static_cast<double>(runs.size()));
  return std::abs(meanNees(1) - 6.0) < half && std::abs(meanNees(2) - 6.0) < half;
}

double CalibrationResult::meanStepUs() const {
  double sum = 0.0;
  int steps = 0;
  for (const auto& run : runs) {
    sum += run.step_us_sum;
    steps += run.steps;
  }
  return sum / steps;
}

double CalibrationResult::slowStepUs() const {
  std::vector<float> slow;
  std::size_t steps = 0;
  for (const auto& run : runs) {
    slow.insert(slow.end(), run.slowest_steps.begin(), run.slowest_steps.end());
    steps += static_cast<std::size_t>(run.steps);
  }
  const std::size_t rank = std::min(steps / 1000, slow.size() - 1);
  std::nth_element(slow.begin(), slow.begin() + static_cast<std::ptrdiff_t>(rank), slow.end(),
                   std::greater<>());
  return slow[rank];
}

std::vector<CalibrationCondition> calibrationConditions() {
  const CalibrationFieldOptions asymmetric = fieldWith(asymmetricLayout());
  const CalibrationFieldOptions near_square = fieldWith(MarkerLayout::paper());
  const auto with = [](CalibrationFieldOptions options, auto change) {
    change(options);
    return options;
  };
  const auto far = [](CalibrationFieldOptions& options) {
    options.guess_rotation = kPi;
    options.guess_position = 3.0;
  };
  std::vector<CalibrationCondition> conditions{
      {"asymmetric", "joint", asymmetric},
      {"near-square", "joint", near_square},
      {"outliers-10", "joint", with(asymmetric, [](auto& options) { options.outliers = 0.1; })},
      {"outliers-30", "joint", with(asymmetric, [](auto& options) { options.outliers = 0.3; })},
      {"guess-180deg-3m", "joint", with(asymmetric, far)},
      {"guess-180deg-3m-square", "joint", with(fieldWith(squareLayout()), far)},
      {"marker-error-1mm", "joint", asymmetric, true},
  };
  for (const auto& name : calibratorNames()) {
    if (name == "joint") continue;
    conditions.push_back({"asymmetric", std::string(name), asymmetric});
    conditions.push_back({"near-square", std::string(name), near_square});
  }
  return conditions;
}

CalibrationResult studyCalibration(const CalibrationCondition& condition, int runs, std::uint64_t first_seed,
                                   const std::function<void(int)>& progress) {
  CalibrationResult result;
  result.condition = condition;
  result.runs.resize(static_cast<std::size_t>(runs));
  forEachRun(
      runs,
      [&](int i) {
        result.runs[static_cast<std::size_t>(i)] =
            calibrateOnce(condition, first_seed + static_cast<std::uint64_t>(i));
      },
      progress);
  return result;
}

}  // namespace helical
