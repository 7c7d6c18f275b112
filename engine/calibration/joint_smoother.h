#pragma once

#include <vector>

#include "engine/calibration/frame_information.h"

namespace helical {

struct JointSmootherOptions {
  int kept_frames = 512;       ///< that can be linearised anew; older ones are condensed
  double robust_sigmas = 4.0;  ///< see RobustWeights
};

/// Throws Error(kInput) naming the offending key.
void validate(const JointSmootherOptions& options);

/// A camera's pose from all frames whose centroids have names: each adds its marginal normal equations, at a
/// common linearisation. When the estimate has moved away from there, and on a schedule that grows by 0.4,
/// the kept frames are linearised at the estimate, some in each step of `work`; frames older than those are a
/// sum that moves to the new linearisation to first order. So time per frame and memory are bounded however
/// long a flight lasts. Allocates at construction only.
class JointSmoother {
 public:
  JointSmoother(const JointSmootherOptions& options, const CameraModel& camera, const MarkerLayout& markers);

  /// Forgets all frames. `known`: information about that pose from elsewhere.
  void start(const RigidTransform& camera_from_world, const Matrix6d& known = Matrix6d::Zero());

  /// See ExtrinsicCalibrator.
  void correct(const CameraModel& camera, const MarkerLayout& markers) {
    camera_ = camera;
    markers_ = markers;
  }

  void add(const StoredFrame& frame);

  /// Linearises up to so many frames anew, if that is due.
  void work(int frames);

  const RigidTransform& pose() const { return pose_; }
  /// Of the perturbation, order of CameraEstimate.
  const Matrix6d& information() const { return sum_.hessian; }

 private:
  struct Sum {
    Matrix6d hessian = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    Sum& operator+=(const FrameInformation& frame);
  };
  const StoredFrame& kept(int index) const;
  bool due() const;
  void beginPass();
  void endPass();
  void condenseOldest();
  void solve();

  JointSmootherOptions options_;
  CameraModel camera_;
  MarkerLayout markers_;
  std::vector<StoredFrame> ring_;
  int first_ = 0, kept_count_ = 0;
  long frames_ = 0, next_pass_ = 0, last_pass_ = 0;
  RigidTransform linearisation_;
  Sum sum_;                            ///< of all frames
  Sum condensed_;                      ///< of those no longer kept
  Vector6d ahead_ = Vector6d::Zero();  ///< from the linearisation to the estimate
  RigidTransform pose_;
  bool passing_ = false;
  int pass_index_ = 0;
  RigidTransform pass_linearisation_;
  Sum pass_sum_;
};

}  // namespace helical
