#include "engine/simulator/gige/virtual_camera.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>
#include <utility>

#include "engine/base/monotonic.h"
#include "engine/base/thread_priority.h"

namespace helical::gige {
namespace {

constexpr int kControlTimeoutMs = 20;
constexpr auto kIdle = std::chrono::milliseconds(20);
constexpr TimeNs kLongestSleep = 50 * kNanosecondsPerMillisecond;
constexpr TimeNs kLateFrames = 4;  // so many are sent late, when this machine stalled, before one is left out

/// Image and timestamp, each described behind it, by number and size.
void putChunks(std::span<std::uint8_t> payload, std::size_t image, TimeNs timestamp) {
  constexpr std::uint32_t kImageChunk = 1, kTimestampChunk = 2;
  const auto time = static_cast<std::uint64_t>(timestamp);
  std::size_t at = image;
  for (const std::uint32_t word : {kImageChunk, static_cast<std::uint32_t>(image), static_cast<std::uint32_t>(time >> 32),
                                   static_cast<std::uint32_t>(time), kTimestampChunk, std::uint32_t{sizeof time}})
    for (int shift = 24; shift >= 0; shift -= 8) payload[at++] = static_cast<std::uint8_t>(word >> shift);
}

}  // namespace

VirtualCamera::VirtualCamera(const Options& options, Lens lens)
    : options_(options),
      lens_(std::move(lens)),
      state_(options.identity),
      random_(Random(options.seed).fork(1)),
      phase_(random_.uniform()),
      sender_(options.identity.ip, Random(options.seed).fork(2)),
      channel_(options.identity.ip, state_, mutex_, sender_) {
  state_.restart(monotonicNow());
  control_thread_ = std::jthread([this](const std::stop_token& stop) { control(stop); });
  stream_thread_ = std::jthread([this](const std::stop_token& stop) { stream(stop); });
}

VirtualCamera::~VirtualCamera() {
  control_thread_.request_stop();
  stream_thread_.request_stop();
  changed_.notify_all();
}

void VirtualCamera::setFaults(const CameraFaults& faults) {
  const std::lock_guard lock(mutex_);
  faults_ = faults;
  state_.take(faults.taken);
}

void VirtualCamera::setClock(double offset_s, double drift) {
  const std::lock_guard lock(mutex_);
  state_.clock().offset = fromSeconds(offset_s);
  state_.clock().drift = drift;
}

void VirtualCamera::pulseLine() {
  {
    const std::lock_guard lock(mutex_);
    state_.pulse(monotonicNow());
  }
  changed_.notify_all();
}

void VirtualCamera::reboot(double off_s) {
  const std::lock_guard lock(mutex_);
  const TimeNs now = monotonicNow();
  silent_until_ = now + fromSeconds(off_s);
  state_.restart(silent_until_);
}

bool VirtualCamera::controlled() const {
  const std::lock_guard lock(mutex_);
  return state_.controlled();
}

VirtualCamera::Counts VirtualCamera::counts() const {
  return {frames_.load(std::memory_order_relaxed), missed_.load(std::memory_order_relaxed), sender_.resent()};
}

TimeNs VirtualCamera::deviceNow() const {
  const std::lock_guard lock(mutex_);
  return state_.deviceTime(monotonicNow());
}

CameraFaults VirtualCamera::faults() const {
  const std::lock_guard lock(mutex_);
  CameraFaults faults = faults_;
  faults.mute = faults.mute || monotonicNow() < silent_until_;
  return faults;
}

void VirtualCamera::control(const std::stop_token& stop) {
  constexpr double kRebootS = 1.0;
  while (!stop.stop_requested()) {
    const CameraFaults now = faults();
    channel_.serve(kControlTimeoutMs, now.mute, now.loss);
    bool reset = false;
    {
      const std::lock_guard lock(mutex_);
      state_.expire(monotonicNow());
      reset = state_.takeResetOrder();
    }
    if (reset) reboot(kRebootS);
    changed_.notify_all();
  }
}

void VirtualCamera::stream(const std::stop_token& stop) {
  raisePriority(Urgency::kCapture);
  while (!stop.stop_requested()) {
    Exposing exposing;
    {
      std::unique_lock lock(mutex_);
      exposing = state_.exposing();
      if (!exposing.acquiring) {
        streaming_ = false;
        last_rate_ = 0.0;
        id_ = 0;
        changed_.wait_for(lock, kIdle);
        continue;
      }
    }
    streaming_ = true;
    TimeNs mid_exposure = 0;
    if (exposing.triggered) {
      if (!waitForTrigger(mid_exposure, exposing)) continue;
    } else {
      mid_exposure = nextExposure(exposing, monotonicNow());
      const TimeNs now = monotonicNow();
      if (mid_exposure - now > kLongestSleep) {
        sleepUntilMonotonic(now + kLongestSleep);
        continue;
      }
    }
    sleepUntilMonotonic(mid_exposure);
    expose(exposing, mid_exposure);
  }
}

bool VirtualCamera::waitForTrigger(TimeNs& mid_exposure, const Exposing& exposing) {
  std::unique_lock lock(mutex_);
  std::optional<TimeNs> start = state_.takeTrigger();
  if (!start) {
    changed_.wait_for(lock, kIdle);
    start = state_.takeTrigger();
  }
  if (!start) return false;
  mid_exposure = std::max(*start, monotonicNow()) + fromSeconds(0.5e-6 * exposing.exposure_us);
  return true;
}

TimeNs VirtualCamera::nextExposure(const Exposing& exposing, TimeNs now) {
  const std::lock_guard lock(mutex_);
  const TimeNs period = fromSeconds(1.0 / exposing.rate_hz);
  const TimeNs device_now = state_.clock().device(now);
  const bool goes_on = exposing.rate_hz == last_rate_ && last_exposure_ <= device_now &&
                       device_now - last_exposure_ < kNanosecondsPerSecond;
  TimeNs next = last_exposure_ + period;
  if (!goes_on) {
    const auto phase = static_cast<TimeNs>(phase_ * static_cast<double>(period));
    next = (device_now / period + 1) * period + phase;
    last_exposure_ = next - period;
    last_rate_ = exposing.rate_hz;
  }
  return state_.clock().host(next);
}

void VirtualCamera::expose(const Exposing& exposing, TimeNs mid_exposure) {
  const TimeNs period = fromSeconds(1.0 / exposing.rate_hz);
  TimeNs timestamp = 0;
  std::uint64_t late = 0;
  {
    const std::lock_guard lock(mutex_);
    const TimeNs half = fromSeconds(0.5e-6 * exposing.exposure_us);
    timestamp = state_.deviceTime(mid_exposure) - half;
    if (!exposing.triggered) {
      last_exposure_ += period;
      const TimeNs behind = (state_.clock().device(monotonicNow()) - last_exposure_) / period;
      late = behind > kLateFrames ? static_cast<std::uint64_t>(behind) : 0;
      last_exposure_ += static_cast<TimeNs>(late) * period;
    }
  }
  const auto bits = static_cast<std::size_t>(bitsPerPixel(exposing.format));
  const auto size = static_cast<std::size_t>(exposing.width) * static_cast<std::size_t>(exposing.height) * bits / 8;
  const std::size_t whole = size + (exposing.chunks ? kChunkBytes : 0);
  if (++id_ == 0) id_ = 1;
  const CameraFaults faulty = faults();
  if (!faulty.mute) {
    std::vector<std::uint8_t>& payload = sender_.payload(whole);
    readout_.read(lens_(mid_exposure), exposing, std::span(payload).first(size));
    if (exposing.chunks) putChunks(std::span(payload), size, timestamp);
    const TimeNs readout = std::min(fromSeconds(options_.readout_s), period / 2);
    sleepUntilMonotonic(mid_exposure + readout + fromSeconds(faulty.jitter_s * random_.uniform()));
    sender_.send(id_, exposing.chunks ? deviceNow() : timestamp, exposing, faulty.loss);
    frames_.fetch_add(1, std::memory_order_relaxed);
  }
  for (; late > 0; --late, missed_.fetch_add(1, std::memory_order_relaxed))
    if (++id_ == 0) id_ = 1;
}

}  // namespace helical::gige
