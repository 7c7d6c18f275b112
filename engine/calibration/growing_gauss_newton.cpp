#include "engine/calibration/growing_gauss_newton.h"

#include <Eigen/LU>
#include <array>
#include <string>

#include "engine/base/error.h"

namespace helical {
namespace {

constexpr std::size_t kFewestFrames = 3;
constexpr int kYoungFrames = 32;  // up to here solved to convergence each time
constexpr int kSolveShare = 16;

}  // namespace

void validate(const GrowingGaussNewtonOptions& options) {
  if (options.kept_frames < 16 || options.kept_frames > 10000)
    throw Error(ErrorKind::kInput, "kept_frames is " + std::to_string(options.kept_frames), {},
                "give 16 to 10000");
  if (!(options.robust_sigmas >= 0.0 && options.robust_sigmas <= 1000.0))
    throw Error(ErrorKind::kInput, "robust_sigmas is " + std::to_string(options.robust_sigmas), {},
                "give 0 (plain least squares) to 1000");
}

GrowingGaussNewton::GrowingGaussNewton(const GrowingGaussNewtonOptions& options, const GuessSpread& spread,
                                       const CameraModel& camera, const MarkerLayout& markers)
    : options_(options),
      spread_(spread),
      camera_(camera),
      markers_(markers),
      store_((validate(options), options.kept_frames)) {
  restart({});
}

void GrowingGaussNewton::restart(const RigidTransform& initial_guess) {
  store_.clear();
  schedule_ = {};
  unsolved_ = 0;
  guess_ = initial_guess;
  estimate_ = {initial_guess, covarianceOf(spread_), CameraStatus::kCalibrating};
}

void GrowingGaussNewton::step(const CalibrationFrame& frame) {
  if (frame.pixels.empty()) return;
  store_.add(frame);
  if (schedule_.due()) checkModes();
  if (++unsolved_ * kSolveShare < static_cast<int>(store_.frames().size())) return;
  if (store_.frames().size() >= kFewestFrames) solve();
}

void GrowingGaussNewton::checkModes() {
  std::array<const StoredFrame*, kModeFrames> selection;
  const ModeChoice choice =
      chooseMode(camera_, markers_, store_.spread(selection), estimate_.camera_from_world, guess_);
  if (!choice.other_mode) return;
  estimate_.camera_from_world = choice.best.camera_from_world;
  unsolved_ = kSolveShare * options_.kept_frames;
}

void GrowingGaussNewton::solve() {
  unsolved_ = 0;
  const MarginalResection solution = resect(
      camera_, markers_, store_.frames(), estimate_.camera_from_world,
      {.iterations = schedule_.seen() <= kYoungFrames ? 20 : 2, .robust_sigmas = options_.robust_sigmas});
  if (!solution.ok) return;
  estimate_.camera_from_world = solution.camera_from_world;
  estimate_.covariance = solution.information.inverse();
}

}  // namespace helical
