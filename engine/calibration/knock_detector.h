#pragma once

#include "engine/base/time.h"

namespace helical {

struct KnockDetectorOptions {
  // More disagreeing frames than agreeing ones, in a row or nearly so, are a knock: with two other cameras
  // that agree with the pose, and with one. A hard touchdown upsets the pose itself for some frames.
  int disagreeing_frames = 6;
  int disagreeing_frames_of_two = 12;
};

/// What one frame says about whether its camera stands where it stood.
struct KnockEvidence {
  TimeNs exposure = 0;
  int in_view = 0;    ///< balls that this camera should and could show: the fewer of predicted and found
  int agreeing = 0;   ///< of those, the ones that lie where the pose says
  int witnesses = 0;  ///< other cameras that agree with the pose
};

/// Tells a knocked camera from one that is covered, confused by a few false markers or ahead of a pose that
/// is itself in doubt: it shows the balls, in a place where the others say they are not, frame after frame.
/// Whoever jumps first is the odd one out, for the pose has just been predicted from all of them. Pure
/// counting: no threshold in pixels but the tracker's own gates, so that nothing drifts into an alarm. One
/// thread.
class KnockDetector {
 public:
  explicit KnockDetector(const KnockDetectorOptions& options = {}) : options_(options) {}

  /// True in the frame in which the camera is found knocked; counting starts anew then, and
  /// after a fifth of a second without evidence.
  bool add(const KnockEvidence& evidence);

 private:
  KnockDetectorOptions options_;
  int balance_ = 0;
  TimeNs last_ = 0;  ///< exposure of the last frame that counted
};

}  // namespace helical
