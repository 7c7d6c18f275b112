#include "engine/session/recorder.h"

#include <pthread.h>
#include <signal.h>

#include <chrono>

#include "engine/base/clock.h"
#include "engine/base/error.h"

namespace helical {
namespace {

constexpr std::size_t kChunkSize = 256u << 10;
constexpr TimeNs kChunkTime = 200 * kNanosecondsPerMillisecond;  // 250 with the time that writing takes
constexpr auto kPause = std::chrono::milliseconds(5);
constexpr auto kShortPause = std::chrono::microseconds(100);

/// A file that grows over the process's limit is an error to be told, no reason to end the flight.
void outliveFileSizeLimit() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGXFSZ);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& file, const SessionSettings& settings, WhenFull when_full)
    : writer_(file, settings), when_full_(when_full), thread_([this] { run(); }) {}

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

void Recorder::onEvent(const EngineEvent& event) {
  next_.what = event;  // tells of the things that count, and is none of them
  push();
}

void Recorder::push() {
  while (!queue_->push(next_)) {
    if (when_full_ == WhenFull::kDrop) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    std::this_thread::sleep_for(kShortPause);
  }
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
  }
}

void Recorder::run() {
  outliveFileSizeLimit();
  const MonotonicClock clock;
  const auto item = std::make_unique<FlightItem>();
  TimeNs synced = clock.now();
  for (bool last = false; !last;) {
    last = ended_.load(std::memory_order_acquire);  // before the queue is emptied: nothing comes after
    bool idle = true;
    while (queue_->pop(*item)) {
      idle = false;
      attempt([&] {
        writer_.add(*item);
        if (writer_.chunkSize() >= kChunkSize) writer_.flush();
      });
      if (clock.now() - synced >= kChunkTime) break;
    }
    if (clock.now() - synced >= kChunkTime) {
      attempt([&] {
        writer_.flush();
        writer_.sync();
      });
      synced = clock.now();
      last = false;
    } else if (idle && !last) {
      std::this_thread::sleep_for(kPause);
    }
  }
  attempt([&] { writer_.close(); });
}

}  // namespace helical
