#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/clock.h"
#include "engine/pipeline/flight_view.h"
#include "engine/session/flight_decoder.h"
#include "engine/session/message_cursor.h"
#include "engine/session/picture_finder.h"
#include "engine/session/session_settings.h"
#include "engine/session/tick_ring.h"

namespace helical {

/// A recorded flight to look at as at a live one: plays at 0.1 to 10 times its pace, pauses, steps, seeks,
/// goes round between two times. Opens and seeks by the file's index, however long it is. Cameras whose
/// images were not recorded, at all or just then, show discs where markers were seen. One thread.
class FlightPlayback final : public FlightView {
 public:
  static constexpr double kSlowest = 0.1, kFastest = 10.0;

  /// Stands at its begin, paused. Throws Error(kInput) for what is no session of ours.
  explicit FlightPlayback(const std::filesystem::path& session,
                          std::shared_ptr<Clock> clock = std::make_shared<MonotonicClock>());

  const SessionSettings& settings() const { return settings_; }
  const std::filesystem::path& file() const { return reader_.file(); }
  /// Whether the file was closed properly: otherwise it ends where it was cut off.
  bool complete() const { return reader_.complete(); }
  TimeNs begin() const { return begin_; }
  TimeNs end() const { return end_; }
  /// All of the flight's, in order.
  const std::vector<EngineEvent>& events() const { return events_; }

  /// Whether the session holds images of the camera.
  bool hasImages(CameraId camera) const { return images_.hasImages(camera); }

  void play();  ///< from the begin when it stands at the end
  void pause() { playing_ = false; }
  bool playing() const { return playing_; }
  void setSpeed(double speed);  ///< clamped
  double speed() const { return speed_; }
  TimeNs position() const { return position_; }
  void seek(TimeNs time);
  void step(int ticks);  ///< control ticks, also back; pauses
  struct Loop {
    TimeNs from = 0, to = 0;
  };
  void setLoop(std::optional<Loop> loop) { loop_ = loop; }
  const std::optional<Loop>& loop() const { return loop_; }
  /// Counts the times when what `nextTick` gives does not follow what it gave before: histories begin anew,
  /// with the last 30 s before the new position.
  std::uint64_t jumps() const { return jumps_; }

  // FlightView.
  const RigConfig& rig() const override { return settings_.rig; }
  const FlightPlan& plan() const override { return settings_.plan; }
  bool poll() override;  ///< also moves on
  const EngineSnapshot& snapshot() const override { return decoder_.tick(); }
  bool pollPicture(CameraId camera) override;
  const CameraPicture& picture(CameraId camera) const override { return pictures_[streamOf(camera)].picture; }
  bool pollCalibration(CameraId camera) override;
  const CalibrationView& calibration(CameraId camera) const override { return decoder_.belief(camera); }
  bool nextTick(EngineSnapshot& tick) override;
  bool nextEvent(EngineEvent& event) override;
  std::uint64_t lostTicks() const override { return lost_; }

 private:
  struct Picture {
    CameraPicture picture;
    Observation observation;  ///< newest
    bool fresh = false;
    TimeNs image = -1;  ///< log time of the image shown
  };
  static std::size_t indexOf(CameraId camera) { return static_cast<std::size_t>(camera.index()); }
  std::size_t streamOf(CameraId camera) const { return indexOf(snapshot().streams[indexOf(camera)]); }
  void moveOn();
  void advance(TimeNs to, bool queue_ticks);
  void take(const McapMessage& message, bool queue_ticks);
  void readEvents();

  McapReader reader_;
  SessionSettings settings_;
  std::shared_ptr<Clock> clock_;
  FlightDecoder decoder_;
  MessageCursor cursor_;
  PictureFinder images_;
  std::vector<EngineEvent> events_;
  std::size_t next_event_ = 0;
  TimeNs begin_ = 0, end_ = 0, position_ = 0;
  TimeNs wall_ = 0;  ///< at the last move
  double speed_ = 1.0;
  bool playing_ = false;
  std::optional<Loop> loop_;
  std::uint64_t jumps_ = 0, lost_ = 0;
  bool fresh_ = false;
  TickRing ticks_;
  std::array<Picture, kMaxCameras> pictures_{};  ///< of streams
  std::array<std::uint64_t, kMaxCameras> beliefs_shown_{};
};

}  // namespace helical
