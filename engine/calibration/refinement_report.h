#pragma once

#include <cstdint>

namespace helical {

enum class RefinementOutcome : std::uint8_t {
  kNone,
  kCameras,    ///< cameras stand where all of them together say; nothing else was sought
  kCorrected,  ///< and balls or focal lengths are as they were found
  kKept,       ///< they stay as they were: images are explained as well by those
  kUnsound,    ///< they stay as they were: what was found cannot be
  kTooFar,  ///< they stay as they were: the helicopter's pose would have jumped farther than flying on bears
  kNoAnswer,       ///< nothing is changed
  kOvertaken,      ///< something happened to a camera meanwhile, and nothing is changed
  kCamerasTooFar,  ///< nothing is changed: by the cameras' new poses the helicopter's would have jumped too
                   ///< far
};

/// How refinements of the rig ended, and what is flown with since.
struct RefinementReport {
  std::uint32_t ended = 0;  ///< how many so far
  RefinementOutcome outcome = RefinementOutcome::kNone;  ///< of the last one
  int balls_hardly_seen = 0;                             ///< of the last one, which can say nothing of them
  double balls_off_m = 0.0;  ///< that ball which is farthest from where the rig says
  double focal_off = 0.0;    ///< that focal length which differs most from what the rig says, as a share
};

}  // namespace helical
