#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "engine/config/rig_config.h"
#include "engine/session/cdr.h"
#include "engine/session/flight_item.h"
#include "engine/session/frame_queue.h"

namespace helical {

/// What a session's messages say, as payloads of ROS 2. Frames are "world", "helicopter" (the body) and
/// "camera_LABEL" (x right, y down, z forward); stamps count from the session's begin. Covariances are in
/// ROS's order: place, then rotation about the fixed axes of the message's frame. Every function begins the
/// payload anew.

inline constexpr const char* kWorldFrame = "world";
inline constexpr const char* kHelicopterFrame = "helicopter";
std::string cameraFrame(const CameraConfig& camera);
inline constexpr std::uint8_t kLogInfo = 20, kLogWarning = 30, kLogError = 40;  ///< of rcl_interfaces/Log
inline constexpr std::string_view kGoodNews = "helical.good";  ///< who logs it: ROS has no level for that
inline constexpr const char* kBeliefFields[] = {"x", "y", "z", "weight"};  ///< of a PointCloud2

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
void encodeTrack(CdrWriter& out, const UsedObservation& used, int markers, const std::string& frame);
void encodeBelief(CdrWriter& out, const CameraBelief& belief);
void encodeImage(CdrWriter& out, const RecordedFrame& image, const std::string& frame);
void encodeJpeg(CdrWriter& out, const RecordedFrame& image, const std::string& frame);
void encodeFlightState(CdrWriter& out, std::uint64_t order, const FlightTick& tick);
void encodeOrder(CdrWriter& out, std::uint64_t order, const CameraHidden& hidden);
void encodeOrder(CdrWriter& out, std::uint64_t order, const CalibrationBegun& begun);
void encodeOrder(CdrWriter& out, std::uint64_t order, const CalibrationDecided& decided);
void encodeOrder(CdrWriter& out, std::uint64_t order, const FlightChanged& changed);
void encodeEvent(CdrWriter& out, const EngineEvent& event);

/// One frame's place in the world.
struct NamedTransform {
  std::string_view frame;
  RigidTransform world_from_frame;
};
void encodeTransforms(CdrWriter& out, TimeNs time, std::span<const NamedTransform> transforms);

/// Back again (flight_decoding.cpp). All throw CutShort for what does not fit the definition.

struct DecodedObservation {
  std::uint64_t order = 0;
  TimeNs used = 0;
  Observation observation;  ///< without its camera: the topic says which
};
DecodedObservation decodeObservation(std::string_view payload);

/// Snapshots have words as literals; those of a file live here, each once.
class Words {
 public:
  const char* keep(std::string_view word) { return words_.emplace(word).first->c_str(); }

 private:
  std::set<std::string> words_;
};

struct DecodedTick {
  std::uint64_t order = 0;
  OperatorCommands commands;
  DeviceStatus devices;
};
/// `state` gets what the message holds.
DecodedTick decodeFlightState(std::string_view payload, EngineSnapshot& state, Words& words);
void decodeCameraState(std::string_view payload, CameraSnapshot& camera, Words& words);
void decodeTrackedPose(std::string_view payload, TrackedState& tracked);
/// `state` with its attitude.
void decodeVelocity(std::string_view payload, HelicopterState& state);
void decodeSetPointPose(std::string_view payload, SetPoint& set_point);
void decodeSetPointVelocity(std::string_view payload, SetPoint& set_point);
StickDemand decodeSticks(std::string_view payload);
/// `estimate` gets pose and covariance.
void decodeExtrinsics(std::string_view payload, CameraEstimate& estimate);
CameraTrack decodeTrack(std::string_view payload);
EngineEvent decodeEvent(std::string_view payload);

struct DecodedOrder {
  std::uint64_t order = 0;
  TimeNs time = 0;
  std::string kind;  ///< "hide", "show", "calibrate", "change", or a CalibrationOrderKind's name
  int camera = 0;
  std::string method;  ///< of "change": see flight_change_text
  std::uint64_t seed = 0;
  std::optional<CalibrationOrder> decided;  ///< of the last kind
};
DecodedOrder decodeOrder(std::string_view payload);

/// Of a PointCloud2 as `encodeBelief` writes it.
void decodeBelief(std::string_view payload, CalibrationView& view);

RigidTransform decodePose(std::string_view payload);  ///< of PoseStamped

}  // namespace helical
