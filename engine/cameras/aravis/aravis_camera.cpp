#include "engine/cameras/aravis/aravis_camera.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/log.h"
#include "engine/base/monotonic.h"
#include "engine/base/thread_priority.h"
#include "engine/cameras/aravis/gvcp_probe.h"
#include "engine/cameras/camera_silence.h"

namespace helical {
namespace {

constexpr TimeNs kMs = kNanosecondsPerMillisecond;
constexpr TimeNs kWatchPeriod = 10 * kMs;
constexpr TimeNs kStale = 60 * kMs;  // skipped for a newer frame
constexpr int kProbeMs = 50;
constexpr TimeNs kShortestBackoff = 100 * kMs, kLongestBackoff = 400 * kMs;
constexpr TimeNs kFirstSearch = 1000 * kMs;
constexpr TimeNs kOwnerMayBeDead = 4000 * kMs;  // longer than a camera believes in a silent owner
constexpr int kQuickSamples = 8;
constexpr TimeNs kQuickSamplePeriod = 100 * kMs, kSamplePeriod = 1000 * kMs;
constexpr auto kKeepPeriod = std::chrono::milliseconds(50);
constexpr TimeNs kAhead = 5 * kMs;  // an action with a time is told so long before

}  // namespace

AravisCamera::AravisCamera(CameraId camera, const std::string& device, const DeviceOptions& options, int width,
                           int height, std::shared_ptr<Clock> clock, std::shared_ptr<CameraLink> link)
    : camera_(camera),
      device_(device),
      options_(options),
      width_(width),
      height_(height),
      clock_(std::move(clock)),
      link_(std::move(link)) {
  validate(options_);
  openFirst();
  keeper_ = std::jthread([this](const std::stop_token& stop) { keep(stop); });
  supervisor_ = std::jthread([this](const std::stop_token& stop) { supervise(stop); });
}

AravisCamera::~AravisCamera() {
  supervisor_ = {};
  const std::uint64_t incomplete = link_->incomplete, overrun = link_->overrun, resent = link_->resent;
  if (incomplete + overrun + resent > 0)
    log(LogLevel::kInfo, "aravis:" + device_ + ": " + std::to_string(resent) + " packets came when asked for again, " +
                             std::to_string(incomplete) + " frames stayed incomplete, " + std::to_string(overrun) +
                             " were not fetched in time");
  if (current_) current_->halt(!current_->controlLost());
  giveBack();
  for (ReceivedFrame left; frames_.pop(left);) left.session->giveBack(left.buffer);
  keeper_ = {};
}

void AravisCamera::openFirst() {
  const TimeNs began = monotonicNow();
  const auto waits = [&](ProbeAnswer answer) {
    const TimeNs passed = monotonicNow() - began;
    return (answer == ProbeAnswer::kSilent && passed < kFirstSearch) ||
           (answer == ProbeAnswer::kControlled && passed < kOwnerMayBeDead);
  };
  if (isIpAddress(device_)) {
    ProbeAnswer answer = probe(device_, kProbeMs);
    for (; waits(answer); answer = probe(device_, kProbeMs)) sleepUntilMonotonic(monotonicNow() + kShortestBackoff);
    if (answer == ProbeAnswer::kSilent)
      throw Error(ErrorKind::kDevice, "no camera answers", "aravis:" + device_,
                  "check its power, cable and address; `helical devices` lists what is there");
  }
  current_ = open();
  format_ = current_->format();
  link_->state = LinkState::kStreaming;
}

std::unique_ptr<AravisSession> AravisCamera::open() {
  auto session = std::make_unique<AravisSession>(device_, options_, width_, height_, ++sessions_,
                                                 [this](const ReceivedFrame& frame) {
                                                   if (!frames_.push(frame)) {
                                                     link_->overrun.fetch_add(1, std::memory_order_relaxed);
                                                     return false;
                                                   }
                                                   arrived_.release();
                                                   return true;
                                                 });
  link_->tell(session->light());
  log(LogLevel::kInfo, "aravis:" + device_ + ": " + session->description() + " streams");
  return session;
}

// ---- supervising thread

void AravisCamera::nap(const std::stop_token& stop, TimeNs length) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, std::chrono::nanoseconds(length), [] { return false; });
}

void AravisCamera::supervise(const std::stop_token& stop) {
  raisePriority(Urgency::kCapture);
  while (!stop.stop_requested()) {
    if (current_)
      watch(stop);
    else if (!lookAgain(stop))
      nap(stop, backoff_ = std::min(kLongestBackoff, 2 * backoff_));
  }
}

void AravisCamera::watch(const std::stop_token& stop) {
  const bool regular = options_.trigger != TriggerMode::kLine;  // who knows when that comes
  const TimeNs silence = longestSilence(options_);
  if (current_->controlLost()) return drop(LinkState::kLost);
  const TimeNs quiet = monotonicNow() - current_->lastFrame();
  if (regular && quiet > silence) return drop(LinkState::kStalled);
  orderExposure();
  link_->incomplete.store(current_->incompleteFrames(), std::memory_order_relaxed);
  link_->resent.store(current_->resentPackets(), std::memory_order_relaxed);
  const bool orders = next_order_ > 0;
  nap(stop, orders ? std::clamp<TimeNs>(next_order_ - monotonicNow(), 0, kWatchPeriod) : kWatchPeriod);
}

/// At multiples of the period, so that all cameras of a rig expose together.
void AravisCamera::orderExposure() {
  if (options_.trigger != TriggerMode::kSoftware && options_.trigger != TriggerMode::kAction) return;
  const TimeNs period = fromSeconds(1.0 / options_.rate_hz), now = monotonicNow();
  if (next_order_ < now - period) next_order_ = (now / period + 1) * period;
  if (now < next_order_) return;
  if (options_.trigger == TriggerMode::kSoftware)
    current_->trigger();
  else
    current_->act(options_.ptp ? std::optional(worldNow() + next_order_ - now + kAhead) : std::nullopt);
  next_order_ += period;
}

void AravisCamera::drop(LinkState why) {
  link_->state = why;
  log(LogLevel::kWarning, "aravis:" + device_ +
                              (why == LinkState::kStalled ? ": no frame any more" : ": control lost") +
                              ", looks for it again");
  current_->halt(false);
  {
    const std::lock_guard lock(mutex_);
    dead_.push_back(std::move(current_));
  }
  changed_.notify_all();
  backoff_ = kShortestBackoff / 2;
}

bool AravisCamera::lookAgain(const std::stop_token& stop) {
  if (isIpAddress(device_)) {
    const ProbeAnswer answer = probe(device_, kProbeMs);
    if (answer == ProbeAnswer::kSilent) {
      link_->state = LinkState::kLost;
      return false;
    }
    if (answer == ProbeAnswer::kControlled) {
      link_->state = LinkState::kTaken;
      backoff_ = kShortestBackoff / 2;
      return false;
    }
  }
  if (stop.stop_requested()) return false;
  link_->state = LinkState::kOpening;
  try {
    std::unique_ptr<AravisSession> opened = open();
    const std::lock_guard lock(mutex_);
    current_ = std::move(opened);
  } catch (const Error& error) {
    log(LogLevel::kWarning, error.what());
    link_->state = LinkState::kLost;
    return false;
  }
  link_->returns.fetch_add(1, std::memory_order_relaxed);
  link_->state = LinkState::kStreaming;
  return true;
}

// ---- keeping thread

void AravisCamera::keep(const std::stop_token& stop) {
  std::vector<std::unique_ptr<AravisSession>> ending;
  for (;;) {
    AravisSession* session = nullptr;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, stop, kKeepPeriod, [&] { return !dead_.empty(); });
      for (auto& dead : dead_) ending.push_back(std::move(dead));
      dead_.clear();
      session = current_.get();
    }
    std::erase_if(ending, [](const auto& dead) { return dead->lent() == 0; });
    if (stop.stop_requested()) {
      if (ending.empty()) return;
    } else if (session != nullptr && ending.empty()) {
      sampleClock(*session);
    }
  }
}

void AravisCamera::sampleClock(AravisSession& session) {
  if (session.number() != sampled_session_) {
    sampled_session_ = session.number();
    quick_samples_ = kQuickSamples;
    next_sample_ = 0;
  }
  if (monotonicNow() < next_sample_) return;
  NumberedSample numbered{session.number(), {}};
  if (session.sampleClock(numbered.sample)) samples_.push(numbered);
  next_sample_ = monotonicNow() + (quick_samples_ > 0 ? kQuickSamplePeriod : kSamplePeriod);
  quick_samples_ = std::max(0, quick_samples_ - 1);
}

// ---- polling thread

void AravisCamera::giveBack() {
  if (held_.buffer != nullptr) held_.session->giveBack(held_.buffer);
  held_ = {};
}

bool AravisCamera::take(ReceivedFrame& received) {
  if (!frames_.pop(received)) return false;
  ReceivedFrame newer;
  while (monotonicNow() - received.arrival > kStale && frames_.pop(newer)) {
    link_->overrun.fetch_add(1, std::memory_order_relaxed);
    received.session->giveBack(received.buffer);
    received = newer;
  }
  // What waited while the rig's other cameras were opened lies before a gap that nobody lost.
  if (seen_ || monotonicNow() - received.arrival <= kStale) return true;
  received.session->giveBack(received.buffer);
  return false;
}

bool AravisCamera::poll(Frame& frame) {
  giveBack();
  ReceivedFrame received;
  if (!take(received)) return false;
  held_ = received;
  follow(received);
  const TimeNs to_clock = clock_->now() - monotonicNow();
  frame.camera = camera_;
  frame.sequence = sequence_;
  frame.exposure = exposureOf(received) + to_clock;
  frame.arrival = received.arrival + to_clock;
  frame.first_packet = received.first_packet + to_clock;
  frame.device_time = received.device_time;
  frame.image = received.image;
  link_->first_packet_to_frame.store(received.arrival - received.first_packet, std::memory_order_relaxed);
  return true;
}

/// Counts exposures, and what was lost between this one and the last.
void AravisCamera::follow(const ReceivedFrame& received) {
  constexpr std::uint64_t kShortIds = 0x10000;
  const std::uint32_t number = received.session->number();
  if (!seen_ || number != session_) {
    mapping_.reset();
    if (received.session->readsClock()) mapping_.add(received.session->firstSample());
    session_ = number;
    ++sequence_;
  } else if (received.id > last_id_) {
    sequence_ += received.id - last_id_;
  } else {
    sequence_ += received.id + kShortIds - last_id_ - 1;  // 16 bits, and 0 is left out
  }
  seen_ = true;
  last_id_ = received.id;
  if (early_.session == session_) mapping_.add(early_.sample);
  early_ = {};
  for (NumberedSample numbered; samples_.pop(numbered);) {
    if (numbered.session == session_) mapping_.add(numbered.sample);
    if (numbered.session > session_) early_ = numbered;
  }
}

TimeNs AravisCamera::exposureOf(const ReceivedFrame& received) {
  const double half_us = 0.5 * link_->exposure_us.load(std::memory_order_relaxed);
  const double to_middle_us = options_.stamped_at == StampedAt::kStart  ? half_us
                              : options_.stamped_at == StampedAt::kEnd ? -half_us
                                                                       : 0.0;
  const TimeNs middle = received.device_time + fromSeconds(1e-6 * to_middle_us);
  if (!received.session->readsClock())
    mapping_.addArrival(middle, received.arrival, fromSeconds(1e-3 * options_.readout_ms));
  link_->clock_drift.store(mapping_.drift(), std::memory_order_relaxed);
  link_->clock_sigma_s.store(mapping_.sigma(), std::memory_order_relaxed);
  return mapping_.host(middle);
}

void AravisCamera::wait(TimeNs deadline) {
  const TimeNs left = deadline - clock_->now();
  if (left > 0) static_cast<void>(arrived_.try_acquire_for(std::chrono::nanoseconds(left)));
}

}  // namespace helical
