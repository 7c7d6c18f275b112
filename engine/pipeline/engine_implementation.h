#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <semaphore>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/spsc_queue.h"
#include "engine/pipeline/announcer.h"
#include "engine/pipeline/engine.h"
#include "engine/pipeline/flight_loop.h"
#include "engine/pipeline/flight_tap.h"
#include "engine/pipeline/hand_over.h"
#include "engine/pipeline/output_loop.h"
#include "engine/pipeline/picture_tap.h"
#include "engine/pipeline/rig_hardware.h"

namespace helical {

using ObservationQueue = SpscQueue<Observation, 16>;

/// On its way to the flight thread.
struct NewCalibration {
  NewCalibration(std::unique_ptr<CameraCalibration> made, std::uint64_t drawn)
      : calibration(std::move(made)), seed(drawn) {}
  std::unique_ptr<CameraCalibration> calibration;
  std::uint64_t seed;
};

/// On its way to the flight thread, with a copy of the plan that is swapped for the old one.
struct PendingChange {
  std::shared_ptr<const FlightChange> change;
  FlightPlan plan;
};

/// What the engine's threads share: engine.cpp has the orders of the thread that reads, engine_threads.cpp what the
/// engine's own threads do.
struct Engine::Implementation {
  Implementation(const RigConfig& rig_config, const FlightPlan& flight_plan, FlightTap* flight_tap)
      : rig(rig_config),
        plan(flight_plan),
        clock(std::make_shared<MonotonicClock>()),
        hardware(openRig(
            rig, clock,
            [this](const Frame& frame, const Observation& observation, const Extractor& extractor) {
              taps[static_cast<std::size_t>(frame.camera.index())].take(frame, observation, extractor);
              if (tap != nullptr) tap->onFrame(frame, observation);
            },
            plan.carried_s)),
        loop(rig, plan),
        output(*hardware.transmitter),
        calibrator(rig.calibrator),
        control(rig.control),
        colour(rig.marker_options),
        tap(flight_tap),
        announcer(rig) {
    for (std::size_t i = 0; i < hardware.sources.size(); ++i)
      queues.push_back(std::make_unique<ObservationQueue>());
    for (std::size_t i = 0; i < rig.cameras.size(); ++i) ignored[i] = rig.cameras[i].ignored_areas;
  }

  void capture(std::size_t index, const std::stop_token& stop);
  void fly(const std::stop_token& stop);
  void send(const std::stop_token& stop);
  void receive();
  void hide(std::size_t camera, bool hide_it);
  void tick(TimeNs now);
  void takeCalibrations(TimeNs now);
  void obeyCalibrationOrders(TimeNs now);
  void takeChange(TimeNs now);
  void showCalibrations(std::uint64_t tick, TimeNs now);
  void addOrders(EngineSnapshot& snapshot) const;
  void measureRate(EngineSnapshot& snapshot);
  std::size_t streamOf(CameraId camera) const {
    return static_cast<std::size_t>(streams[static_cast<std::size_t>(camera.index())].index());
  }
  void followCables();
  void tamper(std::size_t camera);
  void replaceCalibration(std::size_t camera, const std::string& method);
  void raise(const EngineEvent& event) {
    lost += !events->push(event);
    if (tap != nullptr) tap->onEvent(event);
  }

  const RigConfig rig;
  FlightPlan plan;  ///< reading thread, after the start
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

  std::atomic<bool> arm{false};
  std::atomic<bool> disarm{false};
  std::atomic<bool> take_off{false};
  std::atomic<bool> hold{false};
  std::atomic<bool> land{false};
  std::array<std::atomic<bool>, kMaxCameras> hidden{};
  std::array<std::atomic<int>, kMaxCameras> boards{};  ///< how many; the capture threads have the boards
  std::array<std::atomic<double>, kMaxCameras> lost_share{};
  std::array<std::atomic<double>, kMaxCameras> noise{};
  std::atomic<std::uint32_t> colours{0};
  std::atomic<std::uint32_t> backgrounds{0};
  std::array<std::atomic<std::uint32_t>, kMaxCameras> knocks{};
  std::atomic<TimeNs> gust_until{-1};
  std::array<HandOver<NewCalibration>, kMaxCameras> new_calibrations;
  std::array<LatestValue<CalibrationView>, kMaxCameras> calibration_views;
  SpscQueue<CalibrationOrder, 128> calibration_orders;
  std::string calibrator;               ///< reading thread
  std::uint64_t calibrations_made = 0;  ///< reading thread
  HandOver<PendingChange> new_change;
  // Reading thread.
  ControllerOptions control;
  ColourRange colour;
  CameraStreams streams = ownStreams();             ///< as of the newest snapshot
  std::array<Tampering, kMaxCameras> tampering{};   ///< with each camera's frames, whatever cable they come by
  std::array<IgnoredAreas, kMaxCameras> ignored{};  ///< likewise
  std::vector<std::shared_ptr<const FlightChange>> changes;  ///< all: nobody else frees one

  LatestValue<EngineSnapshot> newest;
  std::unique_ptr<SpscQueue<EngineSnapshot, 256>> tick_queue =
      std::make_unique<SpscQueue<EngineSnapshot, 256>>();
  std::unique_ptr<SpscQueue<EngineEvent, 256>> events = std::make_unique<SpscQueue<EngineEvent, 256>>();
  std::atomic<std::uint64_t> lost{0};

  FlightTap* const tap;
  Announcer announcer;
  std::array<bool, kMaxCameras> was_hidden{};  ///< flight thread
  TimeNs rate_since = 0;
  std::uint64_t ticks_then = 0;
  double ticks_per_second = 0.0;
  bool ever_started = false;

  std::vector<std::jthread> threads;
};

}  // namespace helical
