#pragma once

#include <array>
#include <span>

#include "engine/calibration/frame_store.h"
#include "engine/geometry/camera_model.h"
#include "engine/helicopter/marker_layout.h"

namespace helical {

struct MarginalResectionOptions {
  int iterations = 20;
  double robust_sigmas = 4.0;  ///< residuals beyond weigh (this / residual)^4; 0 is plain least squares
  bool damped = true;          ///< accept only steps that help (Levenberg-Marquardt); false is Gauss-Newton
};

/// A camera's pose found from frames.
struct MarginalResection {
  RigidTransform camera_from_world;
  Matrix6d information = Matrix6d::Zero();  ///< of the perturbation, order of CameraEstimate
  double cost = 0.0;                        ///< robust, squared sigmas: comparable between poses
  int terms = 0;                            ///< balls that counted
  bool ok = false;                          ///< finite, and determined by the frames
};

/// Minimises the reprojection error (the paper's problem 1 with K known) of the named pixels of all frames
/// over camera_from_world. Each frame's helicopter pose is marginalised with its covariance (Schur
/// complement): its error is common to all balls of the frame. While the fit is still poor the robust scale
/// follows the median residual, so that a guess 15 degrees off is not all outliers. Can stop after any number
/// of frames and go on later, so that no image waits for it. Allocates nothing. One thread.
class ResectionRun {
 public:
  /// `frames` stay valid and unchanged while it runs.
  void start(std::span<const StoredFrame* const> frames, const RigidTransform& initial,
             const MarginalResectionOptions& options);

  bool running() const { return pass_ != Pass::kNone; }
  /// Goes on until it is done or has looked at `budget` frames, from which it takes what it used.
  void advance(const CameraModel& camera, const MarkerLayout& markers, int& budget);

  /// Of a run that is done.
  const MarginalResection& result() const { return result_; }

  /// Normal equations of one frame or of all.
  struct Normal {
    Matrix6d hessian = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    double cost = 0.0;
    int terms = 0;
  };
  /// From which a median is taken: the first ones of a pass.
  struct Residuals {
    std::array<double, 512> squared;
    std::size_t count = 0;
  };

 private:
  enum class Pass { kNone, kInitial, kRescaled, kTrial, kFinal };

  void beginPass(Pass pass, const RigidTransform& pose);
  void finishPass();
  void iterate();
  void takeStep();
  void judgeTrial();
  void finish();
  void conclude();

  std::span<const StoredFrame* const> frames_;
  MarginalResectionOptions options_;
  MarginalResection result_;
  Pass pass_ = Pass::kNone;
  std::size_t next_frame_ = 0;
  RigidTransform evaluated_;  ///< what the pass looks at
  Normal sum_, current_;
  Residuals residuals_;
  Vector6d step_ = Vector6d::Zero();
  double scale_ = 0.0;
  double damping_ = 0.0;
  int iteration_ = 0;
};

/// All of it at once.
MarginalResection resect(const CameraModel& camera, const MarkerLayout& markers,
                         std::span<const StoredFrame* const> frames, const RigidTransform& initial,
                         const MarginalResectionOptions& options);

}  // namespace helical
