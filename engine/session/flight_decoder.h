#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "engine/session/flight_messages.h"
#include "engine/session/mcap_reader.h"

namespace helical {

/// Puts the messages of a session together again to what the flight showed: a snapshot for each control tick,
/// observations, beliefs, events. What is written less often than every tick is as of its last message (see
/// README.md). One thread; throws CutShort for a message that does not fit its definition.
class FlightDecoder {
 public:
  /// `session` and `rig` must outlive this.
  FlightDecoder(const McapReader& session, const RigConfig& rig);

  /// What a message has completed.
  enum class Found { kNothing, kTick, kObservation, kEvent };
  Found take(const McapMessage& message);

  /// After the last kTick, kObservation or kEvent.
  const EngineSnapshot& tick() const { return tick_; }
  const Observation& observation() const { return observation_; }
  const EngineEvent& event() const { return event_; }
  const CalibrationView& belief(CameraId camera) const { return beliefs_[indexOf(camera)]; }
  std::uint64_t beliefsTaken(CameraId camera) const { return beliefs_taken_[indexOf(camera)]; }

  /// Before messages that do not follow the last ones.
  void restart();

 private:
  enum class Stream {
    kPose,
    kVelocity,
    kSetPointPose,
    kSetPointVelocity,
    kSticks,
    kFlightState,
    kEvents,
    kTruePose,
    kTrueVelocity,
    kObservation,
    kTrack,
    kExtrinsics,
    kCameraState,
    kCameraTruth,
    kBelief,
  };
  struct Source {
    Stream stream;
    std::size_t camera = 0;
  };
  static std::size_t indexOf(CameraId camera) { return static_cast<std::size_t>(camera.index()); }
  /// The camera whose frames come by this one's cable.
  std::size_t cameraBy(std::size_t stream) const;
  Found takeOfCamera(const Source& source, std::string_view payload);

  std::map<std::uint16_t, Source> sources_;  ///< by channel
  EngineSnapshot initial_, tick_;
  Observation observation_;
  EngineEvent event_;
  std::array<CalibrationView, kMaxCameras> beliefs_{};
  std::array<std::uint64_t, kMaxCameras> beliefs_taken_{};
  Words words_;
};

}  // namespace helical
