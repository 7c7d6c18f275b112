#pragma once

#include <bitset>
#include <span>

#include "engine/correspondence/affine_seed.h"
#include "engine/correspondence/label_keeper.h"
#include "engine/geometry/rigid_transform.h"

namespace helical {

/// The helicopter as one camera alone sees it, which knows neither where it stands nor what the others see: which
/// centroid is which ball, and the body's pose in the camera's own frame. Labellings by the affine seed times the
/// two planar poses are followed from frame to frame; the one that alone goes on fitting is the answer. A layout
/// that looks the same after a turn decides nothing. Once known, names are kept by following centroids, and sought
/// anew when they are lost or no longer fit. Allocates at construction only. One thread.
class BodyView {
 public:
  BodyView(const CameraModel& camera, const MarkerLayout& markers);
  BodyView(const BodyView&) = delete;  // the seeds point to the camera
  BodyView& operator=(const BodyView&) = delete;

  void forget();
  void step(const Observation& observation);

  /// Whether the newest frame's balls have names and the pose is that frame's.
  bool known() const { return known_; }
  const RigidTransform& cameraFromBody() const { return hypotheses_[0].camera_from_body; }
  std::bitset<kMaxMarkers> seen() const { return seen_; }
  std::span<const Eigen::Vector2d> pixels() const { return pixels_; }  ///< by marker, of those seen
  double variance() const { return variance_; }                        ///< of a centroid, per axis [px^2]

 private:
  struct Hypothesis {
    std::array<std::uint8_t, kMaxMarkers> marker_of_track;
    RigidTransform camera_from_body;
    double cost = 0.0;  ///< robust, squared sigmas, over all frames so far
  };
  /// One frame's fit of a pose.
  struct Fit {
    RigidTransform camera_from_body;
    double cost = 0.0;
    int inliers = 0;
  };

  void seek(const Observation& observation);
  Fit fit(const Hypothesis& hypothesis, const Observation& observation, const Names& centroid_of_track) const;
  void prune();
  void takeNames(const Observation& observation, const Names& centroid_of_track);

  CameraModel camera_;
  MarkerLayout markers_;
  AffineSeeds seeds_;
  LabelKeeper tracks_;
  std::array<Hypothesis, 32> hypotheses_;
  int count_ = 0;
  int frames_ = 0;    ///< that the hypotheses have been followed through
  int misfits_ = 0;   ///< running count of frames that do not fit, once known
  bool known_ = false;
  std::bitset<kMaxMarkers> seen_;
  std::array<Eigen::Vector2d, kMaxMarkers> pixels_;
  double variance_ = 0.25;
};

}  // namespace helical
