#include <algorithm>
#include <cstdio>

#include "engine/base/thread_priority.h"
#include "engine/pipeline/calibration_view.h"
#include "engine/pipeline/engine_implementation.h"

namespace helical {
namespace {

constexpr TimeNs kOutputPeriod = 5 * kNanosecondsPerMillisecond;
constexpr TimeNs kLongestWait = 20 * kNanosecondsPerMillisecond;

constexpr double kUrgentFrames = 400.0;

/// Drawn by this machine, all cameras together.
double drawnPerSecond(const RigConfig& rig) {
  return rig.simulation.camera_rate_hz *
         static_cast<double>(
             std::count_if(rig.cameras.begin(), rig.cameras.end(),
                           [](const CameraConfig& camera) { return camera.source == "sim"; }));
}

}  // namespace

void Engine::Implementation::capture(std::size_t index, const std::stop_token& stop) {
  // Many simulated cameras are more work than there is time: in real time they would lock out the window.
  if (drawnPerSecond(rig) <= kUrgentFrames) raisePriority(Urgency::kCapture);
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

void Engine::Implementation::hide(std::size_t camera, bool hide_it) {
  if (was_hidden[camera] == hide_it) return;
  was_hidden[camera] = hide_it;
  loop.hideCamera(cameraId(static_cast<int>(camera)), hide_it);
  if (tap != nullptr) tap->onHidden(cameraId(static_cast<int>(camera)), hide_it, clock->now());
}

void Engine::Implementation::receive() {
  for (std::size_t i = 0; i < queues.size(); ++i) hide(i, hidden[i].load(std::memory_order_relaxed));
  // In order of exposure over all cameras, also after a stall that let the queues fill.
  for (;;) {
    std::size_t oldest = queues.size();
    for (std::size_t i = 0; i < queues.size(); ++i) {
      if (!has_head[i]) has_head[i] = queues[i]->pop(heads[i]);
      if (has_head[i] && (oldest == queues.size() || heads[i].exposure < heads[oldest].exposure)) oldest = i;
    }
    if (oldest == queues.size()) return;
    const TimeNs now = clock->now();
    loop.onObservation(heads[oldest], now);
    if (tap != nullptr) tap->onObservation(heads[oldest], now, loop.lastTrack());
    has_head[oldest] = false;
  }
}

void Engine::Implementation::tick(TimeNs now) {
  OperatorCommands commands;
  commands.arm = arm.exchange(false);
  commands.disarm = disarm.exchange(false);
  commands.take_off = take_off.exchange(false);
  commands.hold = hold.exchange(false);
  commands.land = land.exchange(false);
  commands.kill = output.stopped();
  takeCalibrations(now);
  takeChange(now);
  obeyCalibrationOrders(now);
  DeviceStatus devices;
  devices.transmitter = output.transmitterStatus();
  if (tap != nullptr) devices.record = tap->health();
  output.submit(loop.onTick(now, commands, devices), now);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i)
    hardware.orders[i]->expect(loop.expectedBalls(cameraId(static_cast<int>(i))));

  EngineSnapshot& snapshot = newest.back();
  snapshot = loop.snapshot();
  hardware.addTruth(snapshot, now);
  hardware.addLinks(snapshot);
  addOrders(snapshot);
  measureRate(snapshot);
  showCalibrations(snapshot.tick, now);
  if (!tick_queue->push(snapshot)) lost.fetch_add(1, std::memory_order_relaxed);
  if (tap != nullptr) tap->onTick(commands, snapshot);
  announcer.announce(snapshot, output.gaveUp(), [this](const EngineEvent& event) { raise(event); });
  newest.publish();
}

void Engine::Implementation::takeCalibrations(TimeNs now) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    std::unique_ptr<NewCalibration> anew = new_calibrations[i].take();
    if (!anew) continue;
    const CameraId camera = cameraId(static_cast<int>(i));
    const char* method = anew->calibration->calibrator().name();
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "calibrates anew by %s", method);
    if (loop.calibration(camera) != nullptr) raise(announcer.event(now, Severity::kInfo, i, text.data()));
    loop.swapCalibration(camera, anew->calibration);
    if (tap != nullptr) tap->onCalibration(camera, method, anew->seed, now);
    new_calibrations[i].giveBack(std::move(anew));
  }
}

void Engine::Implementation::takeChange(TimeNs now) {
  std::unique_ptr<PendingChange> pending = new_change.take();
  if (!pending) return;
  if (pending->change->plan) loop.swapPlan(pending->plan);
  if (pending->change->control) loop.setControl(*pending->change->control);
  if (tap != nullptr) tap->onChange(pending->change, now);
  new_change.giveBack(std::move(pending));
}

void Engine::Implementation::obeyCalibrationOrders(TimeNs now) {
  CalibrationOrder order;
  while (calibration_orders.pop(order)) {
    const auto camera = static_cast<std::size_t>(order.camera.index());
    if (camera >= rig.cameras.size()) continue;
    const char* refusal = loop.orderCalibration(order);
    if (tap != nullptr) tap->onCalibrationOrder(order, now);
    raise(announcer.ordered(now, order, refusal));
  }
}

void Engine::Implementation::showCalibrations(std::uint64_t tick, TimeNs now) {
  if (tick % kCalibrationViewTicks != 0) return;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const CameraCalibration* calibration = loop.calibration(cameraId(static_cast<int>(i)));
    if (calibration == nullptr) continue;
    fillView(*calibration, calibration_views[i].back());
    if (tap != nullptr) tap->onBelief(cameraId(static_cast<int>(i)), calibration_views[i].back(), now);
    calibration_views[i].publish();
  }
}

void Engine::Implementation::addOrders(EngineSnapshot& snapshot) const {
  snapshot.gust_ordered = snapshot.time < gust_until.load(std::memory_order_relaxed);
  snapshot.colours = colours.load(std::memory_order_relaxed);
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    snapshot.cameras[i].boards = boards[i].load(std::memory_order_relaxed);
    snapshot.cameras[i].knocks = knocks[i].load(std::memory_order_relaxed);
    snapshot.cameras[i].lost_share = lost_share[i].load(std::memory_order_relaxed);
    snapshot.cameras[i].noise = noise[i].load(std::memory_order_relaxed);
    snapshot.cameras[i].backgrounds = backgrounds.load(std::memory_order_relaxed);
    const CameraCalibration* calibration = loop.calibration(cameraId(static_cast<int>(i)));
    if (calibration != nullptr)
      snapshot.cameras[i].effective_sample_size = calibration->calibrator().effectiveSampleSize();
  }
}

/// What the flight thread really does; the loop itself only knows what it should.
void Engine::Implementation::measureRate(EngineSnapshot& snapshot) {
  if (snapshot.time - rate_since >= kNanosecondsPerSecond) {
    ticks_per_second =
        static_cast<double>(snapshot.tick - ticks_then) / toSeconds(snapshot.time - rate_since);
    rate_since = snapshot.time;
    ticks_then = snapshot.tick;
  }
  if (ticks_per_second > 0.0) snapshot.ticks_per_second = ticks_per_second;
}

void Engine::Implementation::fly(const std::stop_token& stop) {
  raisePriority(Urgency::kControl);
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
  raisePriority(Urgency::kControl);
  while (!stop.stop_requested()) {
    output.step(clock->now());
    clock->sleepUntil(clock->now() + kOutputPeriod);
  }
  output.kill();
  output.step(clock->now());
}

}  // namespace helical
