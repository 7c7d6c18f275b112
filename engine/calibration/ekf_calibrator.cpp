#include "engine/calibration/ekf_calibrator.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <string>

#include "engine/base/error.h"
#include "engine/geometry/camera_perturbation.h"

namespace helical {
namespace {

constexpr double kMedianToScale = 2.5;
constexpr double kConvergedStep = 1e-7;  // rad and m

}  // namespace

void validate(const EkfOptions& options) {
  if (options.iterations < 1 || options.iterations > 100)
    throw Error(ErrorKind::kInput, "iterations of ekf is " + std::to_string(options.iterations), {},
                "give 1 to 100");
  if (!(options.robust_sigmas >= 1.0 && options.robust_sigmas <= 1000.0))
    throw Error(ErrorKind::kInput, "robust_sigmas of ekf is " + std::to_string(options.robust_sigmas), {},
                "give 1 to 1000");
}

EkfCalibrator::EkfCalibrator(const EkfOptions& options, const GuessSpread& spread, const CameraModel& camera,
                             const MarkerLayout& markers)
    : options_((validate(options), options)), spread_(spread), camera_(camera), markers_(markers) {
  restart({});
}

void EkfCalibrator::restart(const RigidTransform& initial_guess) {
  estimate_ = {initial_guess, covarianceOf(spread_), CameraStatus::kCalibrating};
  information_ = estimate_.covariance.diagonal().cwiseInverse().asDiagonal();
}

void EkfCalibrator::step(const CalibrationFrame& frame) {
  if (frame.pixels.empty()) return;
  const StoredFrame named = stored(frame);
  const RigidTransform predicted = estimate_.camera_from_world;
  Vector6d change = Vector6d::Zero();
  Matrix6d sum = information_;
  double scale = options_.robust_sigmas;
  for (int i = 0; i < options_.iterations; ++i) {
    const RigidTransform at = perturbCamera(predicted, change);
    const double median = frameInformation(camera_, markers_, named, at, {scale}).median_sigmas;
    scale = std::max(options_.robust_sigmas, kMedianToScale * median);
    const FrameInformation seen = frameInformation(camera_, markers_, named, at, {scale});
    const double share = options_.robust_sigmas * options_.robust_sigmas / (scale * scale);
    sum = information_ + share * seen.hessian;
    const Vector6d next = sum.ldlt().solve(share * (seen.hessian * change - seen.gradient));
    if (!next.allFinite()) return;
    const double moved = (next - change).norm();
    change = next;
    if (moved < kConvergedStep) break;
  }
  information_ = sum;
  estimate_.camera_from_world = perturbCamera(predicted, change);
  estimate_.covariance = information_.ldlt().solve(Matrix6d::Identity());
}

}  // namespace helical
