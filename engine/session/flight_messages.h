#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/config/rig_config.h"
#include "engine/session/cdr.h"
#include "engine/session/flight_item.h"

namespace helical {

/// What a session's messages say, as payloads of ROS 2. Frames are "world", "helicopter" (the body) and
/// "camera_LABEL" (x right, y down, z forward); stamps count from the session's begin. Covariances are in
/// ROS's order: place, then rotation about the fixed axes of the message's frame. Every function begins the
/// payload anew.

inline constexpr const char* kWorldFrame = "world";
inline constexpr const char* kHelicopterFrame = "helicopter";
std::string cameraFrame(const CameraConfig& camera);

void encodePose(CdrWriter& out, TimeNs time, const RigidTransform& world_from_frame);
void encodeVelocity(CdrWriter& out, TimeNs time, const HelicopterState& state);
void encodeTrackedPose(CdrWriter& out, const TrackedState& tracked);
void encodeSetPointPose(CdrWriter& out, TimeNs time, const SetPoint& set_point);
void encodeSetPointVelocity(CdrWriter& out, TimeNs time, const SetPoint& set_point);
void encodeSticks(CdrWriter& out, TimeNs time, const StickDemand& sticks);
void encodeExtrinsics(CdrWriter& out, TimeNs time, const CameraEstimate& estimate);
void encodeCameraState(CdrWriter& out, TimeNs time, const CameraSnapshot& camera);
void encodeCameraInfo(CdrWriter& out, const CameraConfig& camera);
void encodeObservation(CdrWriter& out, std::uint64_t order, const UsedObservation& used, int markers,
                       const std::string& frame);
void encodeFlightState(CdrWriter& out, std::uint64_t order, const FlightTick& tick);
void encodeOrder(CdrWriter& out, std::uint64_t order, const CameraHidden& hidden);
void encodeOrder(CdrWriter& out, std::uint64_t order, const CalibrationBegun& begun);
void encodeEvent(CdrWriter& out, const EngineEvent& event);

/// One frame's place in the world.
struct NamedTransform {
  std::string_view frame;
  RigidTransform world_from_frame;
};
void encodeTransforms(CdrWriter& out, TimeNs time, std::span<const NamedTransform> transforms);

/// Back again: what a replay needs. All throw CutShort for what does not fit the definition.

struct DecodedObservation {
  std::uint64_t order = 0;
  TimeNs used = 0;
  Observation observation;  ///< without its camera: the topic says which
};
DecodedObservation decodeObservation(std::string_view payload);

struct DecodedTick {
  std::uint64_t order = 0;
  TimeNs time = 0;
  OperatorCommands commands;
  FlightPhase phase = FlightPhase::kIdle;
  bool gust_ordered = false;
  bool has_truth = false;
  Verdict verdict;           ///< without its reason
  std::string crash_reason;  ///< of the verdict
};
DecodedTick decodeFlightState(std::string_view payload);

struct DecodedOrder {
  std::uint64_t order = 0;
  TimeNs time = 0;
  std::string kind;  ///< "hide", "show", "calibrate"
  int camera = 0;
  std::string method;
  std::uint64_t seed = 0;
};
DecodedOrder decodeOrder(std::string_view payload);

RigidTransform decodePose(std::string_view payload);  ///< of PoseStamped

}  // namespace helical
