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
      store_((validate(options), options.kept_frames)),
      search_(camera, markers) {
  solved_.reserve(static_cast<std::size_t>(options.kept_frames));
  solved_order_.reserve(static_cast<std::size_t>(options.kept_frames));
  restart({});
}

void GrowingGaussNewton::restart(const RigidTransform& initial_guess) {
  store_.clear();
  schedule_ = {};
  search_.stop();
  search_due_ = false;
  run_ = {};
  unsolved_ = 0;
  guess_ = initial_guess;
  estimate_ = {initial_guess, covarianceOf(spread_), CameraStatus::kCalibrating};
}

void GrowingGaussNewton::step(const CalibrationFrame& frame) {
  if (frame.pixels.empty()) return;
  store_.add(frame);
  int budget = kFramesPerStep;
  checkModes(budget);
  ++unsolved_;
  solve(budget);
}

void GrowingGaussNewton::checkModes(int& budget) {
  search_due_ = schedule_.due() || search_due_;
  if (search_due_ && !search_.running()) {
    search_due_ = false;
    std::array<const StoredFrame*, kModeFrames> selection;
    search_.start(store_.spread(selection), estimate_.camera_from_world, guess_);
  }
  if (!search_.running()) return;
  search_.advance(estimate_.camera_from_world, budget);
  if (search_.running() || !search_.choice().other_mode) return;
  estimate_.camera_from_world = search_.choice().best.camera_from_world;
  run_ = {};
  unsolved_ = kSolveShare * options_.kept_frames;
}

void GrowingGaussNewton::solve(int& budget) {
  if (!run_.running()) {
    const auto frames = store_.frames();
    if (frames.size() < kFewestFrames || unsolved_ * kSolveShare < static_cast<int>(frames.size())) return;
    unsolved_ = 0;
    solved_.clear();
    solved_order_.clear();
    for (const StoredFrame* frame : frames) {
      solved_.push_back(*frame);
      solved_order_.push_back(&solved_.back());
    }
    run_.start(
        solved_order_, estimate_.camera_from_world,
        {.iterations = schedule_.seen() <= kYoungFrames ? 20 : 2, .robust_sigmas = options_.robust_sigmas});
  }
  run_.advance(camera_, markers_, budget);
  if (run_.running() || !run_.result().ok) return;
  estimate_.camera_from_world = run_.result().camera_from_world;
  estimate_.covariance = run_.result().information.inverse();
}

}  // namespace helical
