#include "engine/pipeline/engine.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <semaphore>
#include <thread>
#include <vector>

#include "engine/base/check.h"
#include "engine/base/spsc_queue.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {
namespace {

constexpr TimeNs kOutputPeriod = 5 * kNanosecondsPerMillisecond;
constexpr TimeNs kPicturePeriod = 33 * kNanosecondsPerMillisecond;
constexpr TimeNs kLongestWait = 20 * kNanosecondsPerMillisecond;

using ObservationQueue = SpscQueue<Observation, 16>;

EngineEvent event(TimeNs time, Severity severity, const char* text) {
  EngineEvent result{time, severity, {}};
  std::snprintf(result.text.data(), result.text.size(), "%s", text);
  return result;
}

const char* phaseText(FlightPhase phase) {
  switch (phase) {
    case FlightPhase::kIdle:
      return "Idle";
    case FlightPhase::kSpinUp:
      return "Rotors start";
    case FlightPhase::kLiftOff:
      return "Lift-off";
    case FlightPhase::kFlying:
      return "Airborne";
    case FlightPhase::kLanding:
      return "Landing";
    case FlightPhase::kTouchdown:
      return "Touchdown";
    case FlightPhase::kOff:
      return "Rotors off";
  }
  return "";
}

struct SafetyText {
  Severity severity;
  const char* text;
};

SafetyText safetyText(SafetyState state) {
  switch (state) {
    case SafetyState::kNormal:
      return {Severity::kGood, "Pose regained"};
    case SafetyState::kCoasting:
      return {Severity::kCaution, "No pose: coasting on trim"};
    case SafetyState::kDescending:
      return {Severity::kDanger, "No pose for 0.5 s: open-loop descent"};
    case SafetyState::kLandNow:
      return {Severity::kDanger, "Failsafe: lands where it is"};
    case SafetyState::kCut:
      return {Severity::kDanger, "Rotors cut, latched"};
  }
  return {Severity::kInfo, ""};
}

/// A copy of a capture thread's frames at display rate.
class PictureTap {
 public:
  void take(const Frame& frame, const Observation& observation) {
    if (last_ >= 0 && frame.arrival - last_ < kPicturePeriod) return;
    last_ = frame.arrival;
    CameraPicture& picture = pictures_.back();
    picture.sequence = frame.sequence;
    picture.exposure = frame.exposure;
    picture.width = frame.image.width;
    picture.height = frame.image.height;
    picture.observation = observation;
    const auto row_bytes = static_cast<std::size_t>(3 * frame.image.width);
    picture.bgr.resize(row_bytes * static_cast<std::size_t>(frame.image.height));
    for (int y = 0; y < frame.image.height; ++y)
      copyRow(frame.image, y, picture.bgr.data() + row_bytes * static_cast<std::size_t>(y));
    pictures_.publish();
  }
  LatestValue<CameraPicture>& pictures() { return pictures_; }

 private:
  static void copyRow(const ImageView& image, int y, std::uint8_t* to) {
    const std::uint8_t* from = image.row(y);
    if (image.format == PixelFormat::kBgr8) {
      std::memcpy(to, from, static_cast<std::size_t>(3 * image.width));
      return;
    }
    for (int x = 0; x < image.width; ++x) std::memset(to + 3 * x, from[x], 3);
  }

  LatestValue<CameraPicture> pictures_;
  TimeNs last_ = -1;
};

}  // namespace

struct Engine::Implementation {
  Implementation(const RigConfig& rig_config, const FlightPlan& flight_plan)
      : rig(rig_config),
        plan(flight_plan),
        clock(std::make_shared<MonotonicClock>()),
        hardware(openRig(rig, clock,
                         [this](const Frame& frame, const Observation& observation) {
                           taps[static_cast<std::size_t>(frame.camera.index())].take(frame, observation);
                         })),
        loop(rig, plan),
        output(*hardware.transmitter) {
    for (std::size_t i = 0; i < hardware.sources.size(); ++i)
      queues.push_back(std::make_unique<ObservationQueue>());
  }

  void capture(std::size_t index, const std::stop_token& stop);
  void fly(const std::stop_token& stop);
  void send(const std::stop_token& stop);
  void receive();
  void tick(TimeNs now);
  void announce(const EngineSnapshot& now);
  void raise(TimeNs time, Severity severity, const char* text) {
    lost += !events->push(event(time, severity, text));
  }

  const RigConfig rig;
  const FlightPlan plan;
  std::shared_ptr<MonotonicClock> clock;
  std::array<PictureTap, kMaxCameras> taps;
  RigHardware hardware;
  FlightLoop loop;
  OutputLoop output;

  std::vector<std::unique_ptr<ObservationQueue>> queues;
  /// Heads of the queues, taken out to be compared; flight thread.
  std::array<Observation, kMaxCameras> heads{};
  std::array<bool, kMaxCameras> has_head{};
  std::counting_semaphore<> arrived{0};

  std::atomic<bool> take_off{false};
  std::atomic<bool> land{false};
  std::array<std::atomic<bool>, kMaxCameras> hidden{};

  LatestValue<EngineSnapshot> newest;
  std::unique_ptr<SpscQueue<EngineSnapshot, 256>> tick_queue =
      std::make_unique<SpscQueue<EngineSnapshot, 256>>();
  std::unique_ptr<SpscQueue<EngineEvent, 256>> events = std::make_unique<SpscQueue<EngineEvent, 256>>();
  std::atomic<std::uint64_t> lost{0};

  FlightPhase last_phase = FlightPhase::kIdle;
  SafetyState last_safety = SafetyState::kNormal;
  bool had_pose = false;
  bool announced_give_up = false;
  bool ever_started = false;

  std::vector<std::jthread> threads;
};

void Engine::Implementation::capture(std::size_t index, const std::stop_token& stop) {
  ObservationSource& source = *hardware.sources[index];
  Observation observation;
  while (!stop.stop_requested()) {
    source.wait(clock->now() + kLongestWait);
    // A machine slower than the camera always finds a next frame: it must still be able to stop.
    while (!stop.stop_requested() && source.poll(observation)) {
      // A full queue drops it; the gap in the sequence counts it.
      queues[index]->push(observation);
      arrived.release();
    }
  }
}

void Engine::Implementation::receive() {
  for (std::size_t i = 0; i < queues.size(); ++i)
    loop.hideCamera(cameraId(static_cast<int>(i)), hidden[i].load(std::memory_order_relaxed));
  // In order of exposure over all cameras, also after a stall that let the queues fill.
  for (;;) {
    std::size_t oldest = queues.size();
    for (std::size_t i = 0; i < queues.size(); ++i) {
      if (!has_head[i]) has_head[i] = queues[i]->pop(heads[i]);
      if (has_head[i] && (oldest == queues.size() || heads[i].exposure < heads[oldest].exposure)) oldest = i;
    }
    if (oldest == queues.size()) return;
    loop.onObservation(heads[oldest], clock->now());
    has_head[oldest] = false;
  }
}

void Engine::Implementation::tick(TimeNs now) {
  OperatorCommands commands;
  commands.take_off = take_off.exchange(false);
  commands.land = land.exchange(false);
  commands.kill = output.stopped();
  output.submit(loop.onTick(now, commands), now);

  EngineSnapshot& snapshot = newest.back();
  snapshot = loop.snapshot();
  hardware.addTruth(snapshot, now);
  if (!tick_queue->push(snapshot)) lost.fetch_add(1, std::memory_order_relaxed);
  announce(snapshot);
  newest.publish();
}

void Engine::Implementation::announce(const EngineSnapshot& now) {
  if (now.pose_known && !had_pose) {
    had_pose = true;
    raise(now.time, Severity::kGood, "Helicopter found");
  }
  if (now.refusal != nullptr) {
    std::array<char, 112> text{};
    std::snprintf(text.data(), text.size(), "Take-off refused: %s", now.refusal);
    raise(now.time, Severity::kCaution, text.data());
  }
  if (output.gaveUp() && !announced_give_up) {
    announced_give_up = true;
    raise(now.time, Severity::kDanger, "Output fell back to rotors off: the flight thread was silent");
  }
  if (now.phase != last_phase) raise(now.time, Severity::kInfo, phaseText(now.phase));
  if (now.safety != last_safety) {
    const SafetyText text = safetyText(now.safety);
    raise(now.time, text.severity, text.text);
  }
  last_phase = now.phase;
  last_safety = now.safety;
}

void Engine::Implementation::fly(const std::stop_token& stop) {
  const TimeNs period = fromSeconds(1.0 / rig.control.rate_hz);
  TimeNs next = clock->now() + period;
  while (!stop.stop_requested()) {
    const TimeNs now = clock->now();
    if (now >= next) {
      receive();
      tick(clock->now());
      // After a stall the missed ticks are left out, not caught up with.
      next += period * std::max<TimeNs>(1, (now - next) / period + 1);
      continue;
    }
    if (arrived.try_acquire_for(std::chrono::nanoseconds(next - now))) receive();
  }
}

void Engine::Implementation::send(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    output.step(clock->now());
    clock->sleepUntil(clock->now() + kOutputPeriod);
  }
  output.kill();
  output.step(clock->now());
}

Engine::Engine(const RigConfig& rig, const FlightPlan& plan)
    : implementation_(std::make_unique<Implementation>(rig, plan)) {}

Engine::~Engine() {
  stop();
}

const RigConfig& Engine::rig() const {
  return implementation_->rig;
}
const FlightPlan& Engine::plan() const {
  return implementation_->plan;
}
bool Engine::running() const {
  return !implementation_->threads.empty();
}

void Engine::start() {
  Implementation& i = *implementation_;
  HELICAL_CHECK(!i.ever_started);
  i.ever_started = true;
  // Opening devices and drawing the simulated rooms took time that is not part of the flight.
  i.clock->restart();
  i.threads.emplace_back([&i](const std::stop_token& stop) { i.send(stop); });
  i.threads.emplace_back([&i](const std::stop_token& stop) { i.fly(stop); });
  for (std::size_t c = 0; c < i.hardware.sources.size(); ++c)
    i.threads.emplace_back([&i, c](const std::stop_token& stop) { i.capture(c, stop); });
}

void Engine::stop() {
  for (auto& thread : implementation_->threads) thread.request_stop();
  implementation_->threads.clear();
}

void Engine::takeOff() {
  implementation_->take_off = true;
}
void Engine::land() {
  implementation_->land = true;
}
void Engine::kill() {
  implementation_->output.kill();
}

void Engine::hideCamera(CameraId camera, bool hidden) {
  implementation_->hidden[static_cast<std::size_t>(camera.index())] = hidden;
}

bool Engine::poll() {
  return implementation_->newest.take();
}
const EngineSnapshot& Engine::snapshot() const {
  return implementation_->newest.front();
}

bool Engine::pollPicture(CameraId camera) {
  return implementation_->taps[static_cast<std::size_t>(camera.index())].pictures().take();
}

const CameraPicture& Engine::picture(CameraId camera) const {
  return implementation_->taps[static_cast<std::size_t>(camera.index())].pictures().front();
}

bool Engine::nextTick(EngineSnapshot& tick) {
  return implementation_->tick_queue->pop(tick);
}
bool Engine::nextEvent(EngineEvent& event) {
  return implementation_->events->pop(event);
}
std::uint64_t Engine::lostTicks() const {
  return implementation_->lost.load(std::memory_order_relaxed);
}

}  // namespace helical
