#include "engine/session/flight_playback.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "engine/session/session_writer.h"

namespace helical {
namespace {

constexpr TimeNs kHistory = 30 * kNanosecondsPerSecond;
// What stands in the file at least once in this time: see SessionWriter.
constexpr TimeNs kRunUp = 1300 * kNanosecondsPerMillisecond;
constexpr TimeNs kShortJump = 2 * kNanosecondsPerSecond;
constexpr std::size_t kMostTicks = 4096;
// A camera that delivers for longer without an image in the file: they were not recorded then.
constexpr TimeNs kLongestWithoutImage = 2 * kNanosecondsPerSecond;

}  // namespace

FlightPlayback::FlightPlayback(const std::filesystem::path& session, std::shared_ptr<Clock> clock)
    : reader_(session),
      settings_(fromAttachments(reader_.attachments(), session.string())),
      clock_(std::move(clock)),
      decoder_(reader_, settings_.rig),
      cursor_(reader_),
      images_(reader_, settings_.rig),
      ticks_(kMostTicks) {
  begin_ = reader_.firstTime();
  end_ = reader_.lastTime();
  if (reader_.chunkCount() == 0 || end_ <= begin_)
    throw Error(ErrorKind::kInput, "the session ends before the flight's first moment", session.string(),
                "give a longer one");
  readEvents();
  wall_ = clock_->now();
  seek(begin_);
}

void FlightPlayback::readEvents() {
  McapReader::Selection selection;
  for (const auto& [id, channel] : reader_.channels())
    if (channel.topic == kEventsTopic) selection.channels.insert(id);
  if (selection.channels.empty()) return;
  reader_.read(selection,
               [&](const McapMessage& message) { events_.push_back(decodeEvent(message.payload)); });
  std::stable_sort(events_.begin(), events_.end(),
                   [](const EngineEvent& a, const EngineEvent& b) { return a.time < b.time; });
}

void FlightPlayback::play() {
  if (position_ >= end_) seek(loop_ ? loop_->from : begin_);
  playing_ = true;
  wall_ = clock_->now();
}

void FlightPlayback::setSpeed(double speed) {
  speed_ = std::clamp(speed, kSlowest, kFastest);
}

void FlightPlayback::seek(TimeNs time) {
  const TimeNs to = std::clamp(time, begin_, end_);
  wall_ = clock_->now();
  if (to >= position_ && to - position_ <= kShortJump && jumps_ > 0) {
    advance(to, true);
    return;
  }
  ++jumps_;
  ticks_.clear();
  decoder_.restart();
  const TimeNs history = std::max(begin_, to - kHistory);
  cursor_.seek(history - kRunUp);
  next_event_ = static_cast<std::size_t>(
      std::upper_bound(events_.begin(), events_.end(), history,
                       [](TimeNs at, const EngineEvent& event) { return at < event.time; }) -
      events_.begin());
  advance(history, false);
  advance(to, true);
}

void FlightPlayback::step(int ticks) {
  playing_ = false;
  // Ticks are not exactly as far apart as their rate says: somewhat beyond the one that is meant.
  constexpr double kBeyond = 0.3;
  seek(decoder_.tick().time + fromSeconds((ticks + kBeyond) / settings_.rig.control.rate_hz));
}

bool FlightPlayback::poll() {
  moveOn();
  return std::exchange(fresh_, false);
}

void FlightPlayback::moveOn() {
  if (!playing_) return;
  const TimeNs now = clock_->now();
  const auto passed = static_cast<TimeNs>(std::llround(speed_ * static_cast<double>(now - wall_)));
  wall_ = now;
  const TimeNs to = position_ + passed;
  if (loop_ && loop_->to > loop_->from && (to >= loop_->to || to < loop_->from)) {
    seek(loop_->from);
    return;
  }
  advance(std::min(to, end_), true);
  if (position_ >= end_) playing_ = false;
}

void FlightPlayback::advance(TimeNs to, bool queue_ticks) {
  cursor_.readUntil(to, [&](const McapMessage& message) { take(message, queue_ticks); });
  position_ = std::max(to, begin_);
}

void FlightPlayback::take(const McapMessage& message, bool queue_ticks) {
  try {
    switch (decoder_.take(message)) {
      case FlightDecoder::Found::kTick:
        fresh_ = true;
        if (!queue_ticks) return;
        lost_ += !ticks_.push(decoder_.tick());
        return;
      case FlightDecoder::Found::kObservation: {
        Picture& picture = pictures_[indexOf(decoder_.observation().camera)];
        picture.observation = decoder_.observation();
        picture.fresh = true;
        return;
      }
      default:
        return;
    }
  } catch (const CutShort&) {
    ++lost_;  // a message that contradicts its definition: as if it were not there
  }
}

bool FlightPlayback::pollPicture(CameraId camera) {
  const auto stream = cameraId(static_cast<int>(streamOf(camera)));
  Picture& now = pictures_[indexOf(stream)];
  CameraPicture& shown = now.picture;
  const CameraModel& model = settings_.rig.cameras[indexOf(camera)].model;
  const TimeNs shown_image = now.image;
  now.image = -1;
  if (images_.hasImages(stream)) {
    // A camera that was lost shows its last image; one whose images were not recorded for a while does not.
    const TimeNs oldest = std::min(now.observation.exposure, position_) - kLongestWithoutImage;
    now.image = images_.load(stream, oldest, position_, shown_image, shown);
  }
  const bool fresh = std::exchange(now.fresh, false);
  if (now.image >= 0) {
    if (now.image == shown_image) return false;
  } else {
    if (!fresh && shown_image < 0) return false;
    drawDiscs(now.observation, model.width(), model.height(), shown);
  }
  shown.observation = now.observation;
  shown.sequence = now.observation.sequence;
  shown.exposure = now.observation.exposure;
  return true;
}

bool FlightPlayback::pollCalibration(CameraId camera) {
  const std::uint64_t taken = decoder_.beliefsTaken(camera);
  return std::exchange(beliefs_shown_[indexOf(camera)], taken) != taken;
}

bool FlightPlayback::nextTick(EngineSnapshot& tick) {
  return ticks_.pop(tick);
}

bool FlightPlayback::nextEvent(EngineEvent& event) {
  if (next_event_ == events_.size() || events_[next_event_].time > position_) return false;
  event = events_[next_event_++];
  return true;
}

}  // namespace helical
