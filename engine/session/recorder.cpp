#include "engine/session/recorder.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "engine/base/log.h"

namespace helical {
namespace {

constexpr TimeNs kChunkTime = 150 * kNanosecondsPerMillisecond;  // 250 with the time that writing takes
constexpr auto kPause = std::chrono::milliseconds(5);
constexpr auto kShortPause = std::chrono::microseconds(100);
constexpr int kNiceness = 10;

/// Packing images is work, and the threads that fly come first on a machine with few cores. On Linux this is
/// the calling thread's alone.
void stepBack() {
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
}

/// What cannot be found out does not forbid to fly.
double freeGigabytes(const std::filesystem::path& folder) {
  std::error_code failure;
  const auto space = std::filesystem::space(folder, failure);
  return failure ? std::numeric_limits<double>::infinity() : 1e-9 * static_cast<double>(space.available);
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& file, const SessionSettings& settings, WhenFull when_full,
                   WhenRefused when_refused)
    : folder_(std::filesystem::absolute(file).parent_path()),
      when_full_(when_full),
      disk_free_gb_(freeGigabytes(folder_)) {
  const auto open = [&] { writer_ = std::make_unique<SessionWriter>(file, settings); };
  if (when_refused == WhenRefused::kThrow)
    open();
  else
    attempt(open);
  for (std::size_t i = 0; i < settings.rig.cameras.size(); ++i) {
    const CameraModel& model = settings.rig.cameras[i].model;
    const ImageRecording recording = i < settings.images.size() ? settings.images[i] : ImageRecording{};
    if (recording.quality != ImageQuality::kOff && recording.at_once) images_ = true;
    frames_.push_back(std::make_unique<FrameQueue>(recording, model.width(), model.height()));
  }
  thread_ = std::thread([this] { run(); });
}

Recorder::~Recorder() {
  finish();
}

void Recorder::onObservation(const Observation& observation, TimeNs now, const CameraTrack& track) {
  ++next_.order;
  next_.what = UsedObservation{observation, now, track};
  push();
}

void Recorder::onTick(const OperatorCommands& commands, const EngineSnapshot& state) {
  ++next_.order;
  next_.what = FlightTick{commands, state};
  push();
}

void Recorder::onHidden(CameraId camera, bool hidden, TimeNs now) {
  ++next_.order;
  next_.what = CameraHidden{camera, hidden, now};
  push();
}

void Recorder::onCalibration(CameraId camera, const char* method, std::uint64_t seed, TimeNs now) {
  ++next_.order;
  next_.what = CalibrationBegun{camera, method, seed, now};
  push();
}

void Recorder::onCalibrationOrder(const CalibrationOrder& order, TimeNs now) {
  ++next_.order;
  next_.what = CalibrationDecided{order, now};
  push();
}

void Recorder::onChange(const std::shared_ptr<const FlightChange>& change, TimeNs now) {
  ++next_.order;
  next_.what = FlightChanged{change, now};
  push();
}

void Recorder::onEvent(const EngineEvent& event) {
  next_.what = event;  // tells of the things that count, and is none of them
  push();
}

void Recorder::onBelief(CameraId camera, const CalibrationView& belief, TimeNs now) {
  if (belief.count == 0) return;
  next_.what = CameraBelief{camera, now, belief};
  push();
}

RecordHealth Recorder::health() const {
  return {!failed(), failed(),     losing_.load(std::memory_order_relaxed),
          lost(),    lostImages(), disk_free_gb_.load(std::memory_order_relaxed)};
}

void Recorder::onFrame(const Frame& frame, const Observation&) {
  FrameQueue& queue = *frames_[static_cast<std::size_t>(frame.camera.index())];
  if (!queue.wants(frame)) return;
  while (!queue.push(frame)) {
    if (when_full_ == WhenFull::kDrop) {
      lost_images_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    std::this_thread::sleep_for(kShortPause);
  }
}

void Recorder::recordImages(bool on) {
  for (const auto& queue : frames_) queue->setOpen(on);
  images_.store(on, std::memory_order_relaxed);
}

void Recorder::push() {
  while (!queue_->push(next_)) {
    if (when_full_ == WhenFull::kDrop) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      losing_.store(true, std::memory_order_relaxed);
      return;
    }
    std::this_thread::sleep_for(kShortPause);
  }
  losing_.store(false, std::memory_order_relaxed);
}

void Recorder::finish() {
  if (!thread_.joinable()) return;
  ended_.store(true, std::memory_order_release);
  thread_.join();
}

void Recorder::attempt(const std::function<void()>& step) {
  if (failed_.load(std::memory_order_relaxed)) return;
  try {
    step();
  } catch (const std::exception& error) {
    failure_ = error.what();
    failed_.store(true, std::memory_order_release);
    log(LogLevel::kError, "the record of the flight is cut off: " + failure_);
  }
}

bool Recorder::writeItems(TimeNs until) {
  bool any = false;
  while (queue_->pop(*item_)) {
    any = true;
    attempt([&] { writer_->add(*item_); });
    if (clock_.now() >= until) break;
  }
  return any;
}

/// One of each camera: none waits for another one's, and what the flight did never waits long.
bool Recorder::writeFrames() {
  bool any = false;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const RecordedFrame* frame = frames_[i]->front();
    if (frame == nullptr) continue;
    any = true;
    attempt([&] { writer_->addFrame(cameraId(static_cast<int>(i)), *frame); });
    frames_[i]->pop();
  }
  return any;
}

void Recorder::run() {
  bool stepped_back = false;
  TimeNs synced = clock_.now();
  for (bool last = false; !last;) {
    if (!stepped_back && images_.load(std::memory_order_relaxed)) {
      stepBack();
      stepped_back = true;
    }
    last = ended_.load(std::memory_order_acquire);  // before the queues are emptied: nothing comes after
    const bool items = writeItems(synced + kChunkTime);
    const bool busy = writeFrames() || items;
    const TimeNs now = clock_.now();
    if (now - synced >= kChunkTime) {
      attempt([&] {
        writer_->flush();
        writer_->sync();
      });
      disk_free_gb_.store(freeGigabytes(folder_), std::memory_order_relaxed);
      // What a slow disk takes is part of the next chunk's time; half of that remains to fill it in.
      synced = std::max(now, clock_.now() - kChunkTime / 2);
    } else if (!busy && !last) {
      std::this_thread::sleep_for(kPause);
    }
    last = last && !busy;
  }
  attempt([&] { writer_->close(); });
}

}  // namespace helical
