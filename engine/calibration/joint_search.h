#pragma once

#include <array>
#include <span>

#include "engine/calibration/joint_frame.h"
#include "engine/calibration/thinned_store.h"
#include "engine/correspondence/subset_seeds.h"

namespace helical {

struct JointSearchOptions {
  double prune_chi2 = 40.0;    ///< a hypothesis that is so much worse than the best is given up
  int prune_frames = 8;        ///< but not before there are so many frames
  int lock_frames = 12;        ///< as many before the last one left is believed
  double lock_inliers = 0.55;  ///< and such a share of all centroids must fit it
  double lock_median = 1.8;    ///< in standard deviations, where 1.2 is expected: at most the median residual
};

/// Throws Error(kInput) naming the offending key.
void validate(const JointSearchOptions& options);

/// Where a camera may be and, by that, which centroid is which ball: hypotheses from labellings times the two
/// planar poses of single frames, each refined over frames spread over the helicopter's motion by robust
/// Levenberg-Marquardt that names the centroids anew in each iteration. The worse ones are given up; the last
/// one left is the answer. Labellings that motion or an asymmetric layout have not yet told apart stay, so
/// that a symmetric helicopter at rest decides nothing. A camera that would see balls through the landing
/// pad, the world's origin, is none.
///
/// Refined by its own few lines and not by Ceres: it must stop after each iteration to keep to its share of a
/// camera frame, and must not allocate; and for 24 frames of four balls Ceres takes 170 us where
/// Levenberg-Marquardt on the same residuals takes 26 (ResectionMethod, one core).
class JointSearch {
 public:
  static constexpr int kMaxFrames = 24;

  JointSearch(const JointSearchOptions& options, const CameraModel& camera, const MarkerLayout& markers);
  JointSearch(const JointSearch&) = delete;  // the seeds point to the camera
  JointSearch& operator=(const JointSearch&) = delete;

  void clear();

  /// One frame's share of the work, in units of one frame looked at under one hypothesis: no more than
  /// `kMaxFrames` beyond `units`.
  void step(const UnnamedFrame& frame, int units);

  /// Where the camera may be; between rounds the best one is the first.
  struct Hypothesis {
    RigidTransform camera_from_world;
    Matrix6d hessian = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    double scale = 0.0;      ///< robust scale that `cost` belongs to
    double cost = 0.0;       ///< squared sigmas, minimised
    double rank_cost = 0.0;  ///< the same at the final scale: comparable between hypotheses
    double median_sigmas = 0.0;
    int inliers = 0;
    double damping = 1e-3;
    int iterations = 0;  ///< in this round
    bool evaluated = false;
    bool settled = false;  ///< in this round

    Matrix6d covariance() const;
  };
  std::span<const Hypothesis> hypotheses() const {
    return {hypotheses_.data(), static_cast<std::size_t>(count_)};
  }

  /// See ExtrinsicCalibrator.
  void correct(const CameraModel& camera, const MarkerLayout& markers) {
    camera_ = camera;
    markers_ = markers;
    seeds_.correct(markers);
  }

  /// Whether the last step ended a round: the costs of the hypotheses are those of the same frames.
  bool roundEnded() const { return !in_round_; }
  /// Of a hypothesis [standard deviations]: about 1 where it explains the frames.
  double misfit(const Hypothesis& hypothesis) const;

  /// Whether the first hypothesis is the answer.
  bool decided() const { return decided_; }

 private:
  static constexpr int kMaxHypotheses = 24;

  void seed(const UnnamedFrame& frame);
  void addHypothesis(const RigidTransform& camera_from_world);
  void beginRound();
  void endRound();
  Hypothesis* unsettled();
  bool hopeless(const Hypothesis& hypothesis) const;
  void improve(Hypothesis& hypothesis);
  Hypothesis evaluate(const RigidTransform& pose, const Matrix6d& covariance, double scale) const;
  bool isImpossible(const RigidTransform& camera_from_world) const;
  void prune();
  bool wantsSeeds() const;
  bool canSeed(int centroids);

  JointSearchOptions options_;
  CameraModel camera_;
  MarkerLayout markers_;
  ThinnedStore<UnnamedFrame> store_;
  std::array<UnnamedFrame, kMaxFrames> waiting_;  ///< came during a round, which needs the same frames
  int waiting_count_ = 0;
  SubsetSeeds seeds_;
  RigidTransform seed_world_from_body_;
  int since_seeding_ = 0, seedings_ = 0;
  int since_whole_ = 0;  ///< frames since one had as many centroids as there are balls
  std::array<Hypothesis, kMaxHypotheses> hypotheses_;
  int count_ = 0;
  int in_round_count_ = 0;  ///< the first ones: those that were there when the round began
  int centroids_ = 0;       ///< in the store's frames
  bool in_round_ = false;
  bool decided_ = false;
};

}  // namespace helical
