#include "engine/calibration/frame_gauss_newton.h"

#include <Eigen/LU>
#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

constexpr std::size_t kFewestPixels = 4;  // three have up to four solutions

}  // namespace

void validate(const FrameGaussNewtonOptions& options) {
  if (options.iterations < 1 || options.iterations > 1000)
    throw Error(ErrorKind::kInput, "iterations of gauss-newton is " + std::to_string(options.iterations), {},
                "give 1 to 1000");
}

FrameGaussNewton::FrameGaussNewton(const FrameGaussNewtonOptions& options, const GuessSpread& spread,
                                   const CameraModel& camera, const MarkerLayout& markers)
    : options_(options), spread_(spread), camera_(camera), markers_(markers) {
  validate(options_);
  restart({});
}

void FrameGaussNewton::restart(const RigidTransform& initial_guess) {
  guess_ = initial_guess;
  estimate_ = {initial_guess, covarianceOf(spread_), CameraStatus::kCalibrating};
}

void FrameGaussNewton::step(const CalibrationFrame& frame) {
  if (frame.pixels.size() < kFewestPixels) return;
  const StoredFrame single = stored(frame);
  const std::array<const StoredFrame*, 1> frames{&single};
  const RigidTransform& start = options_.warm_start ? estimate_.camera_from_world : guess_;
  const MarginalResection solution =
      resect(camera_, markers_, frames, start,
             {.iterations = options_.iterations, .robust_sigmas = 0.0, .damped = false});
  if (!solution.ok) return;
  estimate_.camera_from_world = solution.camera_from_world;
  estimate_.covariance = solution.information.inverse();
}

}  // namespace helical
