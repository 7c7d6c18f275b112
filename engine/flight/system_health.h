#pragma once

#include <limits>

namespace helical {

/// How the machines around the flight are, at one control tick; the defaults are all well.
struct SystemHealth {
  int live_cameras = 2;            ///< calibrated, not hidden, and gave a frame lately
  bool camera_silent = false;      ///< one that gave frames before, lately
  bool camera_clock_off = false;   ///< its frames' times have moved by more than half a frame
  double frame_share = 1.0;        ///< of the frames that should have come, of the worst live camera
  double tick_share = 1.0;         ///< of the control ticks that should have come
  double overrun_s = 0.0;          ///< how late this tick is
  double position_sigma = 0.0;     ///< of the pose [m], the three axes together
  double rotation_sigma = 0.0;     ///< of the pose [rad], the three axes together
  double residual_ratio = 1.0;     ///< of the pose's residual over its baseline
  bool cameras_disagree = false;   ///< one was set aside, and whether it or the other one was moved is not known
  bool yaw_ambiguous = false;      ///< of a layout that looks the same when it is turned
  bool transmitter_ready = true;   ///< present, and its self-test passed
  bool transmitter_fault = false;  ///< the newest demand was not taken
  bool channels_calibrated = true;
  bool pilot_flies = false;     ///< trainer switch: the pilot's own transmitter has the helicopter
  bool record_failed = false;   ///< a record was wanted, and nothing can be written any more
  bool record_stalled = false;  ///< it loses what it is given
  double disk_free_gb = std::numeric_limits<double>::infinity();  ///< for the record
};

}  // namespace helical
