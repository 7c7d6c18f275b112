#include "engine/experiments/calibration_study.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/random.h"
#include "engine/calibration/calibrator_factory.h"
#include "engine/calibration/rig_bundle.h"
#include "engine/experiments/parallel_runs.h"
#include "engine/experiments/thread_time.h"
#include "engine/geometry/camera_perturbation.h"
#include "engine/geometry/rotation.h"

namespace helical {
namespace {

constexpr double kMarkerErrorM = 1e-3;
constexpr double kTwoSided95 = 1.96;

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

void note(const CameraEstimate& estimate, const CalibrationField& field, const CalibrationField::Frame& frame,
          std::size_t mark, CalibrationRun& run) {
  const Vector6d error = cameraPerturbation(estimate.camera_from_world, field.camera_from_world);
  run.orientation[mark] = error.head<3>().norm();
  run.position_m[mark] = error.tail<3>().norm();
  run.bound_position_m[mark] = frame.bound.position_m;
  run.bound_orientation[mark] = frame.bound.orientation_rad;
  run.true_bound_position_m[mark] = frame.true_bound.position_m;
  run.nees[mark] = error.dot(estimate.covariance.ldlt().solve(error));
}

/// The frames so far as moments of all three cameras; what the learner saw is named by its calibrator.
void addMoment(const CalibrationField::Frame& frame, const ExtrinsicCalibrator& calibrator,
               std::vector<RigMoment>& moments) {
  if (!frame.has_pose) return;
  RigMoment& moment = moments.emplace_back();
  moment.time = frame.observation.exposure;
  moment.world_from_body = frame.world_from_body;
  for (std::size_t c = 0; c < 2; ++c) moment.views[c] = frame.known_views[c];
  RigMoment::View& own = moment.views[2];
  own.variance = frame.known_views[0].variance;
  for (const LabelledPixel& named : calibrator.named()) {
    own.seen.set(static_cast<std::size_t>(named.marker.index()));
    own.pixels[static_cast<std::size_t>(named.marker.index())] = named.pixel.cast<float>();
  }
}

/// Camera and balls solved for together; the estimate as it is where that fails.
CameraEstimate selfCalibrated(const CalibrationField& field, const MarkerLayout& markers,
                              std::vector<RigMoment> moments, const CameraEstimate& estimate) {
  RigBundle bundle({field.camera, field.camera, field.camera}, markers, static_cast<int>(moments.size()));
  std::array<BundleCamera, 3> cameras;
  for (std::size_t c = 0; c < 3; ++c) {
    cameras[c].used = true;
    cameras[c].given = c < 2;
    cameras[c].camera_from_world = c < 2 ? field.known_cameras[c] : estimate.camera_from_world;
  }
  RigBundleOptions options;
  options.marker_sigma_m = kMarkerErrorM;
  bundle.start(moments, cameras, options);
  while (!bundle.advance(1000)) {
  }
  if (!bundle.succeeded()) return estimate;
  return {bundle.cameras()[2].camera_from_world, bundle.cameras()[2].covariance, estimate.status};
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
  std::vector<RigMoment> moments;
  for (const CalibrationField::Frame& frame : field.frames) {
    const double begin = threadMicroseconds();
    if (frame.has_pose) calibrator->step(frame.view());
    const double spent = threadMicroseconds() - begin;
    run.step_us_sum += spent;
    run.slowest_steps.push_back(static_cast<float>(spent));
    ++run.steps;
    CameraEstimate estimate = calibrator->estimate();
    const double now_s = toSeconds(frame.observation.exposure);
    const Vector6d error = cameraPerturbation(estimate.camera_from_world, field.camera_from_world);
    if (std::isinf(run.converged_s) && error.tail<3>().norm() < kGoodPlaceM &&
        error.head<3>().norm() < kGoodPlaceRad)
      run.converged_s = now_s;
    if (condition.self_calibrates) addMoment(frame, *calibrator, moments);
    if (mark == kStudyMarksS.size() || now_s < kStudyMarksS[mark] - 1e-6) continue;
    if (condition.self_calibrates) estimate = selfCalibrated(field, options.markers, moments, estimate);
    note(estimate, field, frame, mark++, run);
  }
  const auto kept = static_cast<std::ptrdiff_t>(run.slowest_steps.size() / 50);
  std::partial_sort(run.slowest_steps.begin(), run.slowest_steps.begin() + kept, run.slowest_steps.end(),
                    std::greater<>());
  run.slowest_steps.resize(static_cast<std::size_t>(kept));
  return run;
}

/// By linearisation: sum of squared errors minus ratio times squared bounds has mean zero.
Interval rootRatio(const std::vector<CalibrationRun>& runs, std::array<double, 3> CalibrationRun::*error,
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

Interval CalibrationResult::positionRatio(std::size_t mark) const {
  return rootRatio(runs, &CalibrationRun::position_m, &CalibrationRun::bound_position_m, mark);
}

Interval CalibrationResult::positionOverTrueBound(std::size_t mark) const {
  return rootRatio(runs, &CalibrationRun::position_m, &CalibrationRun::true_bound_position_m, mark);
}

Interval CalibrationResult::orientationRatio(std::size_t mark) const {
  return rootRatio(runs, &CalibrationRun::orientation, &CalibrationRun::bound_orientation, mark);
}

Proportion CalibrationResult::success() const {
  const auto good = std::count_if(runs.begin(), runs.end(), [](const CalibrationRun& run) {
    return run.position_m.back() < kGoodPlaceM && run.orientation.back() < kGoodPlaceRad;
  });
  return proportion(static_cast<int>(good), static_cast<int>(runs.size()));
}

Interval CalibrationResult::convergedQuantile(double fraction) const {
  std::vector<double> values;
  for (const auto& run : runs) values.push_back(run.converged_s);
  return quantileInterval(values, fraction);
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
      {"marker-error-1mm-self-calibrated", "joint", asymmetric, true, true},
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
  result.runs = runSeeds(runs, first_seed, progress,
                         [&](std::uint64_t seed) { return calibrateOnce(condition, seed); });
  return result;
}

}  // namespace helical
