#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/session/cdr.h"
#include "engine/session/flight_item.h"
#include "engine/session/frame_queue.h"
#include "engine/session/mcap_writer.h"
#include "engine/session/message_types.h"
#include "engine/session/session_settings.h"

namespace helical {

/// Writes what happens in a flight as ROS 2 messages into an MCAP file. Topics are listed in
/// engine/session/README.md. One thread; all methods throw Error(kSystem) when the disk refuses.
class SessionWriter {
 public:
  SessionWriter(const std::filesystem::path& file, const SessionSettings& settings);

  void add(const FlightItem& item);
  void addFrame(CameraId camera, const RecordedFrame& frame);
  void flush() { mcap_.flush(); }
  void sync() { mcap_.sync(); }
  void close() { mcap_.close(); }

 private:
  struct CameraChannels {
    std::string frame;
    std::uint16_t observation = 0, extrinsics = 0, state = 0, info = 0, truth = 0;
    std::uint16_t track = 0, belief = 0, image = 0;
    ImageQuality quality = ImageQuality::kOff;
    CameraSnapshot written;  ///< as of the last message
    TimeNs extrinsics_written = -1, state_written = -1, belief_written = -1;
  };
  std::uint16_t channel(const std::string& topic, MessageKind kind);
  void addCameras(const SessionSettings& settings);
  void send(std::uint16_t channel, TimeNs time) { mcap_.addMessage(channel, time, time, out_.bytes()); }

  void write(std::uint64_t order, const EngineEvent& event);
  void write(std::uint64_t order, const UsedObservation& used);
  void write(std::uint64_t order, const FlightTick& tick);
  void write(std::uint64_t order, const CameraHidden& hidden);
  void write(std::uint64_t order, const CalibrationBegun& begun);
  void write(std::uint64_t order, const CameraBelief& belief);
  void write(std::uint64_t order, const CalibrationDecided& decided);
  void write(std::uint64_t order, const FlightChanged& changed);
  void writeTruth(const EngineSnapshot& state);
  void writeCamera(const EngineSnapshot& state, std::size_t index);

  McapWriter mcap_;
  CdrWriter out_;
  int markers_ = 0;
  std::array<std::uint16_t, kMessageKinds> schemas_{};
  std::uint16_t pose_ = 0, velocity_ = 0, set_point_pose_ = 0, set_point_velocity_ = 0, sticks_ = 0;
  std::uint16_t flight_state_ = 0, orders_ = 0, events_ = 0, transforms_ = 0;
  std::uint16_t true_pose_ = 0, true_velocity_ = 0;
  std::vector<CameraChannels> cameras_;
};

/// The topics of a camera begin with this: "/cameras/LABEL/", and ROS's names know letters, digits and
/// underscores alone. Different for each camera of a rig.
std::string cameraTopic(const RigConfig& rig, std::size_t camera);

/// Topics that a reader looks for.
inline constexpr const char* kPoseTopic = "/helicopter/pose";
inline constexpr const char* kSetPointTopic = "/set_point/pose";
inline constexpr const char* kSticksTopic = "/sticks";
inline constexpr const char* kFlightStateTopic = "/flight/state";
inline constexpr const char* kOrdersTopic = "/flight/orders";
inline constexpr const char* kTruePoseTopic = "/truth/pose";
inline constexpr const char* kTrueVelocityTopic = "/truth/velocity";
inline constexpr const char* kVelocityTopic = "/helicopter/velocity";
inline constexpr const char* kSetPointVelocityTopic = "/set_point/velocity";
inline constexpr const char* kEventsTopic = "/events";
inline constexpr const char* kImageTopic = "image_raw";  ///< behind a camera's, as ROS's cameras name it
inline constexpr const char* kJpegTopic = "image_raw/compressed";

}  // namespace helical
