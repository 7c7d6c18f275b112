#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/latency_histogram.h"
#include "engine/experiments/calibration_field.h"
#include "engine/experiments/statistics.h"
#include "engine/geometry/rotation.h"

namespace helical {

/// When a calibration's error is looked at [s].
inline constexpr std::array<double, 3> kStudyMarksS{1.0, 5.0, 13.0};
/// Errors below which a camera's place counts as found.
inline constexpr double kGoodPlaceM = 0.01;
inline const double kGoodPlaceRad = toRadians(0.5);

/// One calibration's errors and bounds at the marks.
struct CalibrationRun {
  std::array<double, 3> position_m{}, orientation{};  ///< errors [m, rad]
  std::array<double, 3> bound_position_m{}, bound_orientation{};
  std::array<double, 3> true_bound_position_m{};  ///< of the true balls alone
  std::array<double, 3> nees{};      ///< 6 on average where the covariance is true
  double converged_s = 0.0;          ///< first within 1 cm and 0.5 degrees; infinite if never
  double step_us_sum = 0.0;          ///< thread CPU time
  std::vector<float> slowest_steps;  ///< us, the slowest 2 % of its frames
  int steps = 0;
};

/// One kind of flight under one method.
struct CalibrationCondition {
  std::string name;
  std::string calibrator;
  CalibrationFieldOptions field;
  bool marker_errors = false;  ///< every ball is 1 mm off its place in the layout, each way at random
  bool self_calibrates = false;  ///< the balls' places are solved for at each mark, together with the cameras
};

struct CalibrationResult {
  CalibrationCondition condition;
  std::vector<CalibrationRun> runs;

  /// Root mean square error over root mean square bound at a mark.
  Interval positionRatio(std::size_t mark) const;
  Interval orientationRatio(std::size_t mark) const;
  /// The same over the bound of the true balls alone.
  Interval positionOverTrueBound(std::size_t mark) const;
  /// Within 1 cm and 0.5 degrees at the last mark.
  Proportion success() const;
  Interval convergedQuantile(double fraction) const;
  double meanNees(std::size_t mark) const;
  /// Whether the mean lies where 95 % of such means do when the covariance is true, at 5 and at 13 s.
  bool neesInBand() const;
  double meanStepUs() const;
  double slowStepUs() const;  ///< 99.9th percentile
};

/// The conditions of the study: layouts, outliers, guesses far off and balls not where they should be for
/// `joint`; every other method on the asymmetric layout and on the paper's.
std::vector<CalibrationCondition> calibrationConditions();

/// Seeds `first_seed` .. `first_seed` + `runs` - 1 on all cores.
CalibrationResult studyCalibration(const CalibrationCondition& condition, int runs, std::uint64_t first_seed,
                                   const std::function<void(int)>& progress);

}  // namespace helical
