#pragma once

#include <array>

#include "engine/base/time.h"
#include "engine/correspondence/prediction_naming.h"

namespace helical {

struct LabelKeeperOptions {
  double gate_px = 12.0;           ///< how far from its prediction a ball may appear
  double gate_growth_px_s = 60.0;  ///< and how much farther for each second it was not seen
  double agreement_px = 6.0;       ///< how much a ball may deviate from the common motion of all
  double velocity_s = 0.1;         ///< time constant of the velocity
  double lost_after_s = 0.25;      ///< with fewer than three balls
};

/// Throws Error(kInput) naming the offending key.
void validate(const LabelKeeperOptions& options);

/// Keeps the names of an un-calibrated camera's centroids from frame to frame, with no pose to predict from:
/// each ball is sought where it should be at constant image velocity. A ball that is hidden moves with the
/// others. Once lost, only a new labelling helps. Allocates nothing. One thread.
class LabelKeeper {
 public:
  LabelKeeper(const LabelKeeperOptions& options, int marker_count);

  /// Starts from a labelling found elsewhere. Fewer than three names are none; a ball without a
  /// name at the start stays without one.
  void restart(const Observation& observation, const Names& names);

  /// Names for the centroids of a later frame; nobody has one while lost.
  Names follow(const Observation& observation);

  /// Gives the names up.
  void forget() { lost_ = true; }

  bool lost() const { return lost_; }

 private:
  struct Ball {
    bool known = false;
    TimeNs seen = 0;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< at `time_`
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
    double radius_px = 0.0;
  };

  void predict(TimeNs time);
  Names nearest(const Observation& observation) const;
  Eigen::Vector2d commonShift(const Observation& observation, const Names& names) const;
  void correct(const Observation& observation, const Names& names, double elapsed_s);

  LabelKeeperOptions options_;
  int marker_count_;
  std::array<Ball, kMaxMarkers> balls_{};
  TimeNs time_ = 0;
  TimeNs enough_ = 0;  ///< when enough balls were last seen
  bool lost_ = true;
};

}  // namespace helical
