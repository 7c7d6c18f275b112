#include "engine/calibration/admission.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "engine/base/error.h"
#include "engine/base/require.h"
#include "engine/calibration/camera_perturbation.h"

namespace helical {
namespace {

constexpr int kFewestBalls = 3;
constexpr double kMedianOfTwo = 1.1774;  // median length of a two-dimensional standard normal vector
constexpr double kUnseenResidual = 100.0;
constexpr double kLargestResidual = 20.0;  // one frame of nonsense must not outlast the window
constexpr double kLongestStepS = 0.1;

void requireGap(double admit, double drop, const char* key) {
  if (!(drop > admit))
    throw Error(ErrorKind::kInput, "drop_" + std::string(key) + " is not above admit_" + key, {},
                "leave a gap, or a camera on the edge goes in and out");
}

}  // namespace

void validate(const AdmissionOptions& options) {
  requirePositive(options.admit_uncertainty_m, "admit_uncertainty_m");
  requirePositive(options.admit_residual, "admit_residual");
  requirePositive(options.drop_uncertainty_m, "drop_uncertainty_m");
  requirePositive(options.drop_residual, "drop_residual");
  requirePositive(options.window_s, "window_s");
  requirePositive(options.reach_m, "reach_m");
  requireGap(options.admit_uncertainty_m, options.drop_uncertainty_m, "uncertainty_m");
  requireGap(options.admit_residual, options.drop_residual, "residual");
}

double uncertaintyAround(const CameraModel& camera, const CameraEstimate& estimate,
                         const Eigen::Vector3d& helicopter_in_world, double reach_m) {
  double largest = 0.0;
  for (int i = 0; i < 7; ++i) {
    Eigen::Vector3d point = helicopter_in_world;
    if (i > 0) point[(i - 1) / 2] += i % 2 == 0 ? reach_m : -reach_m;
    const auto seen = projectMarker(camera, estimate.camera_from_world, {}, point);
    if (!seen) return std::numeric_limits<double>::infinity();
    const Eigen::Matrix2d covariance = seen->d_camera * estimate.covariance * seen->d_camera.transpose();
    const double variance_px =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance, Eigen::EigenvaluesOnly).eigenvalues()[1];
    const double depth = (estimate.camera_from_world * point).z();
    largest =
        std::max(largest, std::sqrt(std::max(variance_px, 0.0)) * depth / std::min(camera.fx(), camera.fy()));
  }
  return largest;
}

double normalisedResidual(const CameraModel& camera, const MarkerLayout& markers,
                          const CameraEstimate& estimate, const CalibrationFrame& frame) {
  std::array<double, kMaxMarkers> residuals;
  int count = 0;
  for (const LabelledPixel& seen : frame.pixels) {
    if (count == kMaxMarkers) break;
    double& residual = residuals[static_cast<std::size_t>(count++)];
    const auto ball =
        projectMarker(camera, estimate.camera_from_world, frame.world_from_body, markers.inBody(seen.marker));
    residual = kUnseenResidual;
    if (!ball) continue;
    const Eigen::Matrix2d covariance = seen.covariance +
                                       ball->d_pose * frame.pose_covariance * ball->d_pose.transpose() +
                                       ball->d_camera * estimate.covariance * ball->d_camera.transpose();
    const Eigen::Vector2d error = ball->pixel - seen.pixel;
    residual = std::sqrt(error.dot(covariance.inverse() * error)) / kMedianOfTwo;
  }
  if (count < kFewestBalls) return -1.0;
  const auto middle = residuals.begin() + (count - 1) / 2;
  std::nth_element(residuals.begin(), middle, residuals.begin() + count);
  return *middle;
}

AdmissionMemory admit(const AdmissionOptions& options, const AdmissionMemory& before,
                      const AdmissionEvidence& evidence) {
  AdmissionMemory now = before;
  if (!(evidence.residual >= 0.0)) return now;
  const double elapsed = before.last == 0 ? 0.0 : toSeconds(evidence.exposure - before.last);
  if (elapsed < 0.0) return now;
  now.last = evidence.exposure;
  if (elapsed > options.window_s) now.observed_s = now.good_s = 0.0;
  const double step_s = std::min(elapsed, kLongestStepS);
  now.observed_s = std::min(now.observed_s + step_s, options.window_s);
  // A plain mean until the window is full, then an exponential one.
  const double share = now.observed_s > 0.0 && step_s > 0.0 ? step_s / now.observed_s : 1.0;
  now.residual += std::min(share, 1.0) * (std::min(evidence.residual, kLargestResidual) - now.residual);

  const bool good =
      evidence.uncertainty_m < options.admit_uncertainty_m && now.residual < options.admit_residual;
  now.good_s = good ? now.good_s + step_s : 0.0;
  if (now.status == CameraStatus::kCalibrated) {
    if (now.observed_s >= 0.5 * options.window_s && now.residual > options.drop_residual)
      now.status = CameraStatus::kRejected;
    else if (!(evidence.uncertainty_m <= options.drop_uncertainty_m))
      now.status = CameraStatus::kCalibrating;
  } else if (now.good_s >= options.window_s) {
    now.status = CameraStatus::kCalibrated;
  }
  if (now.status != before.status) now.good_s = 0.0;
  return now;
}

}  // namespace helical
