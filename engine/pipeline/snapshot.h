#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/time.h"
#include "engine/calibration/cramer_rao.h"
#include "engine/calibration/refinement_report.h"
#include "engine/cameras/camera_link.h"
#include "engine/cameras/frame.h"
#include "engine/correspondence/tried_labellings.h"
#include "engine/flight/flight_state.h"
#include "engine/geometry/camera_estimate.h"
#include "engine/helicopter/marker_layout.h"
#include "engine/helicopter/stick_demand.h"
#include "engine/simulator/verdict.h"
#include "engine/tracking/track.h"
#include "engine/transmitter/transmitter_status.h"

namespace helical {

/// One camera as the flight thread sees it.
struct CameraSnapshot {
  CameraEstimate estimate;
  double focal_scale = 1.0;                  ///< of its lens, over the rig's
  const char* calibration_method = nullptr;  ///< by which the pose is learnt in flight; null if it was given
  double effective_sample_size = 0.0;        ///< of its hypotheses; 0 for methods without
  TriedLabellings labellings;                ///< that its calibration has weighed up; none if its pose was given
  bool has_truth = false;                    ///< simulated cameras only
  RigidTransform true_camera_from_world;     ///< at `EngineSnapshot::time`
  std::optional<CalibrationBound> calibration_bound;  ///< no estimate can be better; see LiveBound
  bool hidden = false;                                ///< by the operator: its observations are thrown away
  int boards = 0;                                     ///< before it, put there by the operator
  std::uint32_t knocks = 0;                           ///< by the operator, so far
  double lost_share = 0.0;                            ///< of its frames, by the operator's order
  double noise = 0.0;                                 ///< the operator's [grey levels; px without images]
  std::uint32_t backgrounds = 0;                      ///< taken anew by the operator, so far
  int knocks_found = 0;                               ///< how often it was found to have been moved
  bool frozen = false;                                ///< by the operator: learns no more
  std::uint64_t frames = 0;                           ///< received
  std::uint64_t dropped = 0;                          ///< missing in the sequence
  double frames_per_second = 0.0;
  TimeNs latency = 0;         ///< mid-exposure to its use on the flight thread, newest frame
  int centroids = 0;          ///< regions found in the newest frame
  TimeNs extraction_p50 = 0;  ///< processor time a frame; 0 without images
  TimeNs extraction_p99 = 0;
  LinkState link = LinkState::kAlways;   ///< of its device
  std::uint64_t returns = 0;             ///< how often the device was lost and came back
  std::uint64_t resent_packets = 0;
  TimeNs transfer = 0;         ///< first packet to the frame in hand, newest frame
  double clock_sigma_s = 0.0;  ///< how well the device's clock is known
  LightSetting light;          ///< as the device has it
  CameraTrack track;
};

/// How the record of the flight is doing.
struct RecordHealth {
  bool recording = false;
  bool cut_off = false;           ///< the disk refused: nothing is recorded any more
  bool stalled = false;           ///< the newest item did not fit: the disk is too slow
  std::uint64_t lost = 0;         ///< observations, ticks and events for which the disk was too slow
  std::uint64_t lost_images = 0;  ///< likewise
  double disk_free_gb = std::numeric_limits<double>::infinity();
};

/// What the flight thread is told of the devices around it at a control tick.
struct DeviceStatus {
  TransmitterStatus transmitter;
  RecordHealth record;
};

/// Of each camera, the one by whose cable its frames come.
using CameraStreams = std::array<CameraId, kMaxCameras>;

constexpr CameraStreams ownStreams() {
  CameraStreams streams;
  for (int i = 0; i < kMaxCameras; ++i) streams[static_cast<std::size_t>(i)] = cameraId(i);
  return streams;
}

/// The engine's state at one control tick; a plain value, copied to readers through a LatestValue.
struct EngineSnapshot {
  TimeNs time = 0;
  std::uint64_t tick = 0;
  int camera_count = 0;
  int marker_count = 0;
  MarkerLayout markers;  ///< in the body: the rig's, or where a refinement found them
  RefinementReport refinement;
  bool pose_known = false;  ///< tracked now
  TimeNs pose_age = 0;      ///< since the last accepted observation
  FlightPhase phase = FlightPhase::kIdle;
  SafetyState safety = SafetyState::kNormal;
  std::uint32_t failsafes = 0;       ///< bits of Failsafe that have acted
  std::uint32_t alarms = 0;          ///< bits of Failsafe, warnings included, that act now
  bool armed = false;                ///< the rotors may turn
  std::uint32_t failing_checks = 0;  ///< bits of PreArmCheck: why it would not arm now
  std::uint32_t arm_refused = 0;     ///< at the tick when an order to arm is refused: the checks that failed
  bool holding = false;              ///< by the operator's order
  DeviceStatus devices;              ///< as they were told at this tick
  TrackedState tracked;              ///< at `time`
  SetPoint set_point;
  bool hovering = false;       ///< has reached the first waypoint and is not landing
  double flight_time_s = 0.0;  ///< since the rotors started
  double pad_height = 0.0;     ///< of the body's origin standing on the pad [m]
  StickDemand sticks;
  const char* obstacle = nullptr;  ///< on the ground: why it could not take off now; a literal
  const char* refusal = nullptr;   ///< at the tick when a take-off order is given up: why; a literal
  const char* cold_start = nullptr;  ///< no camera is calibrated: what the operator has to do; a literal
  bool cameras_disagree = false;     ///< of two one was moved; which one, nobody can tell
  std::uint32_t cables_changed = 0;  ///< how often two cameras were found at each other's cable
  CameraStreams streams = ownStreams();  ///< other than their own since two were found exchanged
  bool has_truth = false;          ///< simulated flights only
  HelicopterState truth;           ///< at `time`
  Verdict verdict;                 ///< valid with `has_truth`
  bool gust_ordered = false;       ///< the operator's gust blows
  std::uint32_t plans = 0;         ///< changes of the plan so far
  std::uint32_t controls = 0;      ///< changes of gains and trims so far
  std::uint32_t colours = 0;       ///< changes of the markers' colour range so far
  TimeNs server_p50 = 0;           ///< observation in hand to command out, flight thread
  TimeNs server_p99 = 0;
  TimeNs frame_to_command_p50 = 0;  ///< arrival of a camera's newest frame to the tick that first used it
  TimeNs frame_to_command_p99 = 0;
  double ticks_per_second = 0.0;
  std::array<CameraSnapshot, kMaxCameras> cameras{};
};

/// What one camera's calibrator believes, thinned out for display.
struct CalibrationView {
  struct Particle {
    Eigen::Vector3f centre_in_world = Eigen::Vector3f::Zero();  ///< of the camera [m]
    float weight = 0.0F;                                        ///< over that of the heaviest one
  };
  static constexpr int kMaxParticles = 256;

  int total = 0;  ///< hypotheses of the method; 0 for one without
  int count = 0;  ///< of them here
  std::array<Particle, kMaxParticles> particles{};
};

/// A frame for display, with what was found in it.
struct CameraPicture {
  std::uint64_t sequence = 0;
  TimeNs exposure = 0;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bgr;  ///< packed rows, `3 * width` bytes each
  Observation observation;
  /// What markers are told from, as `bgr`; null while there is none.
  std::shared_ptr<const std::vector<std::uint8_t>> background;
};

enum class Severity : std::uint8_t { kInfo, kGood, kCaution, kDanger };

/// A rare event, for the operator and the log.
struct EngineEvent {
  TimeNs time = 0;
  Severity severity = Severity::kInfo;
  std::array<char, 112> text{};  ///< zero-terminated
};

}  // namespace helical
